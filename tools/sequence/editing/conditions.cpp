#include "seqc/conditions.h"

#include <algorithm>

#include "editing/program.h"

#include "language/names.h"

namespace nplc::seqc {
namespace {

using analysis::Program;

using ast::Expression;

class Judge {
  public:
    Judge(const Program& program, const Seen& seen) : program_(program), seen_(seen) {}

    ConditionNow judge(const Expression& condition) {
        const ShownPlace place = program_.place_of(condition.span.offset);
        ConditionNow now{place.file->name, place.at.line, program_.text(condition.span), false, {}};
        now.holds = value_of(condition, now.parts);
        return now;
    }

  private:
    /// Evaluates every operand, so that every name is shown.
    bool value_of(const Expression& expression, std::vector<ConditionNow::Part>& parts) {
        std::size_t true_ones = 0;
        for (const Expression& operand : expression.operands)
            true_ones += static_cast<std::size_t>(value_of(operand, parts));
        switch (expression.kind) {
            case Expression::Kind::negation:
                return true_ones == 0;
            case Expression::Kind::all_of:
                return true_ones == expression.operands.size();
            case Expression::Kind::any_of:
                return true_ones > 0;
            case Expression::Kind::odd_of:
                return true_ones % 2 == 1;
            case Expression::Kind::constant:
                return expression.value;
            case Expression::Kind::any_error:
                return true;
            case Expression::Kind::rising:
            case Expression::Kind::falling:
                signal(expression, expression.name.text, parts);
                return false;  // when it becomes true, the step is left
            default:
                return signal(expression, program_.text(expression.span), parts);
        }
    }

    bool signal(const Expression& expression, std::string_view text, std::vector<ConditionNow::Part>& parts) {
        const bool level = level_of(expression);
        const bool known = std::any_of(parts.begin(), parts.end(),
                                       [&](const auto& part) { return same_name(part.text, text); });
        if (!known) parts.push_back({text, level});
        return level;
    }

    bool level_of(const Expression& expression) const {
        switch (expression.kind) {
            case Expression::Kind::in_pos:
                return seen_.in_position;
            case Expression::Kind::error:
                return seen_.error;
            case Expression::Kind::timer_q:
                return seen_.timer_ended;
            case Expression::Kind::counter_q:
                return seen_.counter_ended;
            default:
                return input_of(expression.name.text);
        }
    }

    /// By its name, or IN3 and %IX0.3.
    bool input_of(std::string_view name) const {
        const Symbols& symbols = program_.symbols();
        for (unsigned i = 0; i < symbols.inputs.size(); ++i) {
            if (same_name(symbols.inputs[i], name)) return is_on(i) != is_inverted(symbols, i);
        }
        return is_on(name.empty() ? 0 : static_cast<unsigned>(name.back() - '0') & 7U);
    }

    bool is_on(unsigned input) const { return (seen_.inputs >> input & 1) != 0; }

    const Program& program_;
    const Seen& seen_;
};

bool names_step(const Program& program, const std::vector<ast::Name>& names, std::string_view step) {
    return std::any_of(names.begin(), names.end(), [&](const ast::Name& name) {
        if (same_name(name.text, step)) return true;
        const auto& groups = program.tree().groups;
        const auto group = std::find_if(groups.begin(), groups.end(), [&](const ast::Group& one) {
            return same_name(one.name.text, name.text);
        });
        return group != groups.end() && names_step(program, group->steps, step);
    });
}

const ast::Step* step_named(const Program& program, std::string_view name) {
    const auto& steps = program.tree().steps;
    const auto found = std::find_if(steps.begin(), steps.end(),
                                    [&](const ast::Step& step) { return same_name(step.name.text, name); });
    if (found != steps.end()) return &*found;
    return same_name(name, "POWER_UP") && program.tree().power_up ? &*program.tree().power_up : nullptr;
}

}  // namespace

struct Conditions::Text {
    explicit Text(Sources sources) : program(std::move(sources)) {}
    Program program;
};

Conditions::Conditions(Sources sources) : text_(std::make_unique<const Text>(std::move(sources))) {}
Conditions::~Conditions() = default;

std::vector<ConditionNow> Conditions::of(std::string_view name, const Seen& seen) const {
    const Program& program = text_->program;
    std::vector<ConditionNow> list;
    const ast::Step* step = step_named(program, name);
    if (step == nullptr) return list;
    Judge judge(program, seen);
    for (const ast::ConditionalOutput& output : step->conditional)
        list.push_back(judge.judge(output.condition));
    for (const ast::Choice& choice : step->choices) {
        for (const ast::Branch& branch : choice.branches) {
            if (branch.condition) list.push_back(judge.judge(*branch.condition));
        }
    }
    for (const ast::RawTerm& term : step->terms) {
        if (term.symbols) list.push_back(judge.judge(term.symbols->condition));
    }
    std::sort(list.begin(), list.end(), [](const ConditionNow& a, const ConditionNow& b) {
        return a.text.data() < b.text.data();  // all from one source
    });
    for (const ast::OnCondition& on : program.tree().on_conditions) {
        const bool counts = on.only.empty() || names_step(program, on.only, name);
        if (counts && !names_step(program, on.except, name)) list.push_back(judge.judge(on.condition));
    }
    return list;
}

}  // namespace nplc::seqc
