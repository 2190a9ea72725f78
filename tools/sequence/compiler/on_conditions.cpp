#include "compiler/on_conditions.h"

#include <fmt/format.h>

#include <map>
#include <string>

#include "language/names.h"

namespace nplc::seqc {
namespace {

using Steps = std::bitset<64>;

class ConditionGroups {
  public:
    ConditionGroups(const ast::Program& program, Scope& scope) : scope_(scope) {
        for (const ast::Group& group : program.groups) {
            const Steps steps = all_of(group.steps);
            const auto [earlier, is_new] = groups_.try_emplace(upper(group.name.text), &group.name, steps);
            if (is_new) names_.push_back(group.name.text);
            const ast::Step* step = scope.step_named(group.name.text);
            if (is_new && step == nullptr) {
                scope.add_group(group.name.text, steps.to_ullong());
                continue;
            }
            scope.report()
                .add("E020", group.name.span,
                     fmt::format("'{}' is {} already", group.name.text, is_new ? "a step" : "a group"),
                     "give one of them another name")
                .notes.push_back(
                    {is_new ? step->name.span : earlier->second.first->span, "the first one is here"});
        }
    }

    Steps all_of(const std::vector<ast::Name>& names) {
        Steps steps;
        for (const ast::Name& name : names) {
            const auto group = groups_.find(upper(name.text));
            if (group != groups_.end()) {
                steps |= group->second.second;
            } else if (const auto number = scope_.step(name, names_)) {
                steps.set(*number);
            }
        }
        return steps;
    }

  private:
    Scope& scope_;
    std::map<std::string, std::pair<const ast::Name*, Steps>> groups_;
    std::vector<std::string_view> names_;  ///< of the groups so far
};

/// In its target step it has no effect.
void warn_if_nowhere(const OnCondition& on, Scope& scope) {
    Steps left = on.steps;
    for (std::size_t i = 0; i < scope.steps().size(); ++i) {
        if (same_name(scope.steps()[i]->name.text, on.written->next.name.text))
            left.reset(scope.number_of(i));
    }
    if (left.any() || on.written->only.empty() || on.steps.none()) return;
    scope.report().add("W001", on.written->condition.span,
                       "this condition has no effect: the step is the one it leads to",
                       "name in IN the steps that it is to end");
}

}  // namespace

void warn_of_idle_except(const ast::Name& name, Scope& scope) {
    scope.report().add("W001", name.span,
                       fmt::format("EXCEPT does nothing here: IN does not name '{}'", name.text),
                       "delete it, or name the intended steps behind IN");
}

namespace {

Steps all_steps(const Scope& scope) {
    Steps steps;
    for (std::size_t i = 0; i < scope.steps().size(); ++i) steps.set(scope.number_of(i));
    return steps;
}

}  // namespace

std::vector<OnCondition> on_conditions(const ast::Program& program, Scope& scope,
                                       std::optional<std::uint8_t> fault) {
    ConditionGroups groups(program, scope);
    std::vector<OnCondition> conditions;
    for (const ast::OnCondition& written : program.on_conditions) {
        const std::size_t errors = scope.report().error_count() + scope.faulty_names_met();
        OnCondition on{&written, scope.branch_truth(written.condition), {}};
        const bool is_sound = scope.report().error_count() + scope.faulty_names_met() == errors;
        if (!is_sound) on.when.reset();  // its value is unknown: it takes no cases from others
        if (on.when.none() && is_sound) {
            scope.report().add("W001", written.condition.span, "this condition never holds",
                               "it contradicts itself: correct it, or delete the line");
        }
        const std::size_t before_steps = scope.report().error_count() + scope.faulty_names_met();
        if (written.only.empty()) {
            on.steps = all_steps(scope);
            if (fault) on.steps.reset(*fault);
        } else {
            on.steps = groups.all_of(written.only);
        }
        const Steps named = on.steps;
        for (const ast::Name& name : written.except) {
            const Steps left_out = groups.all_of({name});
            if (left_out.any() && (left_out & named).none() && !written.only.empty())
                warn_of_idle_except(name, scope);
            on.steps &= ~left_out;
        }
        const bool names_are_known = scope.report().error_count() + scope.faulty_names_met() == before_steps;
        if (names_are_known)
            warn_if_nowhere(on, scope);
        else
            on.may_act = true;  // in the steps that are not known
        conditions.push_back(on);
    }
    return conditions;
}

}  // namespace nplc::seqc
