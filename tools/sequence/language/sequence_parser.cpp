#include "language/sequence_parser.h"

#include <utility>

#include "language/names.h"

namespace nplc::seqc {
namespace {

using ParameterKind = ast::Parameter::Kind;

/// Skips a list that cannot be parsed.
void skip_parameters(TokenStream& in) {
    const auto ends = [&] {
        const bool begins_step =
            in.at("STEP") && (in.is_symbol_at(2, ":") || same_name(in.token(2).text, "AT"));
        return in.at_end() || in.at("END_SEQUENCE") || begins_step;
    };
    while (!ends() && !in.at_symbol(")")) in.skip();
    in.take_symbol(")");
}

/// SET Valve; between the steps.
bool refuse_statement_outside(TokenStream& in) {
    if (in.token().kind != TokenKind::identifier || in.at_boundary() || in.at("ON") || in.at("TERM") ||
        in.at("PROGRAM"))
        return false;
    in.error_here("STEP or END_SEQUENCE",
                  "a SEQUENCE holds steps: write STEP Name: ... END_STEP around this");
    while (!in.at("STEP") && !in.at("END_SEQUENCE") && !in.at("END_PROGRAM") && !in.at_end()) in.skip();
    return true;
}

bool refuse_semicolon_between_parameters(TokenStream& in) {
    if (!in.at_symbol(";")) return false;
    in.report().add("E010", in.token().span, "parameters are separated by commas", "write a comma");
    in.skip();
    return true;
}

}  // namespace

void SequenceParser::parse(ast::Program& program) {
    const Token first = in_.token();
    in_.skip();
    ast::Sequence sequence;
    program.steps_missing = program.steps_missing || in_.token().kind != TokenKind::identifier;
    if (!notes_.expect_name(sequence.name, "the sequence's name", ast::Role::sequence, true))
        return in_.recover();
    notes_.add_sequence(sequence.name.text);
    if (in_.take_symbol("(") && !in_.take_symbol(")") && !parse_parameters(sequence)) {
        skip_parameters(in_);
        notes_.miss_names();
        sequence.is_broken = true;
    }
    in_.take_symbol(":");
    in_.take_symbol(";");
    ast::Program inner;
    inner.steps_missing = refuse_statement_outside(in_);
    while ((in_.at("STEP") || in_.at_symbol(";")) && !in_.report().full()) {
        if (!in_.take_symbol(";")) steps_.parse(inner);
        inner.steps_missing = refuse_statement_outside(in_) || inner.steps_missing;
    }
    sequence.steps = std::move(inner.steps);
    program.steps_missing = program.steps_missing || inner.steps_missing;
    if (sequence.steps.empty() && !inner.steps_missing) {
        in_.report().add("E067", sequence.name.span, "a SEQUENCE has at least one step",
                         "write STEP Name: ... END_STEP in it");
    }
    const bool closed = notes_.end_block("END_SEQUENCE", first.span);
    program.steps_missing = program.steps_missing || !closed;
    program.sequences.push_back(std::move(sequence));
}

bool SequenceParser::parse_parameters(ast::Sequence& sequence) {
    do {
        ast::Parameter parameter;
        if (in_.take("VAR_INPUT")) {
            parameter.kind = ParameterKind::input;
        } else if (in_.take("VAR_OUTPUT")) {
            parameter.kind = ParameterKind::output;
        } else if (in_.take("VAR_MOTOR")) {
            parameter.kind = ParameterKind::motor_variable;
        } else if (in_.take("CONST")) {
            parameter.kind = ParameterKind::constant;
        } else if (in_.take("STEP")) {
            parameter.kind = ParameterKind::step;
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
    } while (in_.take_symbol(",") || refuse_semicolon_between_parameters(in_));
    return in_.expect_symbol(")", "to close the list");
}

}  // namespace nplc::seqc
