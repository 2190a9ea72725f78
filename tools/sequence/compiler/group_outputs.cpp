#include "compiler/group_outputs.h"

#include <bitset>

#include "compiler/on_conditions.h"
#include "language/names.h"

namespace nplc::seqc {
namespace {

using Steps = std::bitset<64>;

std::vector<std::string_view> names_of(const std::vector<ast::Group>& groups) {
    std::vector<std::string_view> names;
    for (const ast::Group& group : groups) names.push_back(group.name.text);
    return names;
}

/// Only groups before `limit`; duplicates and missing steps are reported elsewhere.
Steps steps_of(const std::vector<ast::Name>& names, std::size_t limit, const ast::Program& program,
               Scope& scope) {
    Steps steps;
    for (const ast::Name& name : names) {
        std::size_t group = 0;
        while (group < limit && !same_name(program.groups[group].name.text, name.text)) ++group;
        if (group < limit) {
            steps |= steps_of(program.groups[group].steps, group, program, scope);
        } else if (const auto number = scope.step(name, names_of(program.groups))) {
            steps.set(*number);
        }
    }
    return steps;
}

}  // namespace

void spread_outputs(ast::Program& program, Scope& scope) {
    for (const ast::GroupOutput& spread : program.group_outputs) {
        const std::size_t groups = program.groups.size();
        const Steps named = steps_of(spread.only, groups, program, scope);
        Steps steps = named;
        for (const ast::Name& name : spread.except) {
            const Steps left_out = steps_of({name}, groups, program, scope);
            if (left_out.any() && (left_out & named).none()) warn_of_idle_except(name, scope);
            steps &= ~left_out;
        }
        for (std::size_t i = 0; i < scope.steps().size(); ++i) {
            if (!steps.test(scope.number_of(i))) continue;
            for (ast::Step& step : program.steps) {
                if (&step == scope.steps()[i])
                    step.outputs.insert(step.outputs.end(), spread.outputs.begin(), spread.outputs.end());
            }
        }
    }
}

}  // namespace nplc::seqc
