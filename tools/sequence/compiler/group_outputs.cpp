#include "compiler/group_outputs.h"

#include <bitset>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "compiler/on_conditions.h"
#include "language/names.h"

namespace nplc::seqc {
namespace {

using Steps = std::bitset<64>;

/// The steps of each group; a group may name those above it. Groups that stand twice and missing steps are
/// reported elsewhere too.
class Groups {
  public:
    Groups(const ast::Program& program, Scope& scope) : scope_(scope) {
        for (const ast::Group& group : program.groups) names_.push_back(group.name.text);
        for (const ast::Group& group : program.groups) {
            const Steps steps = all_of(group.steps);
            groups_.try_emplace(upper(group.name.text), steps);
        }
    }

    Steps all_of(const std::vector<ast::Name>& names) {
        Steps steps;
        for (const ast::Name& name : names) {
            const auto group = groups_.find(upper(name.text));
            if (group != groups_.end()) {
                steps |= group->second;
            } else if (const auto number = scope_.step(name, names_)) {
                steps.set(*number);
            }
        }
        return steps;
    }

  private:
    Scope& scope_;
    std::vector<std::string_view> names_;
    std::map<std::string, Steps> groups_;
};

}  // namespace

void spread_outputs(ast::Program& program, Scope& scope) {
    if (program.group_outputs.empty()) return;
    std::vector<std::pair<std::uint8_t, ast::Step*>> numbered;
    for (ast::Step& step : program.steps) {
        if (scope.step_named(step.name.text) != &step) continue;  // it stands twice
        const auto number = scope.step(step.name);
        if (number && *number <= kLastNamed) numbered.emplace_back(*number, &step);
    }
    Groups groups(program, scope);
    for (const ast::GroupOutput& spread : program.group_outputs) {
        const Steps named = groups.all_of(spread.only);
        Steps steps = named;
        for (const ast::Name& name : spread.except) {
            const Steps left_out = groups.all_of({name});
            if (left_out.any() && (left_out & named).none()) warn_of_idle_except(name, scope);
            steps &= ~left_out;
        }
        for (const auto& [number, step] : numbered) {
            if (steps.test(number))
                step->outputs.insert(step->outputs.end(), spread.outputs.begin(), spread.outputs.end());
        }
    }
}

}  // namespace nplc::seqc
