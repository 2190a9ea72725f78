#include "cli/course_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>

#include "symbols/commands.h"

namespace nplc::seqc::cli {
namespace {

constexpr std::string_view kArrow = " -> ";

std::string_view first_word(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(' '), text.size());
    return text.substr(begin, text.find_first_of(" ,", begin) - begin);
}

std::string_view last_word(std::string_view text) {
    return text.substr(text.find_last_of(' ') + 1);
}

bool begins_move(const verify::PlayedScan& scan) {
    return std::any_of(scan.orders.begin(), scan.orders.end(), [](const sequencer::MotorOrder& order) {
        const auto select = order.is_register_write ? std::nullopt : select_command(order.command);
        return select && select->mode == table::Mode::position && select->selection.group == table::Group::p;
    });
}

double milliseconds(const std::string& time) {
    double value = 0;
    std::from_chars(time.data(), time.data() + time.size(), value);
    return value;
}

}  // namespace

CourseSteps steps_of(const verify::Course& course, const verify::Names& names) {
    const auto name = [&](std::uint8_t step) {
        return names.steps[step].empty() ? fmt::format("{}", step) : names.steps[step];
    };
    CourseSteps steps;
    std::uint64_t time = 0;
    bool was_in_pos = false;
    std::uint16_t limit_ms = 0;
    for (const verify::PlayedScan& scan : course) {
        const bool in_pos = (scan.image & sequencer::kInPos) != 0;
        if (scan.after.step != scan.step) {
            steps.push_back({fmt::format("{}", time), name(scan.step), name(scan.after.step),
                             in_pos && !was_in_pos, in_pos, limit_ms});
            was_in_pos = in_pos;
            limit_ms = begins_move(scan) ? scan.after.timer : std::uint16_t{0};
        }
        time += scan.dt_ms;
    }
    return steps;
}

CourseSteps steps_in_timeline(std::string_view printed) {
    CourseSteps steps;
    while (!printed.empty()) {
        const std::string_view line = printed.substr(0, printed.find('\n'));
        printed.remove_prefix(std::min(line.size() + 1, printed.size()));
        const std::size_t arrow = line.find(kArrow);
        if (arrow == std::string_view::npos) continue;
        steps.push_back({.time = std::string(first_word(line)),
                         .from = std::string(last_word(line.substr(0, arrow))),
                         .to = std::string(first_word(line.substr(arrow + kArrow.size()))),
                         .has_in_pos = line.find(", in position") != std::string_view::npos});
    }
    return steps;
}

Deviation where_it_leaves(const CourseSteps& course, const CourseSteps& rehearsal) {
    const auto is_same = [](const StepChange& a, const StepChange& b) {
        return a.from == b.from && a.to == b.to;
    };
    const auto [wanted, did] =
        std::mismatch(course.begin(), course.end(), rehearsal.begin(), rehearsal.end(), is_same);
    if (wanted == course.end() && did == rehearsal.end())
        return {"it goes through the steps of the course, and not to its end"};
    if (wanted == course.end())
        return {fmt::format("it goes through the steps of the course and leaves the last one, {}, at {} ms, "
                            "before the course ends",
                            did->from, did->time),
                did->has_in_pos};
    const std::string goes =
        did == rehearsal.end() ? "it stays there" : fmt::format("it goes to {} at {} ms", did->to, did->time);
    if (did != rehearsal.end() && did->from != wanted->from)
        return {fmt::format("in step {}, to which the course does not come, {}", did->from, goes)};
    const double entered = did == rehearsal.begin() ? 0 : milliseconds(std::prev(did)->time);
    if (did != rehearsal.end() && wanted->has_in_pos && wanted->limit_ms != 0 &&
        milliseconds(did->time) - entered >= wanted->limit_ms)
        return {fmt::format(
                    "in step {} the course goes to {} with INPOS, and the move takes more than the {} ms of "
                    "the timer: {}",
                    wanted->from, wanted->to, wanted->limit_ms, goes),
                true};
    const char* why = wanted->gets_in_pos ? "INPOS does not come as in the course, which" : "the course";
    return {fmt::format("in step {} {} goes to {}, and {}", wanted->from, why, wanted->to, goes),
            wanted->has_in_pos || (did != rehearsal.end() && did->has_in_pos), wanted->has_in_pos};
}

}  // namespace nplc::seqc::cli
