#include "language/parser.h"
#include "language/reserved_words.h"

#include <fmt/format.h>

#include <utility>

#include "language/foreign_words.h"
#include "language/names.h"

namespace nplc::seqc {

ast::Program Parser::parse() {
    ast::Program program;
    const Span opened = in_.token().span;
    mend_split_words();
    program.steps_missing = in_.has_open_comment();
    if (in_.at_end()) {
        if (!in_.report().has_errors())
            in_.report().add("E010", {}, "the file holds no program", "write PROGRAM Name ... END_PROGRAM");
        return program;
    }
    if (at_item()) {
        parse_headless(program);
        return program;
    }
    if (in_.expect("PROGRAM", "at the start")) {
        if (!notes_.expect_name(program.name, "the program's name", ast::Role::program, true)) in_.recover();
        in_.take_symbol(";");
    } else if (!in_.at_boundary()) {
        return program;  // not a program at all
    }
    while (!in_.at_end() && !in_.at("END_PROGRAM") && !in_.report().full()) parse_item(program);
    notes_.end_block("END_PROGRAM", opened);
    notes_.hand_over(program);
    if (!in_.at_end() && !in_.report().full()) {
        in_.report().add("E010", in_.token().span,
                         fmt::format("{} stands after END_PROGRAM", shown(in_.token())),
                         "a file holds one program");
    }
    return program;
}

void Parser::twice(Span span, std::string_view what, Span first) {
    in_.report()
        .add("E020", span, fmt::format("{} stands twice", what),
             what == "POWER_UP" ? "put all of it into one" : "keep one of the two")
        .notes.push_back({first, "the first one is here"});
}

void Parser::parse_item(ast::Program& program) {
    if (in_.take_symbol(";") || (program.steps_missing && in_.take("END_STEP"))) return;
    if (in_.take("MOTOR")) {
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
        if (program.motor) twice(motor.span, "MOTOR", program.motor->span);
        program.motor = motor;
        return in_.end_statement();
    }
    if (in_.at("SCALE")) return parse_scale(program);
    if (in_.at("ON")) return parse_on(program);
    if (in_.at("GROUP") || at_group_output()) return parse_many_steps(program);
    if (in_.at("CONST")) return parse_constant(program);
    if (in_.at("SET_POINT")) return parse_set_point(program);
    if (in_.take("VAR_INPUT")) return parse_variables(program.inputs, ast::Role::input);
    if (in_.take("VAR_OUTPUT")) return parse_variables(program.outputs, ast::Role::output);
    if (in_.take("VAR_MOTOR")) return parse_variables(program.motor_variables, ast::Role::motor_variable);
    if (in_.at("POWER_UP")) return parse_power_up(program);
    if (in_.at("STEP")) return parse_step(program);
    if (in_.at("SEQUENCE")) return parse_sequence(program);
    if (in_.at("INCLUDE")) return parse_include(program);
    if (in_.at("PROPERTY")) return parse_property(program);
    if (in_.at("ASSUME")) return parse_assumption(program);
    if (in_.at("TERM")) {
        if (!parse_raw_term(program.terms)) in_.recover();
        return;
    }
    const std::string_view expected =
        "MOTOR, SCALE, CONST, VAR_INPUT, VAR_OUTPUT, VAR_MOTOR, ON, GROUP, POWER_UP, STEP, SEQUENCE, TERM, "
        "PROPERTY, INCLUDE or "
        "END_PROGRAM";
    if (foreign_word(in_.token().text) == nullptr &&
        in_.mend({"MOTOR", "SCALE", "CONST", "VAR_INPUT", "VAR_OUTPUT", "VAR_MOTOR", "GROUP", "POWER_UP",
                  "STEP", "SEQUENCE", "TERM", "PROPERTY", "INCLUDE", "END_PROGRAM"},
                 expected)) {
        return;
    }
    if (refuse_foreign_item(program)) return;
    in_.error_here(expected, "this belongs into a step, or something above it ends too early");
    program.steps_missing = true;
    in_.skip();
    recover_item();
}

void Parser::parse_scale(ast::Program& program) {
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
    if (!parse_literal(left) || !in_.expect_symbol("=", "in SCALE, as in SCALE 1 rev = 5 mm;") ||
        !parse_literal(right)) {
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
        twice(scale.span, "SCALE", program.scale->span);
    } else {
        program.scale = scale;
    }
    in_.end_statement();
}

void Parser::parse_on(ast::Program& program) {
    const bool alone = same_name(in_.token(1).text, "ERROR") &&
                       !(same_name(in_.token(2).text, "AND") || same_name(in_.token(2).text, "OR") ||
                         same_name(in_.token(2).text, "XOR") || same_name(in_.token(2).text, "IN") ||
                         same_name(in_.token(2).text, "EXCEPT"));
    if (alone || in_.token(1).kind == TokenKind::end) return parse_on_error(program);
    ast::OnCondition on;
    const Token first = in_.token();
    in_.skip();
    on.next.kind = ast::Statement::Kind::next;
    if (!parse_expression(on.condition)) return in_.recover();
    const bool excepts = refuse_not_in();
    if ((!excepts && in_.take("IN") && !parse_names(on.only)) ||
        ((excepts || in_.take("EXCEPT")) && !parse_names(on.except)) || !refuse_before_next()) {
        return in_.recover();
    }
    const Token next = in_.token();
    if (!in_.expect("NEXT", "behind the condition, as in ON Guard NEXT := Stopped;") ||
        !in_.expect_symbol(":=", "after NEXT") || !parse_target(on.next.name)) {
        return in_.recover();
    }
    on.next.span = in_.span_since(next);
    on.span = in_.span_since(first);
    program.on_conditions.push_back(std::move(on));
    in_.end_statement();
}

bool Parser::parse_names(std::vector<ast::Name>& names) {
    const bool in_brackets = refuse_bracket_before_names();
    do {
        if (!notes_.expect_name(names.emplace_back(), "a step or a group", ast::Role::step_or_group))
            return false;
    } while (in_.take_symbol(",") || refuse_semicolon_between_names());
    if (in_brackets) in_.take_symbol(")");
    return true;
}

void Parser::parse_many_steps(ast::Program& program) {
    in_.at("GROUP") ? parse_group(program) : parse_group_output(program);
}

void Parser::parse_group(ast::Program& program) {
    in_.skip();
    ast::Group group;
    if (!notes_.expect_name(group.name, "the group's name", ast::Role::group, true)) return in_.recover();
    if (in_.at_symbol("=") || in_.at_symbol(":=")) {
        in_.error_here("':' and the steps", fmt::format("write GROUP {}: Push, Return;", group.name.text));
        in_.replace(":");
    }
    if (!in_.expect_symbol(":", "and the steps, as in GROUP Moving: Push, Return;") ||
        !parse_names(group.steps)) {
        return in_.recover();
    }
    program.groups.push_back(std::move(group));
    in_.end_statement();
}

void Parser::parse_constant(ast::Program& program) {
    in_.skip();
    parse_one_constant(program);
    mend_constant_block(program);
}

void Parser::parse_one_constant(ast::Program& program) {
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
    if (!in_.expect_symbol(":=", "and a value, as in CONST Pitch := 40 mm;") || !parse_value(constant.value))
        return in_.recover();
    notes_.end_declaration();
    program.constants.push_back(std::move(constant));
    in_.end_statement();
}

void Parser::parse_on_error(ast::Program& program) {
    const Token first = in_.token();
    in_.skip();
    ast::Name step;
    if (!in_.expect("ERROR", "after ON, as in ON ERROR NEXT := Fault;") || !refuse_before_next() ||
        !in_.expect("NEXT", "after ON ERROR") || !in_.expect_symbol(":=", "after NEXT") ||
        !notes_.expect_name(step, "the name of the fault step", ast::Role::step)) {
        return in_.recover();
    }
    if (program.on_error) twice(in_.span_since(first), "ON ERROR", program.on_error->span);
    program.on_error = step;
    in_.end_statement();
}

void Parser::parse_variables(std::vector<ast::Variable>& variables, ast::Role role) {
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

bool Parser::parse_address(ast::Variable& variable, bool motor) {
    in_.note_place(motor ? ast::Role::register_name : ast::Role::address);
    if (motor && in_.take("REG")) {
        return parse_register_number(variable.register_number);
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

void Parser::parse_variable(std::vector<ast::Variable>& variables, ast::Role role) {
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
        if (!parse_value(*variable.value)) return in_.recover();
    }
    notes_.end_declaration();
    if (motor) notes_.add_register(variable.name.text);
    variables.push_back(variable);
    in_.end_statement();
}

void Parser::parse_step(ast::Program& program) {
    const Span opened = in_.token().span;
    in_.skip();
    if (in_.at("STEP") && !in_.is_symbol_at(1, ":") && !same_name(in_.token(1).text, "AT")) {
        in_.report().add("E010", in_.token().span, "STEP stands twice", "write it once: STEP Name:");
        in_.skip();
    }
    ast::Step step;
    if (!notes_.expect_name(step.name, "the step's name", ast::Role::step, true)) {
        if (in_.token().kind == TokenKind::number)
            in_.report().last().help =
                fmt::format("give it a name: STEP Name: or STEP Name AT {}:", in_.token().text);
        step.name = {"", opened};
        program.steps_missing = true;
        if (!in_.at_boundary()) in_.skip();
    }
    parse_step_head(program, step);
    parse_step_body(step, "END_STEP");
    notes_.end_block("END_STEP", opened);
    if (!step.name.text.empty()) program.steps.push_back(std::move(step));
}

void Parser::parse_power_up(ast::Program& program) {
    const Token first = in_.token();
    in_.skip();
    in_.take_symbol(":");
    ast::Step step;
    step.name = name_of(first);
    parse_step_body(step, "END_POWER_UP");
    notes_.end_block("END_POWER_UP", first.span);
    if (program.power_up) twice(first.span, "POWER_UP", program.power_up->name.span);
    program.power_up = std::move(step);
}

void Parser::parse_step_body(ast::Step& step, std::string_view end_word) {
    while (!in_.at_block_end(end_word) && !in_.at("STEP") && !in_.at("POWER_UP") && !in_.at("END_STEP") &&
           !in_.at("END_SEQUENCE") && !in_.report().full()) {
        const std::size_t before = in_.position();
        if (in_.take_symbol(";")) continue;
        if (in_.at("ALLOW")) {
            parse_allowance(step);
            continue;
        }
        mend_statement({end_word});
        if (in_.at(end_word)) break;
        if (refuse_item_inside()) {
            continue;
        } else if (in_.at("OUT")) {
            parse_out(step);
        } else if (in_.take("OWN")) {
            step.own_error = true;
            step.own_error_span = in_.last().span;
            if (in_.expect("ERROR", "after OWN")) in_.end_statement();
        } else if (in_.take("NO_HELPER")) {
            step.no_helper = true;
            step.no_helper_span = in_.last().span;
            in_.end_statement();
        } else if (in_.at("TAKES")) {
            parse_takes(step);
        } else if (in_.take("ENTRY")) {
            ast::Statement statement;
            if (!refuse_entry_with_condition() && parse_statement(statement))
                step.entry.push_back(std::move(statement));
        } else if (in_.at("TERM")) {
            if (!parse_raw_term(step.terms)) in_.recover();
        } else if (in_.at("IF")) {
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
        if (in_.position() == before) in_.skip();
    }
}

void Parser::parse_allowance(ast::Step& step) {
    in_.skip();
    ast::Allowance allowance;
    if (!notes_.expect_name(allowance.code, "a check's code, such as V006", ast::Role::check) ||
        !in_.expect("BECAUSE",
                    "behind a check's code, as in ALLOW V006 BECAUSE 'the clamp must hold the part';")) {
        return in_.recover();
    }
    if (in_.token().kind != TokenKind::text) {
        in_.error_here("the reason in quotes", "write it as 'the clamp must hold the part'");
        return in_.recover();
    }
    allowance.reason = name_of(in_.token());
    allowance.reason.text.remove_prefix(1);
    allowance.reason.text.remove_suffix(1);
    in_.skip();
    const CodeRow* row = find_code(upper(allowance.code.text));
    if (row == nullptr || (row->phase != Phase::courses && !is_advice(row->code))) {
        in_.report().add(
            "E021", allowance.code.span, fmt::format("there is no check '{}'", allowance.code.text),
            "ALLOW takes what seqc verify finds by itself, V001 and on, and of the warnings W019, W022, W035 "
            "to W038, W040 to W046");
    } else {
        step.allowances.push_back(allowance);
    }
    in_.end_statement();
}

bool Parser::parse_outputs(std::vector<ast::Name>& outputs) {
    do {
        if (in_.token().kind == TokenKind::direct) {
            outputs.push_back(name_of(in_.token()));
            notes_.add_use(ast::Role::address, in_.token().span);
            in_.skip();
            continue;
        }
        ast::Name name;
        if (!notes_.expect_name(name, "the name of an output", ast::Role::output)) return false;
        outputs.push_back(name);
    } while (in_.take_symbol(","));
    return true;
}

/// OUT Lamp IN Moving; outside of the steps: OUT of a step has no IN.
bool Parser::at_group_output() const {
    if (!in_.at("OUT")) return false;
    std::size_t ahead = 1;
    while (in_.token(ahead).kind == TokenKind::direct || in_.token(ahead).text == "," ||
           (in_.token(ahead).kind == TokenKind::identifier && !is_reserved(in_.token(ahead).text)))
        ++ahead;
    return same_name(in_.token(ahead).text, "IN");
}

void Parser::parse_group_output(ast::Program& program) {
    in_.skip();
    ast::GroupOutput spread;
    if (!parse_outputs(spread.outputs) || !in_.expect("IN", "and the steps behind the outputs") ||
        !parse_names(spread.only) || (in_.take("EXCEPT") && !parse_names(spread.except)))
        return in_.recover();
    program.group_outputs.push_back(std::move(spread));
    in_.end_statement();
}

void Parser::parse_out(ast::Step& step) {
    const Token first = in_.token();
    in_.skip();
    std::vector<ast::Name> outputs;
    if (is_one_of(in_.token(), {"NOT"})) {
        in_.report().add("E010", in_.token().span, "OUT names what is on in the step",
                         "leave it out: an output that OUT does not name is off");
        return in_.recover();
    }
    if (refuse_out_of_set() || !parse_outputs(outputs)) return in_.recover();
    if (is_one_of(in_.token(), {"IN"})) {
        in_.report().add("E010", in_.token().span, "OUT with IN stands outside of the steps",
                         "in a step OUT Name; is what is on in it");
        return in_.recover();
    }
    if (in_.at_symbol(":=") || in_.at_symbol("=") || is_one_of(in_.token(), {"ON", "TRUE", "FALSE"})) {
        in_.report().add("E010", in_.token().span, "OUT takes no value: it names what is on in the step",
                         "write OUT Name; an output that it does not name is off");
        return in_.recover();
    }
    if (refuse_out_tail() || !parse_out_tail(first, std::move(outputs), step)) return in_.recover();
    in_.end_statement();
}

/// The part after the names: WHEN, BLINKING or nothing.
bool Parser::parse_out_tail(const Token& first, std::vector<ast::Name> outputs, ast::Step& step) {
    mend_blinking();
    if (!in_.at("WHEN") && !in_.at("BLINKING")) in_.mend({"WHEN", "BLINKING"}, "';', WHEN or BLINKING");
    if (in_.take("BLINKING")) {
        notes_.add_use(ast::Role::keyword, in_.last().span);
        ast::Blinking blinking;
        blinking.outputs = std::move(outputs);
        if (!expect_time(blinking.time, "BLINKING") || refuse_behind_blinking()) return false;
        blinking.span = in_.span_since(first);
        step.blinking.push_back(std::move(blinking));
    } else if (in_.take("WHEN")) {
        ast::ConditionalOutput conditional;
        conditional.outputs = std::move(outputs);
        if (!parse_expression(conditional.condition)) return false;
        conditional.span = in_.span_since(first);
        step.conditional.push_back(std::move(conditional));
    } else {
        step.outputs.insert(step.outputs.end(), outputs.begin(), outputs.end());
    }
    return true;
}

}  // namespace nplc::seqc
