#include "language/declaration_parser.h"

#include <fmt/format.h>

#include <utility>

#include "language/item_mistakes.h"
#include "language/names.h"

namespace nplc::seqc {

void DeclarationParser::parse_motor(ast::Program& program) {
    in_.skip();
    ast::Name motor;
    program.motor_missing = true;
    if (in_.at_symbol(":=")) {
        in_.error_here("the motor, such as MAC140", "write MOTOR MAC140;");
        in_.skip();
    }
    if (!notes_.expect_name(motor, "the motor, such as MAC140", ast::Role::motor)) return in_.recover();
    if (in_.at_symbol("-")) {
        const Token first = in_.last();
        while (!in_.at_symbol(";") && !in_.at_boundary()) in_.skip();
        in_.report().add("E030", in_.span_since(first), "MOTOR takes one motor's name, without a dash",
                         "write the one on the motor's plate: MOTOR MAC141;");
        return in_.recover();
    }
    if (in_.token().kind == TokenKind::number) {
        in_.report().add("E010", in_.span_since(in_.last()), "a motor's name is one word",
                         fmt::format("write MOTOR {}{};", motor.text, in_.token().text));
        return in_.recover();
    }
    if (program.motor) refuse_twice(in_, motor.span, "MOTOR", program.motor->span);
    program.motor = motor;
    in_.end_statement();
}

void DeclarationParser::parse_scale(ast::Program& program) {
    const Token first = in_.token();
    in_.skip();
    ast::Scale scale;
    ast::Value left;
    ast::Value right;
    program.scale_missing = true;
    if (in_.at_symbol(":=")) {
        in_.error_here("how far a revolution moves", "write SCALE 1 rev = 10 mm;");
        return in_.recover();
    }
    if (!values_.parse_literal(left) || !in_.expect_symbol("=", "in SCALE, as in SCALE 1 rev = 5 mm;") ||
        !values_.parse_literal(right)) {
        return in_.recover();
    }
    if (in_.at_symbol("/") || in_.at_symbol("*")) {
        in_.report().add("E032", in_.token().span, "SCALE takes a number here, no arithmetic",
                         "a gear goes to the revolutions: SCALE 5 rev = 10 mm;");
        return in_.recover();
    }
    scale.span = in_.span_since(first);
    scale.revolutions = left.number;
    scale.length = right.number;
    scale.unit = right.unit;
    const bool sound = same_name(left.unit.text, "rev") && !right.unit.text.empty() && left.number > 0 &&
                       right.number > 0 && !left.is_raw && !right.is_raw && !left.is_time && !right.is_time &&
                       right.unit.text.find_first_of("/%") == std::string_view::npos;
    if (!sound) {
        const bool turned = same_name(right.unit.text, "rev") && !left.unit.text.empty();
        in_.report().add("E032", scale.span, "SCALE must say how far the machine moves in some revolutions",
                         turned ? fmt::format("write the revolutions first: SCALE {:g} rev = {:g} {};",
                                              right.number, left.number, left.unit.text)
                                : "write it as SCALE 1 rev = 5 mm;");
    } else if (program.scale) {
        refuse_twice(in_, scale.span, "SCALE", program.scale->span);
    } else {
        program.scale = scale;
    }
    in_.end_statement();
}

void DeclarationParser::parse_constant(ast::Program& program) {
    in_.skip();
    parse_one_constant(program);
    mend_constant_block(program);
}

void DeclarationParser::parse_one_constant(ast::Program& program) {
    ast::Constant constant;
    if (in_.is_word_at(0) && in_.is_word_at(1)) {
        in_.report().add("E010", in_.token().span, "a constant has no type",
                         fmt::format("write CONST {} := 10;", in_.token(1).text));
        in_.skip();
        if (in_.is_symbol_at(1, "=")) in_.replace(":=", 1);
    }
    if (!notes_.expect_name(constant.name, "the constant's name", ast::Role::constant, true)) {
        notes_.miss_names();
        return in_.recover();
    }
    notes_.begin_declaration(constant.name.text);
    if (!in_.expect_symbol(":=", "and a value, as in CONST Pitch := 40 mm;") ||
        !values_.parse(constant.value))
        return in_.recover();
    notes_.end_declaration();
    program.constants.push_back(std::move(constant));
    in_.end_statement();
}

/// CONST A := 1; B := 2; END_CONST
void DeclarationParser::mend_constant_block(ast::Program& program) {
    if (!in_.is_word_at(0) || !in_.is_symbol_at(1, ":=")) return;
    in_.report().add("E010", in_.token().span, "each constant begins with CONST",
                     fmt::format("write CONST {} := value;", in_.token().text));
    while (in_.is_word_at(0) && in_.is_symbol_at(1, ":=")) {
        parse_one_constant(program);
    }
    if (same_name(in_.token().text, "END_CONST")) in_.skip();
    in_.take_symbol(";");
}

void DeclarationParser::parse_variables(std::vector<ast::Variable>& variables, ast::Role role) {
    const Span opened = in_.last().span;
    if (in_.at("RETAIN") || in_.at("NON_RETAIN") || in_.at("PERSISTENT") || in_.at("CONSTANT")) {
        in_.report().add(
            "E010", in_.token().span, fmt::format("there is no {} here", shown(in_.token())),
            "leave it out: inputs and outputs are pins, and values in VAR_MOTOR are written at POWER_UP");
        in_.skip();
    }
    const auto declares = [&] {
        return in_.token(1).kind == TokenKind::identifier && same_name(in_.token(1).text, "AT");
    };
    while (!in_.at_block_end("END_VAR") && ((!in_.at_boundary() && !in_.at("ON")) || declares()) &&
           !in_.report().full()) {
        if (in_.take_symbol(";") || (!declares() && in_.mend({"END_VAR"}, "END_VAR or a variable"))) continue;
        const std::size_t before = in_.position();
        parse_variable(variables, role);
        if (in_.position() == before) break;
    }
    notes_.end_block("END_VAR", opened);
}

void DeclarationParser::parse_variable(std::vector<ast::Variable>& variables, ast::Role role) {
    const bool motor = role == ast::Role::motor_variable;
    ast::Variable variable;
    if (!notes_.expect_name(variable.name, "the name of a variable", role, true)) {
        if (in_.token().kind == TokenKind::identifier) in_.skip();
        return in_.recover();
    }
    notes_.begin_declaration(variable.name.text);
    if (!motor && in_.at_symbol(":")) {
        in_.error_here(
            "AT and an address",
            fmt::format("write where it is wired: {} AT IN0 : BOOL; (or AT OUT0)", variable.name.text));
        return in_.recover();
    }
    if (in_.at_symbol(",")) {
        notes_.miss_names();
        in_.error_here("AT and what the name stands for",
                       fmt::format("each name has an address of its own: {} AT {}0; Other AT {}1;",
                                   variable.name.text, motor ? "P" : "IN", motor ? "P" : "IN"));
        return in_.recover();
    }
    if (motor && in_.at_symbol(":=")) {
        notes_.miss_names();
        in_.error_here("AT and a register", fmt::format("write Name AT {} := value;", variable.name.text));
        return in_.recover();
    }
    if (!in_.expect("AT", motor ? "and a register, as in AT P1" : "and an address, as in AT %IX0.0"))
        return in_.recover();
    if (const Token before = in_.token(); !motor && in_.take("NOT")) variable.inverted = before.span;
    if (!parse_address(variable, motor)) return in_.recover();
    if (!motor && in_.take_symbol(":")) {
        if (!in_.take("BOOL") && !(in_.mend({"BOOL"}, "BOOL as the type") && in_.take("BOOL"))) {
            in_.error_here("BOOL as the type",
                           "inputs and outputs are BOOL; values of the motor are registers, in VAR_MOTOR");
            return in_.recover();
        }
    } else if (in_.at("BOOL")) {
        in_.error_here(motor ? "';'" : "':' before BOOL",
                       motor ? "a register has no type" : "write Name AT IN1 : BOOL; or leave BOOL out");
        in_.skip();
    }
    if (!motor && in_.at_symbol(":=")) {
        in_.report().add("E010", in_.token().span, "an input or output has no value of its own here",
                         "leave it out: outputs are off at power-up, and OUT in a step switches them on");
        return in_.recover();
    }
    if (motor && in_.at_equals()) {
        in_.error_here("':=' before the value", "write := with a colon");
        in_.replace(":=");
    }
    if (motor && in_.take_symbol(":=")) {
        variable.value.emplace();
        if (!values_.parse(*variable.value)) return in_.recover();
    }
    notes_.end_declaration();
    if (motor) notes_.add_register(variable.name.text);
    variables.push_back(variable);
    in_.end_statement();
}

bool DeclarationParser::parse_address(ast::Variable& variable, bool motor) {
    in_.note_place(motor ? ast::Role::register_name : ast::Role::address);
    if (motor && in_.take("REG")) {
        return values_.parse_register_number(variable.register_number);
    }
    if (in_.token().kind == TokenKind::direct || in_.token().kind == TokenKind::identifier) {
        const Token first = in_.token();
        in_.skip();
        while (!motor && (in_.at_symbol(".") || in_.token().kind == TokenKind::number)) in_.skip();  // E0.2
        variable.address.span = in_.span_since(first);
        variable.address.text = in_.source().substr(first.span.offset, variable.address.span.length);
        notes_.add_use(motor ? ast::Role::register_name : ast::Role::address, variable.address.span);
        return true;
    }
    in_.error_here(motor ? "a register, such as P1 or V_SOLL" : "an address, such as %IX0.0 or IN0");
    return false;
}

}  // namespace nplc::seqc
