#include "verify/story.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace nplc::verify {
namespace {

std::string listed(const std::vector<std::string>& words) {
    return words.empty() ? "-" : fmt::format("{}", fmt::join(words, ","));
}

std::string image_text(std::uint8_t image, const Names& names) {
    std::vector<std::string> on;
    for (unsigned i = 0; i < 6; ++i) {
        if (((unsigned{image} >> i) & 1U) != 0)
            on.push_back(names.inputs[i].empty() ? fmt::format("IN{}", i) : names.inputs[i]);
    }
    if ((image & sequencer::kInPos) != 0) on.emplace_back("INPOS");
    if ((image & sequencer::kError) != 0) on.emplace_back("ERROR");
    return listed(on);
}

std::string orders_text(const std::vector<sequencer::MotorOrder>& orders) {
    std::string text;
    for (const auto& order : orders) {
        text += order.is_register_write ? fmt::format(" {}={}", order.reg, order.value)
                                        : fmt::format(" {:02X}h", order.command);
    }
    return text;
}

/// Actions that lead from one image to the next; what INPOS does is the motor's.
std::vector<std::string> actions_between(std::uint8_t before, std::uint8_t image) {
    std::vector<std::string> actions;
    for (unsigned i = 0; i < 6; ++i) {
        if (((unsigned{before} ^ image) >> i & 1U) != 0)
            actions.push_back(fmt::format("IN{} := {}", i, (unsigned{image} >> i) & 1U));
    }
    if ((image & ~unsigned{before} & sequencer::kError) != 0) actions.emplace_back("motor error");
    return actions;
}

/// Steps that a course enters once only: their entry is an event to wait for.
std::array<unsigned, 64> entries_of(const Course& course) {
    std::array<unsigned, 64> entries{};
    for (const PlayedScan& scan : course) {
        if (scan.after.step != scan.step) ++entries[scan.after.step];
    }
    return entries;
}

}  // namespace

std::string outputs_text(std::uint8_t outputs, const Names& names) {
    std::vector<std::string> on;
    for (unsigned i = 0; i < 4; ++i) {
        if (((unsigned{outputs} >> i) & 1U) != 0)
            on.push_back(names.outputs[i].empty() ? fmt::format("OUT{}", i) : names.outputs[i]);
    }
    return listed(on);
}

std::string step_name(const Names& names, std::uint8_t step) {
    return names.steps[step].empty() ? fmt::format("{}", step) : names.steps[step];
}

std::string story_of(const Course& course, const Names& names) {
    std::string text =
        fmt::format("  {:>9}  {:<24} {:<28} {:<20} {}\n", "ms", "on", "step", "outputs", "timer counter");
    std::uint64_t time = 0;
    std::size_t scans = 0;
    for (const PlayedScan& scan : course) {
        if (!scan.repeats) {
            const std::string steps =
                scan.step == scan.after.step
                    ? step_name(names, scan.step)
                    : fmt::format("{} -> {}", step_name(names, scan.step), step_name(names, scan.after.step));
            std::string line =
                fmt::format("  {:>9}  {:<24} {:<28} {:<20} {} {}", time, image_text(scan.image, names), steps,
                            outputs_text(scan.after.outputs, names), scan.after.timer, scan.after.counter);
            if (!scan.orders.empty()) line += fmt::format("  sends{}", orders_text(scan.orders));
            text += line + "\n";
        }
        ++scans;
        time += scan.dt_ms;
    }
    return text + fmt::format("  {} scan{}, then {} ms\n", scans, scans == 1 ? "" : "s",
                              course.empty() ? 0 : course.back().dt_ms);
}

std::string stimulus_of(const Course& course) {
    std::string text = "dt_ms,inputs,inpos,error\n";
    for (const PlayedScan& scan : course) {
        text += fmt::format("{},{},{},{}\n", scan.dt_ms, scan.image & sequencer::kInputsMask,
                            (scan.image & sequencer::kInPos) != 0 ? 1 : 0,
                            (scan.image & sequencer::kError) != 0 ? 1 : 0);
    }
    return text;
}

std::string trace_of(const Course& course) {
    std::string text = "time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist\n";
    const auto row = [&text](std::uint64_t time, const PlayedScan& scan, std::uint16_t timer,
                             std::string_view orders) {
        text += fmt::format("{},{},{},{},{},{},{},{},{},,\n", time, scan.after.step, timer,
                            scan.after.counter, scan.image & sequencer::kInputsMask, scan.after.outputs,
                            (scan.image & sequencer::kInPos) != 0 ? 1 : 0,
                            (scan.image & sequencer::kError) != 0 ? 1 : 0, orders);
    };
    std::uint64_t time = 0;
    for (const PlayedScan& scan : course) {
        const std::string orders = orders_text(scan.orders);
        row(time, scan, scan.after.timer, orders.empty() ? orders : orders.substr(1));
        time += scan.dt_ms;
    }
    if (course.empty()) return text;
    const PlayedScan& last = course.back();
    const std::uint32_t left = last.after.timer > last.dt_ms ? last.after.timer - last.dt_ms : 0;
    row(time + (last.dt_ms == 0 ? 1 : 0), last, static_cast<std::uint16_t>(left), "");
    return text;
}

std::string scenario_of(const Result& result, const Names& names) {
    const Course& course = *result.course;
    std::string text = fmt::format(
        "# {}: {}\n# {}.\n# Inputs as in the course that shows it; INPOS comes from the motor, so a course "
        "that needs it "
        "at another\n# time than the motor's is not followed.\n\n",
        result.name, result.text, result.reason);
    const auto entries = entries_of(course);
    std::string since = "at";  // an event, or the time from the beginning
    std::uint64_t begun = 0;
    std::uint64_t time = 0;
    std::uint8_t image = 0;
    for (const PlayedScan& scan : course) {
        const std::vector<std::string> actions = actions_between(image, scan.image);
        image = scan.image;
        if (!actions.empty()) {
            const std::string list = fmt::format("{}", fmt::join(actions, ", "));
            if (since != "at") {
                text += fmt::format("once {} after {} ms {}\n", since, time - begun, list);
            } else {
                text += time == 0 ? list + "\n" : fmt::format("at {} ms {}\n", time, list);
            }
        }
        if (scan.after.step != scan.step && entries[scan.after.step] == 1) {
            since = fmt::format("step = {}", step_name(names, scan.after.step));
            begun = time;
        }
        time += scan.dt_ms;
    }
    constexpr std::uint64_t kStartUp = 1'000;
    const sequencer::State& end = course.back().after;
    text += fmt::format("\nexpect eventually step = {} and OUTPUTS = {}\nend at {} ms\n",
                        step_name(names, end.step), end.outputs, time + kStartUp);
    return text;
}

}  // namespace nplc::verify
