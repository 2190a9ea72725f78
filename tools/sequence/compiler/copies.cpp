#include "compiler/copies.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <compare>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compiler/copy_names.h"
#include "compiler/numbers_taken.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kNobody = SIZE_MAX;
constexpr std::size_t kMostCounted = 512;  ///< copies, when there are too many

/// The outcome in one case of a copy.
struct Outcome {
    std::size_t rule = kNobody;  ///< of the step's; none if no rule acts
    CopyKey to;
    std::uint16_t timer = 0;                   ///< preset by FOR or BLINKING
    std::optional<std::uint8_t> outputs = {};  ///< from OUT .. WHEN in another copy of the step
    bool stays = false;                        ///< in the same copy, without an action
    auto operator<=>(const Outcome&) const = default;
};

class Copies {
  public:
    Copies(Plan& plan, const SequenceCalls& calls, Compilation& result, Report& report)
        : plan_(plan), calls_(calls), result_(result), report_(report) {
        for (std::size_t i = 0; i < plan.steps.size(); ++i) {
            taken_.set(plan.steps[i].number);
            index_[plan.steps[i].number] = i;
        }
    }

    void run() {
        if (refuses_terms()) return;
        const auto zero = index_.find(0);
        reach(CopyKey{zero == index_.end() ? 0 : zero->second, 0, 0, 0}, {});
        for (std::size_t next = 0; next < order_.size() || reach_lost(); ++next) {
            if (report_.has_errors()) return;
            if (missing_ && order_.size() > kMostCounted) break;
            explore(order_[next]);
        }
        if (missing_) return refuse_for_room();
        std::vector<StepPlan> made;
        for (const CopyKey& key : order_) made.push_back(copy_of(key));
        name_copies(plan_, order_, made, result_);
        put_in_order(std::move(made));
    }

  private:
    const StepPlan& step(const CopyKey& key) const { return plan_.steps[key.step]; }

    const std::vector<Rule>& rules(const CopyKey& key) const {
        const StepPlan& from = step(key);
        return from.rules_in.empty() ? from.rules : from.rules_in[from.memory.state_of(key.memory, key.half)];
    }

    /// A TERM sets its own next step, and writes all outputs.
    bool refuses_terms() {
        const auto refuse = [&](Span term, Span other, const char* what) {
            report_
                .add("E075", term, fmt::format("a TERM cannot stand {}", what),
                     "write a branch instead of the TERM")
                .notes.push_back({other, "this asks the compiler for copies of steps"});
        };
        std::optional<Span> switches;
        for (const StepPlan& from : plan_.steps) {
            for_each_rule(from, [&](const Rule& rule) {
                if (rule.action.switches()) switches = rule.action.output_span;
            });
            if (!from.memory.is_empty() && !from.terms.empty()) {
                const Memory& memory = from.memory;
                refuse(from.terms.front().span,
                       memory.edges.empty() ? *memory.timer_span : memory.edges.front().span,
                       "in a step with R_TRIG, F_TRIG, FOR or BLINKING");
            }
        }
        if (!switches) return report_.has_errors();
        const RawTerm* term = plan_.terms.empty() ? nullptr : &plan_.terms.front();
        for (const StepPlan& from : plan_.steps) {
            if (!from.terms.empty()) term = &from.terms.front();
        }
        if (term != nullptr) refuse(term->span, *switches, "in a program with SET or RESET");
        return report_.has_errors();
    }

