#include <fmt/format.h>

#include <algorithm>

#include "sim/scenario_runner.h"

namespace nplc::sim {

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
