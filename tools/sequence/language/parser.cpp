#include "language/parser.h"

#include <fmt/format.h>

#include <utility>

#include "language/foreign_words.h"
#include "language/names.h"

namespace nplc::seqc {

ast::Program Parser::parse() {
    ast::Program program;
    const Span opened = token().span;
    mend_split_words();
    program.steps_missing = comment_is_open_;
    if (token().kind == TokenKind::end) {
        if (!report_.has_errors())
            report_.add("E010", {}, "the file holds no program", "write PROGRAM Name ... END_PROGRAM");
        return program;
    }
    if (at_item()) {
        parse_headless(program);
        return program;
    }
    if (expect("PROGRAM", "at the start")) {
        if (!expect_name(program.name, "the program's name", ast::Role::program, true)) recover();
        take_symbol(";");
    } else if (!at_boundary()) {
        return program;  // not a program at all
    }
    while (token().kind != TokenKind::end && !at("END_PROGRAM") && !report_.full()) parse_item(program);
    end_block("END_PROGRAM", opened);
    hand_over(program);
    if (token().kind != TokenKind::end && !report_.full()) {
        report_.add("E010", token().span, fmt::format("{} stands after END_PROGRAM", shown(token())),
                    "a file holds one program");
    }
    return program;
}

void Parser::twice(Span span, std::string_view what, Span first) {
    report_
        .add("E020", span, fmt::format("{} stands twice", what),
             what == "POWER_UP" ? "put all of it into one" : "keep one of the two")
        .notes.push_back({first, "the first one is here"});
}

void Parser::parse_item(ast::Program& program) {
    if (take_symbol(";") || (program.steps_missing && take("END_STEP"))) return;
    if (take("MOTOR")) {
        ast::Name motor;
        program.motor_missing = true;
        if (at_symbol(":=")) {
            error_here("the motor, such as MAC140", "write MOTOR MAC140;");
            ++at_;
        }
        if (!expect_name(motor, "the motor, such as MAC140", ast::Role::motor)) return recover();
        if (at_symbol("-")) {
            const Token first = tokens_[at_ - 1];
            while (!at_symbol(";") && !at_boundary()) ++at_;
            report_.add("E030", span_since(first), "MOTOR takes one motor's name, without a dash",
                        "write the one on the motor's plate: MOTOR MAC141;");
            return recover();
        }
        if (token().kind == TokenKind::number) {
            report_.add("E010", span_since(tokens_[at_ - 1]), "a motor's name is one word",
                        fmt::format("write MOTOR {}{};", motor.text, token().text));
            return recover();
        }
        if (program.motor) twice(motor.span, "MOTOR", program.motor->span);
        program.motor = motor;
        return end_statement();
    }
    if (at("SCALE")) return parse_scale(program);
    if (at("ON")) return parse_on(program);
    if (at("GROUP") || at_group_output()) return parse_many_steps(program);
    if (at("CONST")) return parse_constant(program);
    if (at("SET_POINT")) return parse_set_point(program);
    if (take("VAR_INPUT")) return parse_variables(program.inputs, ast::Role::input);
    if (take("VAR_OUTPUT")) return parse_variables(program.outputs, ast::Role::output);
    if (take("VAR_MOTOR")) return parse_variables(program.motor_variables, ast::Role::motor_variable);
    if (at("POWER_UP")) return parse_power_up(program);
    if (at("STEP")) return parse_step(program);
    if (at("SEQUENCE")) return parse_sequence(program);
    if (at("INCLUDE")) return parse_include(program);
    if (at("PROPERTY")) return parse_property(program);
    if (at("ASSUME")) return parse_assumption(program);
    if (at("TERM")) {
        if (!parse_raw_term(program.terms)) recover();
        return;
    }
    const std::string_view expected =
        "MOTOR, SCALE, CONST, VAR_INPUT, VAR_OUTPUT, VAR_MOTOR, ON, GROUP, POWER_UP, STEP, SEQUENCE, TERM, "
        "PROPERTY, INCLUDE or "
        "END_PROGRAM";
    if (foreign_word(token().text) == nullptr &&
        mend({"MOTOR", "SCALE", "CONST", "VAR_INPUT", "VAR_OUTPUT", "VAR_MOTOR", "GROUP", "POWER_UP", "STEP",
              "SEQUENCE", "TERM", "PROPERTY", "INCLUDE", "END_PROGRAM"},
             expected)) {
        return;
    }
    if (refuse_foreign_item(program)) return;
    error_here(expected, "this belongs into a step, or something above it ends too early");
    program.steps_missing = true;
    ++at_;
    recover_item();
}

void Parser::parse_scale(ast::Program& program) {
    const Token first = token();
    ++at_;
    ast::Scale scale;
    ast::Value left;
    ast::Value right;
    program.scale_missing = true;
    if (at_symbol(":=")) {
        error_here("how far a revolution moves", "write SCALE 1 rev = 10 mm;");
        return recover();
    }
    if (!parse_literal(left) || !expect_symbol("=", "in SCALE, as in SCALE 1 rev = 5 mm;") ||
        !parse_literal(right)) {
        return recover();
    }
    if (at_symbol("/") || at_symbol("*")) {
        report_.add("E032", token().span, "SCALE takes a number here, no arithmetic",
                    "a gear goes to the revolutions: SCALE 5 rev = 10 mm;");
        return recover();
    }
    scale.span = span_since(first);
    scale.revolutions = left.number;
    scale.length = right.number;
    scale.unit = right.unit;
    const bool sound = same_name(left.unit.text, "rev") && !right.unit.text.empty() && left.number > 0 &&
                       right.number > 0 && !left.is_raw && !right.is_raw && !left.is_time && !right.is_time &&
                       right.unit.text.find_first_of("/%") == std::string_view::npos;
    if (!sound) {
        const bool turned = same_name(right.unit.text, "rev") && !left.unit.text.empty();
        report_.add("E032", scale.span, "SCALE must say how far the machine moves in some revolutions",
                    turned ? fmt::format("write the revolutions first: SCALE {:g} rev = {:g} {};",
                                         right.number, left.number, left.unit.text)
                           : "write it as SCALE 1 rev = 5 mm;");
    } else if (program.scale) {
        twice(scale.span, "SCALE", program.scale->span);
    } else {
        program.scale = scale;
    }
    end_statement();
}

void Parser::parse_on(ast::Program& program) {
    const bool alone = same_name(token(1).text, "ERROR") &&
                       !(same_name(token(2).text, "AND") || same_name(token(2).text, "OR") ||
                         same_name(token(2).text, "XOR") || same_name(token(2).text, "IN") ||
                         same_name(token(2).text, "EXCEPT"));
    if (alone || token(1).kind == TokenKind::end) return parse_on_error(program);
    ast::OnCondition on;
    const Token first = token();
    ++at_;
    on.next.kind = ast::Statement::Kind::next;
    if (!parse_expression(on.condition)) return recover();
    const bool excepts = refuse_not_in();
    if ((!excepts && take("IN") && !parse_names(on.only)) ||
        ((excepts || take("EXCEPT")) && !parse_names(on.except)) || !refuse_before_next()) {
        return recover();
    }
    const Token next = token();
    if (!expect("NEXT", "behind the condition, as in ON Guard NEXT := Stopped;") ||
        !expect_symbol(":=", "after NEXT") || !parse_target(on.next.name)) {
        return recover();
    }
    on.next.span = span_since(next);
    on.span = span_since(first);
    program.on_conditions.push_back(std::move(on));
    end_statement();
}

bool Parser::parse_names(std::vector<ast::Name>& names) {
    const bool in_brackets = refuse_bracket_before_names();
    do {
        if (!expect_name(names.emplace_back(), "a step or a group", ast::Role::step_or_group)) return false;
    } while (take_symbol(",") || refuse_semicolon_between_names());
    if (in_brackets) take_symbol(")");
    return true;
}

void Parser::parse_many_steps(ast::Program& program) {
    at("GROUP") ? parse_group(program) : parse_group_output(program);
}

void Parser::parse_group(ast::Program& program) {
    ++at_;
    ast::Group group;
    if (!expect_name(group.name, "the group's name", ast::Role::group, true)) return recover();
    if (at_symbol("=") || at_symbol(":=")) {
        error_here("':' and the steps", fmt::format("write GROUP {}: Push, Return;", group.name.text));
        tokens_[at_].text = ":";
    }
    if (!expect_symbol(":", "and the steps, as in GROUP Moving: Push, Return;") ||
        !parse_names(group.steps)) {
        return recover();
    }
    program.groups.push_back(std::move(group));
    end_statement();
}

void Parser::parse_constant(ast::Program& program) {
    parse_one_constant(program);
    mend_constant_block(program);
}

void Parser::parse_one_constant(ast::Program& program) {
    ++at_;
    ast::Constant constant;
    if (is_word_at(0) && is_word_at(1)) {
        report_.add("E010", token().span, "a constant has no type",
                    fmt::format("write CONST {} := 10;", token(1).text));
        ++at_;
        if (is_symbol_at(1, "=")) tokens_[at_ + 1].text = ":=";
    }
    if (!expect_name(constant.name, "the constant's name", ast::Role::constant, true)) {
        names_missing_ = true;
        return recover();
    }
    faulty_names_.push_back(constant.name.text);
    if (!expect_symbol(":=", "and a value, as in CONST Pitch := 40 mm;") || !parse_value(constant.value))
        return recover();
    faulty_names_.pop_back();
    program.constants.push_back(std::move(constant));
    end_statement();
}

void Parser::parse_on_error(ast::Program& program) {
    const Token first = token();
    ++at_;
    ast::Name step;
    if (!expect("ERROR", "after ON, as in ON ERROR NEXT := Fault;") || !refuse_before_next() ||
        !expect("NEXT", "after ON ERROR") || !expect_symbol(":=", "after NEXT") ||
        !expect_name(step, "the name of the fault step", ast::Role::step)) {
        return recover();
    }
    if (program.on_error) twice(span_since(first), "ON ERROR", program.on_error->span);
    program.on_error = step;
    end_statement();
}

void Parser::parse_variables(std::vector<ast::Variable>& variables, ast::Role role) {
    const Span opened = tokens_[at_ - 1].span;
    if (at("RETAIN") || at("NON_RETAIN") || at("PERSISTENT") || at("CONSTANT")) {
        report_.add(
            "E010", token().span, fmt::format("there is no {} here", shown(token())),
            "leave it out: inputs and outputs are pins, and values in VAR_MOTOR are written at POWER_UP");
        ++at_;
    }
    const auto declares = [&] {
        return token(1).kind == TokenKind::identifier && same_name(token(1).text, "AT");
    };
    while (!at_block_end("END_VAR") && ((!at_boundary() && !at("ON")) || declares()) && !report_.full()) {
        if (take_symbol(";") || (!declares() && mend({"END_VAR"}, "END_VAR or a variable"))) continue;
        const std::size_t before = at_;
        parse_variable(variables, role);
        if (at_ == before) break;
    }
    end_block("END_VAR", opened);
}

bool Parser::parse_address(ast::Variable& variable, bool motor) {
    note_place(motor ? ast::Role::register_name : ast::Role::address);
    if (motor && take("REG")) {
        return parse_register_number(variable.register_number);
    }
    if (token().kind == TokenKind::direct || token().kind == TokenKind::identifier) {
        const Token first = token();
        ++at_;
        while (!motor && (at_symbol(".") || token().kind == TokenKind::number)) ++at_;  // E0.2
        variable.address.span = span_since(first);
        variable.address.text = source_.substr(first.span.offset, variable.address.span.length);
        note_use(motor ? ast::Role::register_name : ast::Role::address, variable.address.span);
        return true;
    }
    error_here(motor ? "a register, such as P1 or V_SOLL" : "an address, such as %IX0.0 or IN0");
    return false;
}

void Parser::parse_variable(std::vector<ast::Variable>& variables, ast::Role role) {
    const bool motor = role == ast::Role::motor_variable;
    ast::Variable variable;
    if (!expect_name(variable.name, "the name of a variable", role, true)) {
        if (token().kind == TokenKind::identifier) ++at_;
        return recover();
    }
    faulty_names_.push_back(variable.name.text);
    if (!motor && at_symbol(":")) {
        error_here("AT and an address", fmt::format("write where it is wired: {} AT IN0 : BOOL; (or AT OUT0)",
                                                    variable.name.text));
        return recover();
    }
    if (at_symbol(",")) {
        names_missing_ = true;
        error_here("AT and what the name stands for",
                   fmt::format("each name has an address of its own: {} AT {}0; Other AT {}1;",
                               variable.name.text, motor ? "P" : "IN", motor ? "P" : "IN"));
        return recover();
    }
    if (motor && at_symbol(":=")) {
        names_missing_ = true;
        error_here("AT and a register", fmt::format("write Name AT {} := value;", variable.name.text));
        return recover();
    }
    if (!expect("AT", motor ? "and a register, as in AT P1" : "and an address, as in AT %IX0.0"))
        return recover();
    if (!parse_address(variable, motor)) return recover();
    if (!motor && take_symbol(":")) {
        if (!take("BOOL") && !(mend({"BOOL"}, "BOOL as the type") && take("BOOL"))) {
            error_here("BOOL as the type",
                       "inputs and outputs are BOOL; values of the motor are registers, in VAR_MOTOR");
            return recover();
        }
    } else if (at("BOOL")) {
        error_here(motor ? "';'" : "':' before BOOL",
                   motor ? "a register has no type" : "write Name AT IN1 : BOOL; or leave BOOL out");
        ++at_;
    }
    if (!motor && at_symbol(":=")) {
        report_.add("E010", token().span, "an input or output has no value of its own here",
                    "leave it out: outputs are off at power-up, and OUT in a step switches them on");
        return recover();
    }
    if (motor && at_equals()) {
        error_here("':=' before the value", "write := with a colon");
        tokens_[at_].text = ":=";
    }
    if (motor && take_symbol(":=")) {
        variable.value.emplace();
        if (!parse_value(*variable.value)) return recover();
    }
    faulty_names_.pop_back();
    if (motor) registers_.push_back(variable.name.text);
    variables.push_back(variable);
    end_statement();
}

void Parser::parse_step(ast::Program& program) {
    const Span opened = token().span;
    ++at_;
    if (at("STEP") && !is_symbol_at(1, ":") && !same_name(token(1).text, "AT")) {
        report_.add("E010", token().span, "STEP stands twice", "write it once: STEP Name:");
        ++at_;
    }
    ast::Step step;
    if (!expect_name(step.name, "the step's name", ast::Role::step, true)) {
        if (token().kind == TokenKind::number)
            report_.last().help = fmt::format("give it a name: STEP Name: or STEP Name AT {}:", token().text);
        step.name = {"", opened};
        program.steps_missing = true;
        if (!at_boundary()) ++at_;
    }
    parse_step_head(program, step);
    parse_step_body(step, "END_STEP");
    end_block("END_STEP", opened);
    if (!step.name.text.empty()) program.steps.push_back(std::move(step));
}

void Parser::parse_power_up(ast::Program& program) {
    const Token first = token();
    ++at_;
    take_symbol(":");
    ast::Step step;
    step.name = name_of(first);
    parse_step_body(step, "END_POWER_UP");
    end_block("END_POWER_UP", first.span);
    if (program.power_up) twice(first.span, "POWER_UP", program.power_up->name.span);
    program.power_up = std::move(step);
}

void Parser::parse_step_body(ast::Step& step, std::string_view end_word) {
    while (!at_block_end(end_word) && !at("STEP") && !at("POWER_UP") && !at("END_STEP") &&
           !at("END_SEQUENCE") && !report_.full()) {
        const std::size_t before = at_;
        if (take_symbol(";")) continue;
        if (at("ALLOW")) {
            parse_allowance(step);
            continue;
        }
        mend_statement({end_word});
        if (at(end_word)) break;
        if (refuse_item_inside()) {
            continue;
        } else if (at("OUT")) {
            parse_out(step);
        } else if (take("OWN")) {
            step.own_error = true;
            step.own_error_span = tokens_[at_ - 1].span;
            if (expect("ERROR", "after OWN")) end_statement();
        } else if (take("NO_HELPER")) {
            step.no_helper = true;
            step.no_helper_span = tokens_[at_ - 1].span;
            end_statement();
        } else if (at("TAKES")) {
            parse_takes(step);
        } else if (take("ENTRY")) {
            ast::Statement statement;
            if (!refuse_entry_with_condition() && parse_statement(statement))
                step.entry.push_back(std::move(statement));
        } else if (at("TERM")) {
            if (!parse_raw_term(step.terms)) recover();
        } else if (at("IF")) {
            ast::Choice choice;
            if (parse_if(choice)) step.choices.push_back(std::move(choice));
        } else {
            ast::Statement statement;
            if (parse_statement(statement)) {
                if (step.choices.empty() || !step.choices.back().bare) {
                    step.choices.push_back({{ast::Branch{{}, statement.span, {}}}, true});
                }
                step.choices.back().branches.front().statements.push_back(std::move(statement));
            }
        }
        if (at_ == before) ++at_;
    }
}

void Parser::parse_allowance(ast::Step& step) {
    ++at_;
    ast::Allowance allowance;
    if (!expect_name(allowance.code, "a check's code, such as V006", ast::Role::check) ||
        !expect("BECAUSE",
                "behind a check's code, as in ALLOW V006 BECAUSE 'the clamp must hold the part';")) {
        return recover();
    }
    if (token().kind != TokenKind::text) {
        error_here("the reason in quotes", "write it as 'the clamp must hold the part'");
        return recover();
    }
    allowance.reason = name_of(token());
    allowance.reason.text.remove_prefix(1);
    allowance.reason.text.remove_suffix(1);
    ++at_;
    const CodeRow* row = find_code(upper(allowance.code.text));
    if (row == nullptr || (row->phase != Phase::courses && !is_advice(row->code))) {
        report_.add(
            "E021", allowance.code.span, fmt::format("there is no check '{}'", allowance.code.text),
            "ALLOW takes what seqc verify finds by itself, V001 and on, and of the warnings W019, W022, W035 "
            "to W038, W040 to W046");
    } else {
        step.allowances.push_back(allowance);
    }
    end_statement();
}

bool Parser::parse_outputs(std::vector<ast::Name>& outputs) {
    do {
        if (token().kind == TokenKind::direct) {
            outputs.push_back(name_of(token()));
            note_use(ast::Role::address, token().span);
            ++at_;
            continue;
        }
        ast::Name name;
        if (!expect_name(name, "the name of an output", ast::Role::output)) return false;
        outputs.push_back(name);
    } while (take_symbol(","));
    return true;
}

/// OUT Lamp IN Moving; outside of the steps: OUT of a step has no IN.
bool Parser::at_group_output() const {
    if (!at("OUT")) return false;
    std::size_t ahead = 1;
    while (token(ahead).kind == TokenKind::direct || token(ahead).text == "," ||
           (token(ahead).kind == TokenKind::identifier && !is_reserved(token(ahead).text)))
        ++ahead;
    return same_name(token(ahead).text, "IN");
}

void Parser::parse_group_output(ast::Program& program) {
    ++at_;
    ast::GroupOutput spread;
    if (!parse_outputs(spread.outputs) || !expect("IN", "and the steps behind the outputs") ||
        !parse_names(spread.only) || (take("EXCEPT") && !parse_names(spread.except)))
        return recover();
    program.group_outputs.push_back(std::move(spread));
    end_statement();
}

void Parser::parse_out(ast::Step& step) {
    const Token first = token();
    ++at_;
    std::vector<ast::Name> outputs;
    if (is_one_of(token(), {"NOT"})) {
        report_.add("E010", token().span, "OUT names what is on in the step",
                    "leave it out: an output that OUT does not name is off");
        return recover();
    }
    if (refuse_out_of_set() || !parse_outputs(outputs)) return recover();
    if (is_one_of(token(), {"IN"})) {
        report_.add("E010", token().span, "OUT with IN stands outside of the steps",
                    "in a step OUT Name; is what is on in it");
        return recover();
    }
    if (at_symbol(":=") || at_symbol("=") || is_one_of(token(), {"ON", "TRUE", "FALSE"})) {
        report_.add("E010", token().span, "OUT takes no value: it names what is on in the step",
                    "write OUT Name; an output that it does not name is off");
        return recover();
    }
    if (refuse_out_tail() || !parse_out_tail(first, std::move(outputs), step)) return recover();
    end_statement();
}

/// The part after the names: WHEN, BLINKING or nothing.
bool Parser::parse_out_tail(const Token& first, std::vector<ast::Name> outputs, ast::Step& step) {
    mend_blinking();
    if (!at("WHEN") && !at("BLINKING")) mend({"WHEN", "BLINKING"}, "';', WHEN or BLINKING");
    if (take("BLINKING")) {
        note_use(ast::Role::keyword, tokens_[at_ - 1].span);
        ast::Blinking blinking;
        blinking.outputs = std::move(outputs);
        if (!expect_time(blinking.time, "BLINKING") || refuse_behind_blinking()) return false;
        blinking.span = span_since(first);
        step.blinking.push_back(std::move(blinking));
    } else if (take("WHEN")) {
        ast::ConditionalOutput conditional;
        conditional.outputs = std::move(outputs);
        if (!parse_expression(conditional.condition)) return false;
        conditional.span = span_since(first);
        step.conditional.push_back(std::move(conditional));
    } else {
        step.outputs.insert(step.outputs.end(), outputs.begin(), outputs.end());
    }
    return true;
}

}  // namespace nplc::seqc
