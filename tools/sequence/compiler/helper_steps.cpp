#include "compiler/helper_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>

#include "language/names.h"

namespace nplc::seqc {
namespace {

/// Cases by the zero flags: none, timer, counter, both.
enum Zeros : std::size_t { kNothingAt0, kTimerAt0, kCounterAt0, kBothAt0 };

constexpr std::size_t kInputCases = std::size_t{1} << kTimerZero;

std::size_t at_zeros(std::size_t point, std::size_t layer) {
    return point | (layer << kTimerZero);
}

/// A rule that no term can implement: the first input image that shows it.
struct Trouble {
    std::size_t acts = 0;        ///< a case in which the rule must act
    std::size_t must_not = 0;    ///< a case in which its terms would act as well
    bool is_sent_twice = false;  ///< instead, the order would be sent twice
};

std::optional<Trouble> trouble_of(const Rule& rule) {
    const bool sends = !rule.action.sends.empty();
    if (!sends && !rule.action.presets()) return std::nullopt;
    std::optional<Trouble> twice;
    for (std::size_t point = 0; point < kInputCases; ++point) {
        const auto holds = [&](std::size_t layer) { return rule.when.test(at_zeros(point, layer)); };
        for (std::size_t low : {kNothingAt0, kTimerAt0, kCounterAt0}) {
            for (std::size_t high : {kTimerAt0, kCounterAt0, kBothAt0}) {
                if (low != high && (low & high) == low && holds(low) && !holds(high))
                    return Trouble{at_zeros(point, low), at_zeros(point, high)};
            }
        }
        if (sends && !twice && !holds(kNothingAt0) && holds(kTimerAt0) && holds(kCounterAt0))
            twice = Trouble{at_zeros(point, kTimerAt0), at_zeros(point, kBothAt0), true};
    }
    return twice;
}

class HelperSteps {
  public:
    HelperSteps(Plan& plan, Compilation& result, Report& report)
        : plan_(plan), result_(result), report_(report) {
        for (const StepPlan& step : plan.steps) taken_.set(step.number);
    }

    void run() {
        const std::size_t written = plan_.steps.size();
        for (std::size_t s = 0; s < written; ++s) {
            for (std::size_t r = 0; r < plan_.steps[s].rules.size(); ++r) {
                const auto trouble = trouble_of(plan_.steps[s].rules[r]);
                if (trouble) resolve(s, r, *trouble);
            }
        }
    }

  private:
    void resolve(std::size_t s, std::size_t r, const Trouble& trouble) {
        const StepPlan& step = plan_.steps[s];
        const Rule& rule = step.rules[r];
        if (!rule.action.next || *rule.action.next == step.number) {
            return refuse(
                step, rule, trouble,
                "a branch that stays in its step gets no helper step: go on to another step, or test "
                "TIMER.Q or COUNTER.Q without NOT and in the branch that comes first");
        }
        if (step.no_helper) {
            return refuse(step, rule, trouble,
                          "delete NO_HELPER, test TIMER.Q or COUNTER.Q without NOT and in the branch that "
                          "comes first, or go to a step of its own");
        }
        const std::uint8_t number = helper_for(step, rule);
        if (number > kLastNamed) {
            return refuse(step, rule, trouble,
                          "there is no room for a helper step, all numbers are used: join steps, or test "
                          "TIMER.Q or COUNTER.Q in the branch that comes first");
        }
        Action& action = plan_.steps[s].rules[r].action;
        Action only_goes;
        only_goes.next = number;
        only_goes.span = action.span;
        only_goes.next_span = action.next_span;
        action = only_goes;
    }

    const StepPlan* step_numbered(std::uint8_t number) const {
        const auto found = std::find_if(plan_.steps.begin(), plan_.steps.end(),
                                        [&](const StepPlan& s) { return s.number == number; });
        return found == plan_.steps.end() ? nullptr : &*found;
    }

    std::vector<Rule> rules_of_helper(const StepPlan& step, const Rule& rule) const {
        const Truth error = truth_of_bit(kErrorBit);
        Rule acts{always(), rule.action, rule.condition, {}};
        if ((rule.when & error).any()) return {acts};
        acts.when = ~error;
        if (!step.own_error) {
            for (const Rule& other : step.rules) {
                if (other.when == error) return {acts, other};
            }
        }
        Rule back{error, {}, rule.condition, {}};
        back.action.next = step.number;
        back.action.span = rule.action.span;
        return {acts, back};
    }

