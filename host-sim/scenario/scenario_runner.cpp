#include "sim/scenario_runner.h"

#include <fmt/format.h>

#include <algorithm>

namespace nplc::sim {
namespace {

constexpr int kMostRoundsAtOnce = 100;

void earliest(std::optional<Time>& best, Time candidate, Time after) {
    if (candidate > after && (!best || candidate < *best)) best = candidate;
}

}  // namespace

ScenarioRunner::ScenarioRunner(const Scenario& scenario, const Names& names, Stage& stage)
    : scenario_(scenario), names_(names), stage_(stage) {
    for (const AtRule& rule : scenario_.at) plan(rule.actions, rule.time, 0);
    for (const EveryRule& rule : scenario_.every) every_next_.push_back(rule.from);
    for (const WhenRule& rule : scenario_.when) watches_.push_back({EventWatch(rule.event)});
    for (const Expectation& expectation : scenario_.expectations) judgements_.emplace_back(expectation);
}

void ScenarioRunner::plan(const Actions& actions, Time now, int line) {
    for (const Action& action : actions) planned_.emplace(now + action.after, Planned{&action, line});
}

void ScenarioRunner::plan_every(Time now) {
    for (std::size_t i = 0; i < scenario_.every.size(); ++i) {
        const EveryRule& rule = scenario_.every[i];
        while (every_next_[i] <= now && (!rule.until || every_next_[i] <= *rule.until)) {
            plan(rule.actions, every_next_[i], 0);
            every_next_[i] += rule.period;
        }
    }
}

std::optional<Time> ScenarioRunner::next_due() const {
    std::optional<Time> best;
    if (!planned_.empty()) best = planned_.begin()->first;
    for (const Time time : every_next_) earliest(best, time, last_shown_);
    for (const Judgement& judgement : judgements_) {
        if (judgement.decided) continue;
        if (judgement.expectation->time) earliest(best, *judgement.expectation->time, last_shown_);
        for (const Time deadline : judgement.deadlines) earliest(best, deadline, last_shown_);
    }
    if (scenario_.end) earliest(best, *scenario_.end, last_shown_);
    return best;
}

bool ScenarioRunner::observe(const Snapshot& snapshot) {
    const Time now = snapshot.time;
    if (now != last_shown_) rounds_ = 0;
    last_shown_ = now;
    for (Judgement& judgement : judgements_) judge(judgement, snapshot);
    plan_every(now);
    for (std::size_t i = 0; i < watches_.size(); ++i) {
        const WhenRule& rule = scenario_.when[i];
        if (!watches_[i].watch.happens(snapshot, names_) || watches_[i].done) continue;
        watches_[i].done = rule.once;
        plan(rule.actions, now, rule.line);
    }
    const bool acted = act(now);
    if (scenario_.end && now >= *scenario_.end) ended_ = true;
    return acted;
}

void ScenarioRunner::guard_against_loops(Time now, int line) {
    if (++rounds_ <= kMostRoundsAtOnce) return;
    throw EndlessRules(
        fmt::format("{}:{}: this rule and others set each other off without end at {} ms; put `after` and a "
                    "time into one of them",
                    scenario_.file, line, in_milliseconds(now)));
}

bool ScenarioRunner::act(Time now) {
    bool acted = false;
    while (!planned_.empty() && planned_.begin()->first <= now) {
        const Planned planned = planned_.begin()->second;
        planned_.erase(planned_.begin());
        if (planned.line != 0) guard_against_loops(now, planned.line);
        perform(*planned.action);
        acted = true;
    }
    return acted;
}

void ScenarioRunner::perform(const Action& action) {
    struct Performer {
        ScenarioRunner& self;
        void operator()(const action::SetInput& a) const { self.stage_.set_input(a.index, a.level); }
        void operator()(const action::ToggleInput& a) const { self.stage_.toggle_input(a.index); }
        void operator()(const action::CutLine& a) const { self.stage_.cut_line(a.cut); }
        void operator()(const action::SpoilLine& a) const { self.stage_.spoil_line(a); }
        void operator()(const action::Seed& a) const { self.stage_.seed(a.value); }
        void operator()(const action::FailMotor&) const { self.stage_.fail_motor(); }
        void operator()(const action::PowerMotor& a) const { self.stage_.power_motor(a.on); }
        void operator()(const action::LoadMotor& a) const { self.stage_.load_motor(a.torque); }
        void operator()(const action::MotorBrake& a) const { self.stage_.set_brake(a.torque); }
        void operator()(const action::StopMotor& a) const { self.stage_.stop_motor(a); }
        void operator()(const action::FreeMotor&) const { self.stage_.free_motor(); }
        void operator()(const action::MotorSensor& a) const { self.stage_.connect_sensor(a); }
        void operator()(const action::MotorAnalogue& a) const { self.stage_.set_analogue(a.volts); }
        void operator()(const action::MotorPulses& a) const { self.stage_.set_pulses(a); }
        void operator()(const action::MotorSupply& a) const { self.stage_.set_supply(a); }
        void operator()(const action::MotorTemperature& a) const { self.stage_.set_temperature(a.celsius); }
        void operator()(const action::BreakEncoder&) const { self.stage_.break_encoder(); }
        void operator()(const action::Gateway& a) const { self.stage_.gateway(a); }
        void operator()(const action::Log& a) const { self.stage_.log(a.text); }
        void operator()(const action::End&) const { self.ended_ = true; }
    };
    std::visit(Performer{*this}, action.what);
}

void ScenarioRunner::finish(const Snapshot& snapshot) {
    for (Judgement& judgement : judgements_) {
        if (!judgement.decided) judge_at_end(judgement, snapshot);
    }
    std::sort(outcomes_.begin(), outcomes_.end(),
              [](const Outcome& a, const Outcome& b) { return a.line < b.line; });
}

std::size_t ScenarioRunner::failures() const {
    return static_cast<std::size_t>(
        std::count_if(outcomes_.begin(), outcomes_.end(), [](const Outcome& o) { return !o.passed; }));
}

std::string ScenarioRunner::seen_at(const Condition& condition, const Snapshot& snapshot) const {
    return fmt::format("at {} ms {}", in_milliseconds(snapshot.time), condition.seen(snapshot, names_));
}

void ScenarioRunner::decide(Judgement& judgement, bool passed, Time now, std::string seen) {
    judgement.decided = true;
    outcomes_.push_back({judgement.expectation->line, judgement.expectation->text, passed, std::move(seen)});
    if (!passed && on_failure_) on_failure_(outcomes_.back(), now);
}

void ScenarioRunner::judge(Judgement& judgement, const Snapshot& snapshot) {
    if (judgement.decided) return;
    switch (judgement.expectation->kind) {
        case Expectation::Kind::at:
            return judge_at(judgement, snapshot);
        case Expectation::Kind::by:
            return judge_by(judgement, snapshot);
        case Expectation::Kind::always:
            return judge_always(judgement, snapshot);
        case Expectation::Kind::within:
        case Expectation::Kind::after:
            return judge_after_event(judgement, snapshot);
        case Expectation::Kind::count:
            return judge_count(judgement, snapshot);
    }
}

void ScenarioRunner::judge_at(Judgement& judgement, const Snapshot& snapshot) {
    const Expectation& wanted = *judgement.expectation;
    if (!wanted.time || snapshot.time < *wanted.time) return;
    decide(judgement, wanted.condition.holds(snapshot, names_), snapshot.time,
           seen_at(wanted.condition, snapshot));
}

void ScenarioRunner::judge_by(Judgement& judgement, const Snapshot& snapshot) {
    const Expectation& wanted = *judgement.expectation;
    if (wanted.condition.holds(snapshot, names_)) return decide(judgement, true, snapshot.time);
    if (!wanted.time || snapshot.time < *wanted.time) return;
    decide(judgement, false, snapshot.time, "never until then; " + seen_at(wanted.condition, snapshot));
}

void ScenarioRunner::judge_always(Judgement& judgement, const Snapshot& snapshot) {
    const Expectation& wanted = *judgement.expectation;
    if (snapshot.time < wanted.from) return;
    if (!wanted.condition.holds(snapshot, names_)) {
        return decide(judgement, false, snapshot.time, seen_at(wanted.condition, snapshot));
    }
    if (wanted.time && snapshot.time >= *wanted.time) decide(judgement, true, snapshot.time);
}

void ScenarioRunner::judge_after_event(Judgement& judgement, const Snapshot& snapshot) {
    const Expectation& wanted = *judgement.expectation;
    if (judgement.watch.happens(snapshot, names_)) {
        ++judgement.events;
        judgement.deadlines.push_back(snapshot.time + wanted.span);
    }
    if (judgement.deadlines.empty()) return;
    const bool holds = wanted.condition.holds(snapshot, names_);
    if (holds && wanted.kind == Expectation::Kind::within) {
        judgement.fulfilled += judgement.deadlines.size();
        judgement.deadlines.clear();
        return;
    }
    const auto due = std::find_if(judgement.deadlines.begin(), judgement.deadlines.end(),
                                  [&](Time deadline) { return deadline <= snapshot.time; });
    if (due == judgement.deadlines.end()) return;
    if (!holds) {
        const Time event_time = *due - wanted.span;
        return decide(judgement, false, snapshot.time,
                      fmt::format("{}, {} after {} ({} ms)", seen_at(wanted.condition, snapshot),
                                  in_words(wanted.span), wanted.event.text, in_milliseconds(event_time)));
    }
    ++judgement.fulfilled;
    judgement.deadlines.erase(due);
}

void ScenarioRunner::judge_count(Judgement& judgement, const Snapshot& snapshot) {
    const Expectation& wanted = *judgement.expectation;
    if (wanted.time && snapshot.time > *wanted.time) return judge_at_end(judgement, snapshot);
    if (judgement.watch.happens(snapshot, names_)) ++judgement.events;
    if (judgement.events > wanted.most) {
        decide(judgement, false, snapshot.time,
               fmt::format("at {} ms it happened for the {}. time", in_milliseconds(snapshot.time),
                           judgement.events));
    }
}

void ScenarioRunner::judge_at_end(Judgement& judgement, const Snapshot& snapshot) {
    const Expectation& wanted = *judgement.expectation;
    const std::string end = fmt::format("the run ended at {} ms", in_milliseconds(snapshot.time));
    const bool too_early = wanted.time && snapshot.time < *wanted.time;
    switch (wanted.kind) {
        case Expectation::Kind::at:
            if (too_early) return decide(judgement, false, snapshot.time, end + ", before that time");
            return decide(judgement, wanted.condition.holds(snapshot, names_), snapshot.time,
                          seen_at(wanted.condition, snapshot));
        case Expectation::Kind::by:
            return decide(judgement, false, snapshot.time, "never; " + seen_at(wanted.condition, snapshot));
        case Expectation::Kind::always:
            if (snapshot.time < wanted.from) {
                return decide(judgement, false, snapshot.time, end + ", before the time to look at");
            }
            return decide(judgement, true, snapshot.time);
        case Expectation::Kind::within:
        case Expectation::Kind::after:
            if (judgement.events == 0) {
                return decide(judgement, false, snapshot.time, wanted.event.text + " never happened; " + end);
            }
            return decide(judgement, judgement.fulfilled != 0, snapshot.time,
                          end + ", before the time was over");
        case Expectation::Kind::count:
            return decide(judgement, judgement.events >= wanted.least && judgement.events <= wanted.most,
                          snapshot.time,
                          fmt::format("until {} ms it happened {} times", in_milliseconds(snapshot.time),
                                      judgement.events));
    }
}

}  // namespace nplc::sim
