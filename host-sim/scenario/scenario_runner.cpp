#include "sim/scenario_runner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nplc::sim {
namespace {

constexpr int kMostRoundsAtOnce = 100;

void earliest(std::optional<Time>& best, std::optional<Time> candidate, Time after) {
    if (candidate && *candidate > after && (!best || *candidate < *best)) best = candidate;
}

/// The actions that `cancel` can name.
struct KindOfAction {
    using What = action::Cancel::What;
    What operator()(const action::SetInput&) const { return What::input; }
    What operator()(const action::ToggleInput&) const { return What::input; }
    What operator()(const action::Cancel&) const { return What::all; }
    What operator()(const action::CutLine&) const { return What::line; }
    What operator()(const action::SpoilLine&) const { return What::line; }
    What operator()(const action::Seed&) const { return What::line; }
    What operator()(const action::Gateway&) const { return What::gateway; }
    What operator()(const action::Breakpoints&) const { return What::gateway; }
    What operator()(const action::ForceSignals&) const { return What::gateway; }
    What operator()(const action::SetPoints&) const { return What::gateway; }
    What operator()(const action::Log&) const { return What::log; }
    What operator()(const action::End&) const { return What::end; }
    template <class Motor>
    What operator()(const Motor&) const {
        return What::motor;
    }
};

bool is_dropped(const Action& action, const action::Cancel& by) {
    using What = action::Cancel::What;
    const What kind = std::visit(KindOfAction{}, action.what);
    if (by.what == What::all) return kind != What::end;
    if (kind != by.what) return false;
    if (const auto* set = std::get_if<action::SetInput>(&action.what)) return set->index == by.index;
    if (const auto* toggle = std::get_if<action::ToggleInput>(&action.what)) return toggle->index == by.index;
    return true;
}

/// Awaited as P_IST = 80 mm.
bool is_quantity(const Condition& condition) {
    const Value::Kind kind = condition.value.kind;
    return condition.kind == Condition::Kind::compare && condition.relation == Condition::Relation::equal &&
           (kind == Value::Kind::p_ist || kind == Value::Kind::v_ist || kind == Value::Kind::shaft ||
            kind == Value::Kind::torque);
}

}  // namespace

ScenarioRunner::ScenarioRunner(const Scenario& scenario, const Names& names, Stage& stage)
    : scenario_(scenario), names_(names), stage_(stage) {
    for (const AtRule& rule : scenario_.at) plan(rule.actions, rule.time, 0, false);
    followed_.resize(scenario_.follow.size());
    for (const EveryRule& rule : scenario_.every) every_next_.push_back(rule.from);
    for (const WhenRule& rule : scenario_.when) watches_.push_back({EventWatch(rule.event)});
    for (const Expectation& expectation : scenario_.expectations) judgements_.emplace_back(expectation);
}

void ScenarioRunner::plan(const Actions& actions, Time now, int line, bool by_rule) {
    ++batches_;
    for (const Action& action : actions)
        planned_.emplace(now + action.after, Planned{&action, line, by_rule, batches_});
}

void ScenarioRunner::plan_every(Time now) {
    for (std::size_t i = 0; i < scenario_.every.size(); ++i) {
        const EveryRule& rule = scenario_.every[i];
        while (every_next_[i] <= now && (!rule.until || every_next_[i] <= *rule.until)) {
            plan(rule.actions, every_next_[i], 0, true);
            every_next_[i] += rule.period;
        }
    }
}

std::optional<Time> ScenarioRunner::next_due() const {
    std::optional<Time> best;
    if (!planned_.empty()) best = planned_.begin()->first;
    for (const Time time : every_next_) earliest(best, time, last_shown_);
    for (const Watched& watched : watches_) earliest(best, watched.watch.due(), last_shown_);
    for (const Followed& followed : followed_) earliest(best, followed.due, last_shown_);
    for (const Judgement& judgement : judgements_) {
        if (judgement.decided) continue;
        const Expectation& wanted = *judgement.expectation;
        earliest(best, wanted.time, last_shown_);
        earliest(best, wanted.from, last_shown_);
        earliest(best, judgement.watch.due(), last_shown_);
        if (judgement.since) earliest(best, *judgement.since + wanted.hold, last_shown_);
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
        if (now < rule.from || (rule.until && now > *rule.until)) continue;
        if (++watches_[i].happened < rule.times) continue;
        watches_[i].done = rule.once;
        plan(rule.actions, now, rule.line, true);
    }
    const bool followed = follow(snapshot);
    const bool acted = act(now);
    if (scenario_.end && now >= *scenario_.end) ended_ = true;
    return followed || acted;
}