    /// The next unreachable step, if any.
    bool reach_lost() {
        for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
            const bool is_known =
                std::any_of(order_.begin(), order_.end(), [&](const CopyKey& key) { return key.step == i; });
            if (is_known) continue;
            reach(CopyKey{i, 0, 0, 0}, {});
            return true;
        }
        return false;
    }

    std::uint8_t reach(const CopyKey& key, Span way) {
        const auto known = numbers_.find(key);
        if (known != numbers_.end()) return known->second;
        const auto first = std::find_if(order_.begin(), order_.end(),
                                        [&](const CopyKey& other) { return other.step == key.step; });
        std::uint8_t number = step(key).number;
        if (first != order_.end()) {
            number = 1;
            while (number <= kLastNamed && taken_.test(number)) ++number;
            if (step(key).no_helper) refuse({key, *first, way}, "delete NO_HELPER", "");
            if (number <= kLastNamed)
                taken_.set(number);
            else if (!missing_)
                missing_ = {key, *first, way};
        }
        numbers_.emplace(key, number);
        ways_.emplace(key, way);
        order_.push_back(key);
        return number;
    }

    /// A copy that cannot be there.
    struct Refused {
        CopyKey key;
        CopyKey first;  ///< of the same step
        Span way;
    };

    Diagnostic& refuse(const Refused& refused, const char* remedy, const std::string& shortage) {
        const auto& [key, first, way] = refused;
        const StepPlan& from = step(key);
        const std::string shown = calls_.shown(from.name);
        const std::uint8_t differs = key.latched ^ first.latched;
        if (differs == 0) {
            const Memory& memory = from.memory;
            const Span place =
                memory.edges.empty() ? memory.timer_span.value_or(from.span) : memory.edges.front().span;
            const std::string why =
                memory.counts_halves()
                    ? fmt::format("{} needs {} copies of itself to count its WITHIN beside BLINKING", shown,
                                  memory.halves() - 1)
                    : fmt::format("{} needs a copy of itself for this", shown);
            Diagnostic& d = report_.add("E074", place, why, shortage + remedy);
            d.notes.push_back({from.span, "the step is here"});
            return d;
        }
        std::size_t bit = 0;
        while (((differs >> bit) & 1) == 0) ++bit;
        const std::string& name = result_.symbols.outputs[bit];
        const bool on = ((key.latched >> bit) & 1) != 0;
        Diagnostic& d = report_.add(
            "E074", from.span,
            fmt::format("{} is reached with '{}' on and with it off, which takes two steps of the table",
                        shown, name),
            fmt::format("{}{}, or let both ways do the same", shortage, remedy));
        const Span other = ways_.at(first);
        if (way.length != 0) d.notes.push_back({way, fmt::format("on this way it is {}", on ? "on" : "off")});
        if (other.length != 0)
            d.notes.push_back({other, fmt::format("on this way it is {}", on ? "off" : "on")});
        return d;
    }

    void refuse_for_room() {
        const std::size_t needed = order_.size() - index_.count(0);
        const bool is_counted = order_.size() <= kMostCounted;
        const std::string shortage = fmt::format(
            "{}{} numbers are needed and there are {}: {}{} are missing; ", is_counted ? "" : "more than ",
            needed, kLastNamed, is_counted ? "" : "more than ", needed - kLastNamed);
        const bool blinks = step(missing_->key).memory.counts_halves();
        Diagnostic& d =
            refuse(*missing_, blinks ? "blink slower, or let the limit be shorter" : "join steps", shortage);
        if (is_counted) note_numbers_taken(order_, plan_, calls_, d);
    }

    Outcome outcome(const CopyKey& key, std::size_t rule, std::size_t c) const {
        const StepPlan& from = step(key);
        const Action* action = rule == kNobody ? nullptr : &rules(key)[rule].action;
        Outcome result{rule, key, 0, {}, false};
        if (action != nullptr)
            result.to.latched = static_cast<std::uint8_t>((key.latched | action->sets) & ~action->resets);
        if (action != nullptr && leaves(from, rules(key)[rule])) {
            result.to = {index_.at(*action->next), 0, 0, result.to.latched};
            return result;
        }
        const Memory& memory = from.memory;
        result.to.memory = 0;
        for (std::size_t i = 0; i < memory.edges.size(); ++i) {
            if (memory.edges[i].arming().test(c)) result.to.memory |= std::size_t{1} << i;
        }
        if (memory.is_held() && memory.held.test(c)) {
            result.to.memory |= std::size_t{1} << memory.edges.size();
            if (!memory.runs(key.memory)) result.timer = memory.held_for;
        }
        if (memory.blinking != 0 && truth_of_bit(kTimerZero).test(c)) {
            result.to.half = memory.half_after(key.half);
            result.timer = memory.time_of(result.to.half);
        }
        result.stays = result.to == key && result.timer == 0;
        if (result.to != key && !from.conditional.empty()) result.outputs = outputs_in(result.to, c);
        return result;
    }

    std::uint8_t outputs_in(const CopyKey& key, std::size_t c) const {
        std::uint8_t outputs = plain_outputs(key);
        for (const ConditionalOutput& conditional : step(key).conditional) {
            if (conditional.when.test(c)) outputs |= conditional.outputs;
        }
        return outputs;
    }

    std::uint8_t plain_outputs(const CopyKey& key) const {
        const StepPlan& from = step(key);
        return static_cast<std::uint8_t>(from.outputs | key.latched |
                                         (key.is_dark() ? 0 : from.memory.blinking));
    }

    /// All outcomes of a copy, each with its cases.
    std::map<Outcome, Truth> outcomes(const CopyKey& key) const {
        std::array<std::size_t, kCases> owner{};
        owner.fill(kNobody);
        const std::vector<Rule>& own = rules(key);
        for (std::size_t r = 0; r < own.size(); ++r) {
            for (std::size_t c = 0; c < kCases; ++c) {
                if (own[r].when.test(c)) owner[c] = r;
            }
        }
        std::map<Outcome, Truth> result;
        const bool is_plain = step(key).memory.is_empty();
        for (std::size_t c = 0; c < kCases; ++c) {
            if (is_plain && owner[c] == kNobody) continue;
            result[outcome(key, owner[c], c)].set(c);
        }
        return result;
    }

    void explore(const CopyKey key) {
        for (const auto& [outcome, cases] : outcomes(key)) {
            const bool acts = outcome.rule != kNobody;
            reach(outcome.to, acts ? rules(key)[outcome.rule].action.next_span : Span{});
        }
    }

    StepPlan copy_of(const CopyKey& key) const {
        const StepPlan& from = step(key);
        StepPlan made = from;
        made.number = numbers_.at(key);
        made.is_copy = made.number != from.number;
        made.outputs = plain_outputs(key);
        made.rules_in.clear();
        if (!from.idle_in.empty()) made.idle = from.idle_in[from.memory.state_of(key.memory, key.half)];
        made.idle_in.clear();
        made.rules.clear();
        for (const auto& [outcome, cases] : outcomes(key)) {
            if (outcome.rule == kNobody && outcome.stays) continue;
            Rule rule = rule_of(key, outcome, cases);
            if (!rule.action.is_empty()) made.rules.push_back(std::move(rule));
        }
        return made;
    }

    Rule rule_of(const CopyKey& key, const Outcome& outcome, const Truth& cases) const {
        const StepPlan& from = step(key);
        Rule rule;
        rule.is_made = outcome.rule == kNobody;
        if (rule.is_made) {
            rule.action.span = from.memory.timer_span.value_or(
                from.memory.edges.empty() ? from.span : from.memory.edges.front().span);
        } else {
            rule = rules(key)[outcome.rule];
        }
        rule.when = cases;
        rule.to_copy = !outcome.stays && outcome.to.step == key.step && !leaves(from, rule);
        const auto finish = [&](Action& action) {
            action.sets = action.resets = 0;
            action.outputs = outcome.outputs;
            if (action.next || !outcome.stays) action.next = numbers_.at(outcome.to);
            if (outcome.timer != 0) action.timer = outcome.timer;
        };
        finish(rule.action);
        std::erase_if(rule.parts, [&](const RulePart& part) { return (part.when & cases).none(); });
        for (RulePart& part : rule.parts) {
            part.when &= cases;
            finish(part.action);
        }
        return rule;
    }

    /// Steps of the program keep their places; copies follow them.
    void put_in_order(std::vector<StepPlan> made) {
        const auto place = [&](const StepPlan& s) {
            return s.is_copy ? plan_.steps.size() : index_.at(s.number);
        };
        std::stable_sort(made.begin(), made.end(),
                         [&](const StepPlan& a, const StepPlan& b) { return place(a) < place(b); });
        plan_.steps = std::move(made);
    }

    Plan& plan_;
    const SequenceCalls& calls_;
    Compilation& result_;
    Report& report_;
    std::bitset<64> taken_;
    std::map<std::uint8_t, std::size_t> index_;  ///< in the plan, by number
    std::vector<CopyKey> order_;                 ///< in the order of their discovery
    std::map<CopyKey, std::uint8_t> numbers_;
    std::map<CopyKey, Span> ways_;
    std::optional<Refused> missing_;  ///< the first one without a number
};

}  // namespace

void make_copies(Plan& plan, const SequenceCalls& calls, Compilation& result, Report& report) {
    const bool is_needed = std::any_of(plan.steps.begin(), plan.steps.end(), [](const StepPlan& step) {
        return !step.memory.is_empty() ||
               std::any_of(step.rules.begin(), step.rules.end(),
                           [](const Rule& rule) { return rule.action.switches(); });
    });
    if (is_needed) Copies(plan, calls, result, report).run();
}

}  // namespace nplc::seqc
