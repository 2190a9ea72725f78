#include "language/many_steps_parser.h"

#include <fmt/format.h>

#include <utility>

#include "language/foreign_words.h"
#include "language/item_mistakes.h"
#include "language/names.h"
#include "language/reserved_words.h"

namespace nplc::seqc {
namespace {

/// ON Guard NOT IN Idle
bool refuse_not_in(TokenStream& in) {
    if (!in.at("NOT") || !is_one_of(in.token(1), {"IN"})) return false;
    const Token first = in.token();
    in.skip(2);
    in.report().add("E010", in.span_since(first), "NOT IN is the word EXCEPT", "write EXCEPT");
    return true;
}

bool refuse_bracket_before_names(TokenStream& in) {
    if (!in.at_symbol("(")) return false;
    in.report().add("E010", in.token().span, "names of steps stand without parentheses",
                    "write IN Push, Return");
    in.skip();
    return true;
}

/// ON Guard IN Push; Hold NEXT := Fault;
bool refuse_semicolon_between_names(TokenStream& in) {
    if (!in.at_symbol(";") || !in.is_word_at(1) ||
        !(is_one_of(in.token(2), {"NEXT"}) || in.is_symbol_at(2, ";") || in.is_symbol_at(2, ",")))
        return false;
    in.report().add("E010", in.token().span, "names of steps are separated by commas", "write a comma");
    in.skip();
    return true;
}

/// Text between a condition of ON and NEXT; false if parsing cannot continue.
bool refuse_before_next(TokenStream& in) {
    if (in.at("NEXT") || in.at_end()) return true;
    const Token first = in.token();
    std::size_t ahead = 0;
    while (in.token(ahead).kind != TokenKind::end && !in.is_symbol_at(ahead, ";")) ++ahead;
    if (in.is_symbol_at(ahead, ";")) ++ahead;  // ON Guard STOP; NEXT := Fault;
    if (is_one_of(first, {"THEN"})) {
        in.report().add("E010", first.span, "there is no THEN behind ON", "write ON condition NEXT := Step;");
        in.skip();
        return true;
    }
    const ForeignWord* word = foreign_word(first.text);
    const bool has_next = is_one_of(in.token(ahead), {"NEXT"});
    if (word != nullptr && !has_next) {
        in.report().add("E010", first.span, fmt::format("there is no {} in this language", shown(first)),
                        std::string(word->help));
        return false;
    }
    if (!in.is_word_at(0) || !has_next) return true;
    in.skip(ahead);
    in.report().add("E010", first.span, "ON leads to a step and does nothing else",
                    "write ON condition NEXT := Step; and what is to be done as ENTRY of that step");
    return true;
}

}  // namespace

void ManyStepsParser::parse_on(ast::Program& program) {
    const bool alone = same_name(in_.token(1).text, "ERROR") &&
                       !(same_name(in_.token(2).text, "AND") || same_name(in_.token(2).text, "OR") ||
                         same_name(in_.token(2).text, "XOR") || same_name(in_.token(2).text, "IN") ||
                         same_name(in_.token(2).text, "EXCEPT"));
    if (alone || in_.token(1).kind == TokenKind::end) return parse_on_error(program);
    ast::OnCondition on;
    const Token first = in_.token();
    in_.skip();
    on.next.kind = ast::Statement::Kind::next;
    if (!conditions_.parse(on.condition)) return in_.recover();
    const bool excepts = refuse_not_in(in_);
    if ((!excepts && in_.take("IN") && !parse_names(on.only)) ||
        ((excepts || in_.take("EXCEPT")) && !parse_names(on.except)) || !refuse_before_next(in_)) {
        return in_.recover();
    }
    const Token next = in_.token();
    if (!in_.expect("NEXT", "behind the condition, as in ON Guard NEXT := Stopped;") ||
        !in_.expect_symbol(":=", "after NEXT") || !statements_.parse_target(on.next.name)) {
        return in_.recover();
    }
    on.next.span = in_.span_since(next);
    on.span = in_.span_since(first);
    program.on_conditions.push_back(std::move(on));
    in_.end_statement();
}

void ManyStepsParser::parse_on_error(ast::Program& program) {
    const Token first = in_.token();
    in_.skip();
    ast::Name step;
    if (!in_.expect("ERROR", "after ON, as in ON ERROR NEXT := Fault;") || !refuse_before_next(in_) ||
        !in_.expect("NEXT", "after ON ERROR") || !in_.expect_symbol(":=", "after NEXT")) {
        return in_.recover();
    }
    if (in_.at("POWER_UP")) {
        in_.report().add("E011", in_.token().span, "POWER_UP cannot be the fault step",
                         "name a step with OWN ERROR;, whose branch with RESET_ERROR leads to POWER_UP");
        in_.skip();
        in_.end_statement();
        return;
    }
    if (!notes_.expect_name(step, "the name of the fault step", ast::Role::step)) return in_.recover();
    if (program.on_error) refuse_twice(in_, in_.span_since(first), "ON ERROR", program.on_error->span);
    program.on_error = step;
    in_.end_statement();
}

bool ManyStepsParser::parse_names(std::vector<ast::Name>& names) {
    const bool in_brackets = refuse_bracket_before_names(in_);
    do {
        if (!notes_.expect_name(names.emplace_back(), "a step or a group", ast::Role::step_or_group))
            return false;
    } while (in_.take_symbol(",") || refuse_semicolon_between_names(in_));
    if (in_brackets) in_.take_symbol(")");
    return true;
}

void ManyStepsParser::parse_group(ast::Program& program) {
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

void ManyStepsParser::parse_group_output(ast::Program& program) {
    in_.skip();
    ast::GroupOutput spread;
    if (!statements_.parse_outputs(spread.outputs) || !in_.expect("IN", "and the steps behind the outputs") ||
        !parse_names(spread.only) || (in_.take("EXCEPT") && !parse_names(spread.except)))
        return in_.recover();
    program.group_outputs.push_back(std::move(spread));
    in_.end_statement();
}

/// OUT Lamp IN Moving; outside of the steps: OUT of a step has no IN.
bool ManyStepsParser::at_group_output() const {
    if (!in_.at("OUT")) return false;
    std::size_t ahead = 1;
    while (in_.token(ahead).kind == TokenKind::direct || in_.token(ahead).text == "," ||
           (in_.token(ahead).kind == TokenKind::identifier && !is_reserved(in_.token(ahead).text)))
        ++ahead;
    return same_name(in_.token(ahead).text, "IN");
}

}  // namespace nplc::seqc
