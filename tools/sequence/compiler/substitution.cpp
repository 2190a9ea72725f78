#include "compiler/substitution.h"

#include <cstddef>
#include <optional>
#include <utility>

#include "language/names.h"

namespace nplc::seqc {
namespace {

using ast::Statement;
using ast::Value;

}  // namespace

Substitution::Substitution(const std::vector<ast::Parameter>& parameters,
                           const std::vector<ast::Argument>& arguments, std::deque<std::string>& texts)
    : texts_(texts) {
    for (std::size_t i = 0; i < parameters.size(); ++i)
        arguments_.emplace(upper(parameters[i].name.text), &arguments[i]);
}

void Substitution::rename(std::string_view step, std::string_view name) {
    steps_.emplace(upper(step), name);
}

const ast::Argument* Substitution::argument_for(std::string_view name) const {
    const auto found = arguments_.find(upper(name));
    return found == arguments_.end() ? nullptr : found->second;
}

void Substitution::apply(ast::Step& step) const {
    apply(step.outputs);
    for (ast::ConditionalOutput& output : step.conditional) {
        apply(output.outputs);
        apply(output.condition);
    }
    for (ast::Blinking& output : step.blinking) {
        apply(output.outputs);
        apply(output.time);
    }
    apply(step.entry);
    for (ast::Choice& choice : step.choices) {
        for (ast::Branch& branch : choice.branches) {
            if (branch.condition) apply(*branch.condition);
            if (branch.timing) apply(branch.timing->time);
            apply(branch.statements);
        }
    }
}

void Substitution::apply(std::vector<Statement>& statements) const {
    for (Statement& statement : statements) apply(statement);
}

void Substitution::apply(Statement& statement) const {
    using StatementKind = Statement::Kind;
    switch (statement.kind) {
        case StatementKind::next:
            return apply_to_step(statement.name);
        case StatementKind::go_back:
            statement.kind = StatementKind::next;
            statement.name = {back_.text, statement.span};
            return;
        case StatementKind::call:
            for (ast::Argument& argument : statement.call) {
                if (argument.value) {
                    apply(*argument.value);
                } else if (const ast::Argument* given = argument_for(argument.name.text)) {
                    argument = *given;
                } else {
                    apply_to_step(argument.name);
                }
            }
            return;
        case StatementKind::assign:
            apply(statement.name);
            return apply(statement.value);
        case StatementKind::assign_number:
        case StatementKind::timer:
        case StatementKind::counter:
            return apply(statement.value);
        case StatementKind::command:
        case StatementKind::set_outputs:
        case StatementKind::reset_outputs:
            return apply(statement.arguments);
        case StatementKind::count_down:
        case StatementKind::clear_counter:
            return;
    }
}

void Substitution::apply(std::vector<ast::Name>& names) const {
    for (ast::Name& name : names) apply(name);
}

/// Errors of an argument are reported at the call.
void Substitution::apply(ast::Name& name) const {
    const ast::Argument* argument = argument_for(name.text);
    if (argument != nullptr && !argument->value) name = argument->name;
}

void Substitution::apply_to_step(ast::Name& name) const {
    const auto own = steps_.find(upper(name.text));
    if (own != steps_.end()) {
        name.text = own->second;
    } else {
        apply(name);
    }
}

void Substitution::apply(ast::Expression& expression) const {
    if (!expression.name.text.empty()) {
        apply(expression.name);
        if (argument_for(expression.name.text) != nullptr) expression.span = expression.name.span;
    }
    for (ast::Expression& operand : expression.operands) apply(operand);
}

void Substitution::apply(Value& value) const {
    for (Value& operand : value.operands) apply(operand);
    if (value.kind == Value::Kind::name) {
        const ast::Argument* argument = argument_for(value.name.text);
        if (argument == nullptr) return;
        if (argument->value) {
            value = *argument->value;
        } else {
            value.name = argument->name;
        }
        return;
    }
    // 360 deg / Stations: the parameter is after the last '/' of the unit.
    const std::size_t slash = value.unit.text.rfind('/');
    if (value.kind != Value::Kind::literal || slash == std::string_view::npos) return;
    const ast::Argument* argument = argument_for(value.unit.text.substr(slash + 1));
    if (argument == nullptr) return;
    Value divisor;
    if (argument->value) {
        divisor = *argument->value;
    } else {
        divisor.kind = Value::Kind::name;
        divisor.name = argument->name;
    }
    divisor.span = argument->span;
    Value inverse;
    inverse.kind = Value::Kind::inverse;
    inverse.span = divisor.span;
    inverse.operands.push_back(std::move(divisor));
    Value product;
    product.kind = Value::Kind::product;
    product.span = value.span;
    value.unit.text = texts_.emplace_back(value.unit.text.substr(0, slash));
    product.operands.push_back(std::move(value));
    product.operands.push_back(std::move(inverse));
    value = std::move(product);
}

}  // namespace nplc::seqc