    static bool same(const std::vector<Rule>& a, const std::vector<Rule>& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Rule& x, const Rule& y) {
            return x.when == y.when && x.action.same_effect(y.action);
        });
    }

    /// Its number; 62, which is no valid step, if there is no space.
    std::uint8_t helper_for(const StepPlan& step, const Rule& rule) {
        const std::vector<Rule> rules = rules_of_helper(step, rule);
        for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
            if (plan_.steps[i].is_helper && same(plan_.steps[i].rules, rules)) return plan_.steps[i].number;
        }
        std::uint8_t number = 1;
        while (number <= kLastNamed && taken_.test(number)) ++number;
        if (number > kLastNamed) return number;
        taken_.set(number);
        const StepPlan* target = step_numbered(*rule.action.next);
        StepPlan helper;
        helper.number = number;
        helper.name = plan_.names.emplace_back(free_step_name(
            plan_.steps, fmt::format("{}_to_{}", step.name, target == nullptr ? "POWER_UP" : target->name)));
        helper.span = rule.condition.length != 0 ? rule.condition : rule.action.span;
        helper.outputs = target == nullptr ? std::uint8_t{0} : target->outputs;
        helper.own_error = step.own_error;
        helper.is_helper = true;
        helper.rules = rules;
        result_.symbols.steps[number] = helper.name;
        result_.symbols.made_for[number] = fmt::format(
            "helper step: does in the scan after what a branch of '{}' needs a running timer or counter for",
            step.name);
        plan_.steps.push_back(std::move(helper));
        return number;
    }

    /// Marks the branch and its statement that cannot be cancelled.
    void refuse(const StepPlan& step, const Rule& rule, const Trouble& trouble, const char* help) {
        const auto part = std::find_if(rule.parts.begin(), rule.parts.end(),
                                       [&](const RulePart& p) { return p.when.test(trouble.acts); });
        const Action& action = part == rule.parts.end() ? rule.action : part->action;
        const Span cause = !action.sends.empty() ? action.sends.front().span
                           : action.timer        ? action.timer_span
                                                 : action.counter_span;
        const bool own =
            cause.offset >= action.span.offset && cause.offset < action.span.offset + action.span.length;
        const Span place = own ? cause : action.next_span;
        Diagnostic& d =
            trouble.is_sent_twice
                ? report_.add("E072", place,
                              "when TIMER.Q and COUNTER.Q hold together, this would be sent twice", help)
                : report_.add("E071", place,
                              fmt::format("this needs to know that the {} not run down, which a table "
                                          "cannot test",
                                          running_in(trouble)),
                              help);
        if (!own)
            d.notes.push_back(
                {cause, "it is this that cannot be taken back: the ENTRY of the step it goes to"});
        if (part != rule.parts.end() && part->condition.length != 0)
            d.notes.push_back({part->condition, "the branch is this one"});
        if (trouble.is_sent_twice) return;
        for (const Rule& other : step.rules) {
            for (const RulePart& earlier : other.parts) {
                if (!earlier.when.test(trouble.must_not) || earlier.condition.length == 0) continue;
                d.notes.push_back({earlier.condition, "this branch decides once it has run down"});
                return;
            }
        }
    }

    static const char* running_in(const Trouble& trouble) {
        const std::size_t zero = (trouble.must_not & ~trouble.acts) >> kTimerZero;
        return zero == kTimerAt0     ? "timer has"
               : zero == kCounterAt0 ? "counter has"
                                     : "timer and the counter have";
    }

    Plan& plan_;
    Compilation& result_;
    Report& report_;
    std::bitset<64> taken_;
};

}  // namespace

std::string free_step_name(const std::vector<StepPlan>& steps, std::string name) {
    constexpr std::size_t kLongestName = 56;
    if (name.size() > kLongestName) name.resize(kLongestName);
    const auto is_taken = [&](const std::string& wanted) {
        return std::any_of(steps.begin(), steps.end(),
                           [&](const StepPlan& s) { return same_name(s.name, wanted); });
    };
    std::string wanted = name;
    for (int n = 2; is_taken(wanted); ++n) wanted = fmt::format("{}_{}", name, n);
    return wanted;
}

void make_helper_steps(Plan& plan, Compilation& result, Report& report) {
    HelperSteps(plan, result, report).run();
}

}  // namespace nplc::seqc
