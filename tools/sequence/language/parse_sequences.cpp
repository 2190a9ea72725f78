#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "language/names.h"
#include "language/parser.h"

/// SEQUENCE Name(parameters) steps END_SEQUENCE, and its statements.
namespace nplc::seqc {
namespace {

using Kind = ast::Parameter::Kind;

}  // namespace

void Parser::parse_sequence(ast::Program& program) {
    const Token first = in_.token();
    in_.skip();
    ast::Sequence sequence;
    program.steps_missing = program.steps_missing || in_.token().kind != TokenKind::identifier;
    if (!notes_.expect_name(sequence.name, "the sequence's name", ast::Role::sequence, true))
        return in_.recover();
    notes_.add_sequence(sequence.name.text);
    if (in_.take_symbol("(") && !in_.take_symbol(")") && !parse_parameters(sequence)) {
        skip_parameters();
        notes_.miss_names();
        sequence.is_broken = true;
    }
    in_.take_symbol(":");
    in_.take_symbol(";");
    ast::Program inner;
    inner.steps_missing = refuse_statement_outside();
    while ((in_.at("STEP") || in_.at_symbol(";")) && !in_.report().full()) {
        if (!in_.take_symbol(";")) parse_step(inner);
        inner.steps_missing = refuse_statement_outside() || inner.steps_missing;
    }
    sequence.steps = std::move(inner.steps);
    program.steps_missing = program.steps_missing || inner.steps_missing;
    if (sequence.steps.empty() && !inner.steps_missing) {
        in_.report().add("E067", sequence.name.span, "a SEQUENCE has a step at the least",
                         "write STEP Name: ... END_STEP in it");
    }
    const bool closed = notes_.end_block("END_SEQUENCE", first.span);
    program.steps_missing = program.steps_missing || !closed;
    program.sequences.push_back(std::move(sequence));
}

/// Skips a list that cannot be parsed.
void Parser::skip_parameters() {
    const auto ends = [&] {
        const bool begins_step =
            in_.at("STEP") && (in_.is_symbol_at(2, ":") || same_name(in_.token(2).text, "AT"));
        return in_.at_end() || in_.at("END_SEQUENCE") || begins_step;
    };
    while (!ends() && !in_.at_symbol(")")) in_.skip();
    in_.take_symbol(")");
}

/// SET Valve; between the steps.
bool Parser::refuse_statement_outside() {
    if (in_.token().kind != TokenKind::identifier || in_.at_boundary() || in_.at("ON") || in_.at("TERM") ||
        in_.at("PROGRAM"))
        return false;
    in_.error_here("STEP or END_SEQUENCE",
                   "a SEQUENCE holds steps: write STEP Name: ... END_STEP around this");
    while (!in_.at("STEP") && !in_.at("END_SEQUENCE") && !in_.at("END_PROGRAM") && !in_.at_end()) in_.skip();
    return true;
}

bool Parser::parse_parameters(ast::Sequence& sequence) {
    do {
        ast::Parameter parameter;
        if (in_.take("VAR_INPUT")) {
            parameter.kind = Kind::input;
        } else if (in_.take("VAR_OUTPUT")) {
            parameter.kind = Kind::output;
        } else if (in_.take("VAR_MOTOR")) {
            parameter.kind = Kind::motor_variable;
        } else if (in_.take("CONST")) {
            parameter.kind = Kind::constant;
        } else if (in_.take("STEP")) {
            parameter.kind = Kind::step;
        } else {
            in_.error_here(
                "VAR_INPUT, VAR_OUTPUT, VAR_MOTOR, CONST or STEP and a parameter's name",
                "write SEQUENCE Close(VAR_OUTPUT Valve, VAR_INPUT Closed, CONST Limit, STEP Alarm)");
            return false;
        }
        if (!notes_.expect_name(parameter.name, "the parameter's name", ast::Role::parameter, true))
            return false;
        sequence.parameters.push_back(parameter);
        if (in_.at_symbol(":")) {
            in_.report().add("E010", in_.token().span, "a parameter has no type behind it",
                             "the word in front says what it is: VAR_OUTPUT Valve");
            return false;
        }
    } while (in_.take_symbol(",") || refuse_semicolon_between_parameters());
    return in_.expect_symbol(")", "to close the list");
}

bool Parser::refuse_semicolon_between_parameters() {
    if (!in_.at_symbol(";")) return false;
    in_.report().add("E010", in_.token().span, "parameters are separated by commas", "write a comma");
    in_.skip();
    return true;
}

/// A statement whose keyword can be a name elsewhere: CALL, RETURN, SET, RESET. Empty: another statement.
std::optional<bool> Parser::parse_named_statement(ast::Statement& statement) {
    if (in_.at("CALL") && in_.is_word_at(1)) return parse_call(statement);
    if (in_.at("RETURN") && in_.is_symbol_at(1, ";")) {
        notes_.add_use(ast::Role::keyword, in_.token().span);
        in_.skip();
        notes_.note_call();
        refuse_every_scan(statement, "RETURN");
        statement.kind = ast::Statement::Kind::go_back;
        return true;
    }
    if (in_.at("RESET") && same_name(in_.token(1).text, "ERROR")) return parse_split_reset(statement);
    if ((in_.at("SET") || in_.at("RESET")) && (in_.is_word_at(1) || in_.token(1).kind == TokenKind::direct))
        return parse_switched_outputs(statement);
    if (in_.is_symbol_at(1, "(") && notes_.is_sequence(in_.token().text)) {
        in_.report().add("E010", in_.token().span,
                         fmt::format("'{}' is a SEQUENCE, which CALL goes through", in_.token().text),
                         fmt::format("write CALL {}(..); NEXT := Step;", in_.token().text));
        return parse_called(statement);
    }
    return std::nullopt;
}

/// RESET ERROR; is accepted as intended.
bool Parser::parse_split_reset(ast::Statement& statement) {
    const Token first = in_.token();
    in_.skip(2);
    in_.report().add("E010", in_.span_since(first), "RESET_ERROR is one word", "write RESET_ERROR;");
    statement.kind = ast::Statement::Kind::command;
    statement.name = {"RESET_ERROR", in_.span_since(first)};
    return true;
}

/// CALL Close(Clamp, Clamped, T#800ms, Fault)
bool Parser::parse_call(ast::Statement& statement) {
    notes_.add_use(ast::Role::keyword, in_.token().span);
    in_.skip();
    refuse_every_scan(statement, "CALL");
    return parse_called(statement);
}

bool Parser::parse_called(ast::Statement& statement) {
    statement.kind = ast::Statement::Kind::call;
    notes_.note_call();
    if (!notes_.expect_name(statement.name, "the name of a SEQUENCE", ast::Role::sequence)) return false;
    if (!in_.take_symbol("(") || in_.take_symbol(")")) return true;
    do {
        if (!parse_call_argument(statement.call)) return false;
    } while (in_.take_symbol(","));
    return in_.expect_symbol(")", "to close the list");
}

void Parser::refuse_every_scan(const ast::Statement& statement, std::string_view word) {
    if (!statement.every_scan) return;
    in_.report().add("E064", statement.every_scan_span, fmt::format("EVERY_SCAN does not go with {}", word),
                     "leave it out");
}

bool Parser::parse_call_argument(std::vector<ast::Argument>& arguments) {
    ast::Argument argument;
    const Token first = in_.token();
    if (in_.is_word_at(0) && in_.is_symbol_at(1, ":=")) {
        in_.report().add("E067", first.span, "arguments stand without the parameters' names, in their order",
                         "write CALL Close(Clamp, Clamped, T#800ms);");
        while (!in_.at_symbol(")") && !in_.at_symbol(";") && !in_.at_boundary()) in_.skip();
        return false;
    }
    for (const ast::Role role : {ast::Role::tested, ast::Role::output, ast::Role::step}) in_.note_place(role);
    const bool is_alone = in_.is_symbol_at(1, ",") || in_.is_symbol_at(1, ")");
    if (is_alone && (first.kind == TokenKind::direct || in_.is_word_at(0) || in_.at("POWER_UP"))) {
        argument.name = name_of(first);
        if (!in_.at("POWER_UP")) {
            notes_.add_use(first.kind == TokenKind::direct ? ast::Role::address : ast::Role::argument,
                           first.span);
        }
        in_.skip();
    } else {
        argument.value.emplace();
        if (!parse_value(*argument.value)) return false;
    }
    argument.span = in_.span_since(first);
    argument.text = in_.source().substr(argument.span.offset, argument.span.length);
    arguments.push_back(std::move(argument));
    return true;
}

}  // namespace nplc::seqc