/// At the start an input has the value of its condition.
bool ScenarioRunner::follow(const Snapshot& snapshot) {
    bool any = false;
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        const FollowRule& rule = scenario_.follow[i];
        Followed& followed = followed_[i];
        const bool wanted = rule.condition.holds(snapshot, names_);
        if (followed.wanted != wanted) {
            const Time delay = !followed.wanted ? Time{0} : wanted ? rule.after : rule.back;
            followed = {wanted, snapshot.time + delay};
        }
        if (!followed.due || *followed.due > snapshot.time) continue;
        followed.due.reset();
        const bool level = wanted != rule.inverted;
        if ((snapshot.inputs >> rule.input & 1) == (level ? 1 : 0)) continue;
        guard_against_loops(snapshot.time, rule.line);
        stage_.set_input(rule.input, level);
        any = true;
    }
    return any;
}

void ScenarioRunner::cancel(const action::Cancel& what, std::uint64_t batch) {
    std::erase_if(planned_, [&](const auto& entry) {
        const Planned& planned = entry.second;
        return planned.by_rule && planned.batch < batch && is_dropped(*planned.action, what);
    });
    using What = action::Cancel::What;
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        if (what.what == What::all || (what.what == What::input && what.index == scenario_.follow[i].input))
            followed_[i].due.reset();
    }
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
        perform(planned);
        acted = true;
    }
    return acted;
}

void ScenarioRunner::perform(const Planned& planned) {
    struct Performer {
        ScenarioRunner& self;
        std::uint64_t batch;
        bool by_rule;
        void operator()(const action::SetInput& a) const { self.stage_.set_input(a.index, a.level); }
        void operator()(const action::ToggleInput& a) const { self.stage_.toggle_input(a.index); }
        /// The cancel of a rule drops what rules have planned before it; one with a time of its own all that
        /// rules have planned.
        void operator()(const action::Cancel& a) const { self.cancel(a, by_rule ? batch : UINT64_MAX); }
        void operator()(const action::CutLine& a) const { self.stage_.cut_line(a.cut); }
        void operator()(const action::SpoilLine& a) const { self.stage_.spoil_line(a); }
        void operator()(const action::Seed& a) const { self.stage_.seed(a.value); }
        void operator()(const action::FailMotor&) const { self.stage_.fail_motor(); }
        void operator()(const action::PowerMotor& a) const { self.stage_.power_motor(a.on); }
        void operator()(const action::OnMotor& a) const { self.stage_.act(a); }
        void operator()(const action::Gateway& a) const { self.stage_.gateway(a); }
        void operator()(const action::Breakpoints& a) const { self.stage_.set_breakpoints(a); }
        void operator()(const action::ForceSignals& a) const { self.stage_.force(a); }
        void operator()(const action::SetPoints& a) const { self.stage_.set_points(a); }
        void operator()(const action::Log& a) const { self.stage_.log(a.text); }
        void operator()(const action::End&) const { self.ended_ = true; }
    };
    std::visit(Performer{*this, planned.batch, planned.by_rule}, planned.action->what);
}

void ScenarioRunner::finish(const Snapshot& snapshot) {
    for (Judgement& judgement : judgements_) {
        if (!judgement.decided) judge_at_end(judgement, snapshot);
    }
    std::sort(outcomes_.begin(), outcomes_.end(),
              [](const ExpectationResult& a, const ExpectationResult& b) { return a.line < b.line; });
}

std::size_t ScenarioRunner::failures() const {
    return static_cast<std::size_t>(std::count_if(outcomes_.begin(), outcomes_.end(),
                                                  [](const ExpectationResult& o) { return !o.passed; }));
}

std::string ScenarioRunner::seen_at(const Condition& condition, const Snapshot& snapshot) const {
    return fmt::format("at {} ms {}", in_milliseconds(snapshot.time), condition.seen(snapshot, names_));
}

void ScenarioRunner::decide(Judgement& judgement, bool passed, Time now, std::string seen) {
    judgement.decided = true;
    outcomes_.push_back(
        {judgement.expectation->line, judgement.expectation->text, passed, std::move(seen), now});
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
        case Expectation::Kind::during:
            return judge_during(judgement, snapshot);
        case Expectation::Kind::count:
            return judge_count(judgement, snapshot);
    }
}

bool ScenarioRunner::holds(Judgement& judgement, const Snapshot& snapshot) const {
    const Expectation& wanted = *judgement.expectation;
    if (!wanted.condition.holds(snapshot, names_)) {
        judgement.since.reset();
        return false;
    }
    if (!judgement.since) judgement.since = snapshot.time;
    return snapshot.time - *judgement.since >= wanted.hold;
}

