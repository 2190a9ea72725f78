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
    const Token first = token();
    ++at_;
    ast::Sequence sequence;
    program.steps_missing = program.steps_missing || token().kind != TokenKind::identifier;
    if (!expect_name(sequence.name, "the sequence's name", ast::Role::sequence, true)) return recover();
    sequences_.push_back(sequence.name.text);
    if (take_symbol("(") && !take_symbol(")") && !parse_parameters(sequence)) {
        skip_parameters();
        sequence.is_broken = names_missing_ = true;
    }
    take_symbol(":");
    take_symbol(";");
    ast::Program inner;
    inner.steps_missing = refuse_statement_outside();
    while ((at("STEP") || at_symbol(";")) && !report_.full()) {
        if (!take_symbol(";")) parse_step(inner);
        inner.steps_missing = refuse_statement_outside() || inner.steps_missing;
    }
    sequence.steps = std::move(inner.steps);
    program.steps_missing = program.steps_missing || inner.steps_missing;
    if (sequence.steps.empty() && !inner.steps_missing) {
        report_.add("E067", sequence.name.span, "a SEQUENCE has a step at the least",
                    "write STEP Name: ... END_STEP in it");
    }
    end_block("END_SEQUENCE", first.span);
    program.steps_missing = program.steps_missing || !blocks_.back().closed;
    program.sequences.push_back(std::move(sequence));
}

/// Skips a list that cannot be parsed.
void Parser::skip_parameters() {
    const auto ends = [&] {
        const bool begins_step = at("STEP") && (is_symbol_at(2, ":") || same_name(token(2).text, "AT"));
        return token().kind == TokenKind::end || at("END_SEQUENCE") || begins_step;
    };
    while (!ends() && !at_symbol(")")) ++at_;
    take_symbol(")");
}

/// SET Valve; between the steps.
bool Parser::refuse_statement_outside() {
    if (token().kind != TokenKind::identifier || at_boundary() || at("ON") || at("TERM") || at("PROGRAM"))
        return false;
    error_here("STEP or END_SEQUENCE", "a SEQUENCE holds steps: write STEP Name: ... END_STEP around this");
    while (!at("STEP") && !at("END_SEQUENCE") && !at("END_PROGRAM") && token().kind != TokenKind::end) ++at_;
    return true;
}

bool Parser::parse_parameters(ast::Sequence& sequence) {
    do {
        ast::Parameter parameter;
        if (take("VAR_INPUT")) {
            parameter.kind = Kind::input;
        } else if (take("VAR_OUTPUT")) {
            parameter.kind = Kind::output;
        } else if (take("VAR_MOTOR")) {
            parameter.kind = Kind::motor_variable;
        } else if (take("CONST")) {
            parameter.kind = Kind::constant;
        } else if (take("STEP")) {
            parameter.kind = Kind::step;
        } else {
            error_here("VAR_INPUT, VAR_OUTPUT, VAR_MOTOR, CONST or STEP and a parameter's name",
                       "write SEQUENCE Close(VAR_OUTPUT Valve, VAR_INPUT Closed, CONST Limit, STEP Alarm)");
            return false;
        }
        if (!expect_name(parameter.name, "the parameter's name", ast::Role::parameter, true)) return false;
        sequence.parameters.push_back(parameter);
        if (at_symbol(":")) {
            report_.add("E010", token().span, "a parameter has no type behind it",
                        "the word in front says what it is: VAR_OUTPUT Valve");
            return false;
        }
    } while (take_symbol(",") || refuse_semicolon_between_parameters());
    return expect_symbol(")", "to close the list");
}

bool Parser::refuse_semicolon_between_parameters() {
    if (!at_symbol(";")) return false;
    report_.add("E010", token().span, "parameters are separated by commas", "write a comma");
    ++at_;
    return true;
}

