#include "analysis/course_scenario.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "analysis/story.h"

namespace nplc::verify {
namespace {

/// Milliseconds until a scan reads a changed input; kSeen includes one more scan.
constexpr std::uint64_t kDebounce = 3;
constexpr std::uint64_t kSeen = kDebounce + 2;
/// For moves that end at once in a course.
constexpr std::uint64_t kLimit = 60'000;

/// An event that a scenario can wait for, at the end of a scan of the course.
struct Anchor {
    std::string event = "RUNNING";
    std::uint64_t times = 1;
    std::uint64_t at = 0;

    std::string counted() const { return times == 1 ? event : fmt::format("{} {} times", event, times); }
};

/// Finds the anchors along a course: entry of a step, and INPOS during a step.
class Anchors {
  public:
    explicit Anchors(const Names& names) : names_(names) { happened_[entry(0)] = 1; }

    const Anchor& latest() const { return latest_; }
    /// The one so many step changes before.
    Anchor before(std::size_t steps) const {
        return steps > earlier_.size() ? Anchor{} : earlier_[earlier_.size() - steps];
    }

    /// Before the scan's own changes of inputs are placed.
    void note_in_pos(const PlayedScan& scan, std::uint64_t time) {
        const bool in_pos = (scan.image & sequencer::kInPos) != 0;
        const bool comes = in_pos && !was_in_pos_ && scan.after.step == scan.step;
        was_in_pos_ = in_pos;
        if (comes) drop(entry(scan.step) + " and INPOS", time);
    }

    void note_step(const PlayedScan& scan, std::uint64_t time) {
        const std::uint8_t next = scan.after.step;
        if (next == scan.step) return;
        earlier_.push_back(latest_);
        if (base_of(next) != base_of(scan.step)) {
            drop(entry(base_of(next)), time);
        }
        if (base_of(next) != next) drop(entry(next), time);
    }

  private:
    std::uint8_t base_of(std::uint8_t step) const { return names_.copy_of[step].value_or(step); }
    std::string entry(std::uint8_t step) const { return "step = " + step_name(names_, step); }
    void drop(const std::string& event, std::uint64_t time) { latest_ = {event, ++happened_[event], time}; }

    const Names& names_;
    std::map<std::string, std::uint64_t> happened_;
    Anchor latest_;
    std::vector<Anchor> earlier_;
    bool was_in_pos_ = false;
};

/// Actions that lead from one image to the next; INPOS is set by the motor.
std::vector<std::string> actions_between(std::uint8_t before, std::uint8_t image, const Names& names) {
    std::vector<std::string> actions;
    for (unsigned i = 0; i < 6; ++i) {
        if (((unsigned{before} ^ image) >> i & 1U) != 0)
            actions.push_back(
                fmt::format("{} := {}", input_name(names, i), input_holds(names, i, image) ? 1 : 0));
    }
    if ((image & ~unsigned{before} & sequencer::kError) != 0) actions.emplace_back("motor error");
    return actions;
}

class Writer {
  public:
    Writer(const Result& result, const Names& names, const ScenarioOptions& options)
        : result_(result), names_(names), options_(options), anchors_(names) {}

    std::string text() {
        add_head();
        for (const PlayedScan& scan : *result_.course) add(scan);
        add_end();
        return text_;
    }

  private:
    void add_head() {
        text_ = fmt::format(
            "# {}: {}\n# {}.\n# Inputs follow the steps of the course; the motor takes the time it "
            "needs.\n\n",
            result_.name, result_.text, result_.reason);
        for (const std::string& line : options_.plant) text_ += line + "\n";
        if (!options_.plant.empty()) text_ += "\n";
        for (const SetValue& value : result_.set_values)
            text_ += fmt::format("{}{} := {}", &value == &result_.set_values.front() ? "set " : " and ",
                                 value.name, value.text);
        if (!result_.set_values.empty()) text_ += "\n";
    }

