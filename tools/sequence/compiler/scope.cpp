#include "compiler/scope.h"

#include <algorithm>

namespace nplc::seqc {

Scope::Scope(const ast::Program& program, std::string_view source, Report& report, Compilation& result)
    : report_(report),
      result_(result),
      motor_(source, report, result),
      names_(program, motor_, report),
      signals_(names_, report),
      steps_(report),
      values_(source, report, result, motor_, names_, steps_),
      set_points_(source, report, result, motor_, names_, values_) {
    Symbols& symbols = result.symbols;
    symbols.program = program.name.text;
    motor_.declare(program);
    steps_.declare(program, symbols);
    signals_.declare(program, symbols);
    names_.declare_constants(program, symbols);
    values_.declare_variables(program);
    set_points_.declare(program);
}

bool names_error(const ast::Expression& expression) {
    using Kind = ast::Expression::Kind;
    return expression.kind == Kind::error || expression.kind == Kind::any_error ||
           std::any_of(expression.operands.begin(), expression.operands.end(), names_error);
}

Truth Scope::truth_of(const ast::Expression& expression) {
    using Kind = ast::Expression::Kind;
    Truth truth;
    switch (expression.kind) {
        case Kind::constant:
            return expression.value ? always() : Truth();
        case Kind::any_error:
            return always();
        case Kind::in_pos:
            return truth_of_bit(kInPosBit);
        case Kind::error:
            return truth_of_bit(kErrorBit);
        case Kind::timer_q:
            return truth_of_bit(kTimerZero);
        case Kind::counter_q:
            return truth_of_bit(kCounterZero);
        case Kind::name: {
            const auto tested = input(expression.name);
            return tested ? tested->truth() : Truth();
        }
        case Kind::rising:
        case Kind::falling:
            return truth_of_edge(expression);
        case Kind::step:  // in properties only
            return {};
        case Kind::negation:
            return ~truth_of(expression.operands.front());
        case Kind::all_of:
            truth.set();
            for (const auto& operand : expression.operands) truth &= truth_of(operand);
            return truth;
        case Kind::any_of:
            for (const auto& operand : expression.operands) truth |= truth_of(operand);
            return truth;
        case Kind::odd_of:
            for (const auto& operand : expression.operands) truth ^= truth_of(operand);
            return truth;
    }
    return truth;
}

Truth Scope::truth_of_edge(const ast::Expression& expression) {
    const auto tested = input(expression.name);
    if (!tested) return {};
    if (edges_ == nullptr) {
        report_.add("E066", expression.span, "an edge can be seen only by a branch of a step",
                    "write IF R_TRIG(..) in the step; what many steps have in common, OUT and TERM take the "
                    "input itself");
        return {};
    }
    const bool rising = expression.kind == ast::Expression::Kind::rising;
    for (std::size_t i = 0; i < edges_->size(); ++i) {
        const Edge& edge = (*edges_)[i];
        if (edge.bit == tested->bit && edge.rising == (rising == tested->level))
            return Memory::is_armed(armed_, i) ? edge.seen() : Truth();
    }
    return {};
}

Truth Scope::branch_truth(const ast::Expression& condition) {
    const Truth truth = truth_of(condition);
    return names_error(condition) ? truth : truth & ~truth_of_bit(kErrorBit);
}

}  // namespace nplc::seqc