/// A statement whose keyword can be a name elsewhere: CALL, RETURN, SET, RESET. Empty: another statement.
std::optional<bool> Parser::parse_named_statement(ast::Statement& statement) {
    if (at("CALL") && is_word_at(1)) return parse_call(statement);
    if (at("RETURN") && is_symbol_at(1, ";")) {
        note_use(ast::Role::keyword, token().span);
        ++at_;
        has_calls_ = true;
        refuse_every_scan(statement, "RETURN");
        statement.kind = ast::Statement::Kind::go_back;
        return true;
    }
    if (at("RESET") && same_name(token(1).text, "ERROR")) return parse_split_reset(statement);
    if ((at("SET") || at("RESET")) && is_output_at(1)) return parse_switched_outputs(statement);
    if (is_symbol_at(1, "(") && is_sequence(token().text)) {
        report_.add("E010", token().span,
                    fmt::format("'{}' is a SEQUENCE, which CALL goes through", token().text),
                    fmt::format("write CALL {}(..); NEXT := Step;", token().text));
        return parse_called(statement);
    }
    return std::nullopt;
}

bool Parser::is_sequence(std::string_view name) const {
    return std::any_of(sequences_.begin(), sequences_.end(),
                       [&](std::string_view known) { return same_name(known, name); });
}

/// RESET ERROR; is accepted as intended.
bool Parser::parse_split_reset(ast::Statement& statement) {
    const Token first = token();
    at_ += 2;
    report_.add("E010", span_since(first), "RESET_ERROR is one word", "write RESET_ERROR;");
    statement.kind = ast::Statement::Kind::command;
    statement.name = {"RESET_ERROR", span_since(first)};
    return true;
}

/// CALL Close(Clamp, Clamped, T#800ms, Fault)
bool Parser::parse_call(ast::Statement& statement) {
    note_use(ast::Role::keyword, token().span);
    ++at_;
    refuse_every_scan(statement, "CALL");
    return parse_called(statement);
}

bool Parser::parse_called(ast::Statement& statement) {
    statement.kind = ast::Statement::Kind::call;
    has_calls_ = true;
    if (!expect_name(statement.name, "the name of a SEQUENCE", ast::Role::sequence)) return false;
    if (!take_symbol("(") || take_symbol(")")) return true;
    do {
        if (!parse_call_argument(statement.call)) return false;
    } while (take_symbol(","));
    return expect_symbol(")", "to close the list");
}

void Parser::refuse_every_scan(const ast::Statement& statement, std::string_view word) {
    if (!statement.every_scan) return;
    report_.add("E064", statement.every_scan_span, fmt::format("EVERY_SCAN does not go with {}", word),
                "leave it out");
}

bool Parser::parse_call_argument(std::vector<ast::Argument>& arguments) {
    ast::Argument argument;
    const Token first = token();
    if (is_word_at(0) && is_symbol_at(1, ":=")) {
        report_.add("E067", first.span, "arguments stand without the parameters' names, in their order",
                    "write CALL Close(Clamp, Clamped, T#800ms);");
        while (!at_symbol(")") && !at_symbol(";") && !at_boundary()) ++at_;
        return false;
    }
    for (const ast::Role role : {ast::Role::tested, ast::Role::output, ast::Role::step}) note_place(role);
    const bool is_alone = is_symbol_at(1, ",") || is_symbol_at(1, ")");
    if (is_alone && (first.kind == TokenKind::direct || is_word_at(0) || at("POWER_UP"))) {
        argument.name = name_of(first);
        if (!at("POWER_UP")) {
            note_use(first.kind == TokenKind::direct ? ast::Role::address : ast::Role::argument, first.span);
        }
        ++at_;
    } else {
        argument.value.emplace();
        if (!parse_value(*argument.value)) return false;
    }
    argument.span = span_since(first);
    argument.text = source_.substr(argument.span.offset, argument.span.length);
    arguments.push_back(std::move(argument));
    return true;
}

}  // namespace nplc::seqc