    void add(const PlayedScan& scan) {
        anchors_.note_in_pos(scan, time_);
        const std::vector<std::string> actions = actions_between(image_, scan.image, names_);
        image_ = scan.image;
        const bool leaves = scan.after.step != scan.step;
        const bool is_late = options_.changes_late && leaves && time_ != 0;
        if (is_late) anchors_.note_step(scan, time_);
        if (!actions.empty()) place(fmt::format("{}", fmt::join(actions, ", ")));
        if (!is_late) anchors_.note_step(scan, time_);
        if (!actions.empty()) changed_ = time_;
        if (leaves) changed_.reset();
        time_ += scan.dt_ms;
        waited_ = scan.dt_ms;
        is_first_ = false;
    }

    /// Early enough for this scan to read the change, if then the scan before does not read it yet.
    void place(const std::string& actions) {
        if (is_first_) {
            text_ += actions + "\n";
            return;
        }
        if (options_.ahead_ms != 0 && time_ - anchors_.latest().at <= kDebounce) {
            const Anchor before = anchors_.before(options_.steps_back);
            text_ += fmt::format("once {}{} {}\n", before.counted(),
                                 after(time_ - before.at + options_.ahead_ms), actions);
            return;
        }
        const Anchor& anchor = anchors_.latest();
        const std::uint64_t early = waited_ > kDebounce + 1 && anchor.at != time_ ? kDebounce + 1 : 0;
        text_ += fmt::format("once {}{} {}\n", anchor.counted(), after(time_ - anchor.at - early), actions);
    }

    static std::string after(std::uint64_t ms) { return ms == 0 ? "" : fmt::format(" after {} ms", ms); }

    void add_end() {
        const Course& course = *result_.course;
        const sequencer::State& end = course.back().after;
        const std::uint64_t ends = result_.is_late ? time_ : time_ - course.back().dt_ms;
        const Anchor& anchor = anchors_.latest();
        const std::uint64_t wait = ends - anchor.at + (changed_ || result_.is_late ? kSeen : 0);
        const bool lasts = wait != 0 && anchor.times == 1;
        const std::string event = lasts ? fmt::format("{} for {} ms", anchor.event, wait) : anchor.event;
        const std::string shown = result_.code.empty() ? result_.name + " breaks" : result_.code + " shows";
        text_ += fmt::format("once {}{} log \"here {}\", end\n\n", lasts ? event : anchor.counted(),
                             lasts ? "" : after(wait), shown);
        text_ +=
            fmt::format("expect {} at least {} time{}\n", event, anchor.times, anchor.times == 1 ? "" : "s");
        text_ += fmt::format("expect step = {}{}\nend at {} ms\n", step_name(names_, end.step),
                             outputs_wanted(end.outputs), ends + kLimit);
    }

    /// Those that the program has.
    std::string outputs_wanted(std::uint8_t outputs) const {
        std::string text;
        for (unsigned i = 0; i < 4; ++i) {
            const bool is_on = (unsigned{outputs} >> i & 1U) != 0;
            const bool is_spare = names_.outputs[i] == fmt::format("OUT{}", i);
            if (is_on || !is_spare)
                text += fmt::format(" and {}{}", is_on ? "" : "not ", output_name(names_, i));
        }
        return text;
    }

    const Result& result_;
    const Names& names_;
    const ScenarioOptions& options_;
    Anchors anchors_;
    std::string text_;
    bool is_first_ = true;
    std::uint64_t time_ = 0;
    std::uint64_t waited_ = 0;  ///< since the scan before
    std::uint8_t image_ = 0;
    std::optional<std::uint64_t> changed_;  ///< an input, since the step was entered
};

}  // namespace

std::string scenario_of(const Result& result, const Names& names, const ScenarioOptions& options) {
    if (result.course->empty()) return {};
    return Writer(result, names, options).text();
}

}  // namespace nplc::verify