/// Whether the event happens within its window.
bool ScenarioRunner::event_happens(Judgement& judgement, const Snapshot& snapshot) const {
    const Expectation& wanted = *judgement.expectation;
    return judgement.watch.happens(snapshot, names_) && snapshot.time >= wanted.from &&
           !(wanted.time && snapshot.time > *wanted.time);
}

void ScenarioRunner::judge_at(Judgement& judgement, const Snapshot& snapshot) {
    const Expectation& wanted = *judgement.expectation;
    const bool good = holds(judgement, snapshot);
    if (!wanted.time || snapshot.time < *wanted.time) return;
    decide(judgement, good, snapshot.time, seen_at(wanted.condition, snapshot));
}

void ScenarioRunner::judge_by(Judgement& judgement, const Snapshot& snapshot) {
    const Expectation& wanted = *judgement.expectation;
    if (holds(judgement, snapshot)) return decide(judgement, true, snapshot.time);
    if (is_quantity(wanted.condition)) {
        const double seen = wanted.condition.value.of(snapshot);
        const auto distance = [&](double value) { return std::abs(value - wanted.condition.operand); };
        if (!judgement.nearest || distance(seen) < distance(*judgement.nearest)) judgement.nearest = seen;
    }
    if (!wanted.time || snapshot.time < *wanted.time) return;
    decide(judgement, false, snapshot.time,
           "never until then; " + seen_at(wanted.condition, snapshot) + nearest_text(judgement));
}

std::string ScenarioRunner::nearest_text(const Judgement& judgement) const {
    const Condition& wanted = judgement.expectation->condition;
    if (!judgement.nearest) return {};
    return fmt::format("; the nearest was {}{}", wanted.in_its_unit(*judgement.nearest),
                       wanted.tolerance > 0 ? "" : ": give it a tolerance (+-)");
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
    const bool good = holds(judgement, snapshot);
    if (event_happens(judgement, snapshot)) {
        ++judgement.events;
        judgement.deadlines.push_back(snapshot.time + wanted.span);
    }
    if (judgement.deadlines.empty()) return;
    if (good && wanted.kind == Expectation::Kind::within) {
        judgement.fulfilled += judgement.deadlines.size();
        judgement.deadlines.clear();
        return;
    }
    const auto due = std::find_if(judgement.deadlines.begin(), judgement.deadlines.end(),
                                  [&](Time deadline) { return deadline <= snapshot.time; });
    if (due == judgement.deadlines.end()) return;
    if (!good) {
        const Time event_time = *due - wanted.span;
        return decide(judgement, false, snapshot.time,
                      fmt::format("{}, {} after {} ({} ms)", seen_at(wanted.condition, snapshot),
                                  in_words(wanted.span), wanted.event.text, in_milliseconds(event_time)));
    }
    ++judgement.fulfilled;
    judgement.deadlines.erase(due);
}

void ScenarioRunner::judge_during(Judgement& judgement, const Snapshot& snapshot) {
    const Expectation& wanted = *judgement.expectation;
    if (event_happens(judgement, snapshot)) {
        ++judgement.events;
        judgement.deadlines.push_back(snapshot.time + wanted.span);
    }
    if (!judgement.deadlines.empty() && !wanted.condition.holds(snapshot, names_)) {
        const Time event_time = judgement.deadlines.front() - wanted.span;
        return decide(judgement, false, snapshot.time,
                      fmt::format("{}, {} after {} ({} ms)", seen_at(wanted.condition, snapshot),
                                  in_words(snapshot.time - event_time), wanted.event.text,
                                  in_milliseconds(event_time)));
    }
    judgement.fulfilled +=
        std::erase_if(judgement.deadlines, [&](Time deadline) { return deadline <= snapshot.time; });
}

void ScenarioRunner::judge_count(Judgement& judgement, const Snapshot& snapshot) {
    const Expectation& wanted = *judgement.expectation;
    if (wanted.time && snapshot.time > *wanted.time) return judge_at_end(judgement, snapshot);
    if (event_happens(judgement, snapshot)) ++judgement.events;
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
            return decide(judgement, holds(judgement, snapshot), snapshot.time,
                          seen_at(wanted.condition, snapshot));
        case Expectation::Kind::by:
            return decide(judgement, false, snapshot.time,
                          "never; " + seen_at(wanted.condition, snapshot) + nearest_text(judgement));
        case Expectation::Kind::always:
            if (snapshot.time < wanted.from) {
                return decide(judgement, false, snapshot.time, end + ", before the time to look at");
            }
            return decide(judgement, true, snapshot.time);
        case Expectation::Kind::within:
        case Expectation::Kind::after:
        case Expectation::Kind::during:
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
