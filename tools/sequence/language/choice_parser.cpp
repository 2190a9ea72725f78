#include "language/choice_parser.h"

#include <fmt/format.h>

#include <utility>

#include "language/names.h"
#include "language/statement_mistakes.h"
#include "language/step_mistakes.h"

namespace nplc::seqc {
namespace {

/// ELSE Start THEN: parsed as ELSIF.
bool refuse_else_with_condition(TokenStream& in) {
    std::size_t ahead = 1;
    while (in.is_word_at(ahead) || is_one_of(in.token(ahead), {"NOT", "AND", "OR", "XOR", "INPOS", "ERROR"}))
        ++ahead;
    if (ahead == 1 || !is_one_of(in.token(ahead), {"THEN"})) return false;
    in.report().add("E010", in.token().span, "ELSE takes no condition", "write ELSIF");
    return true;
}

/// Extra text between the condition and THEN is reported as one error.
void take_then(TokenStream& in) {
    if (in.take("THEN") || (in.mend({"THEN"}, "THEN after the condition") && in.take("THEN"))) return;
    if (in.at_symbol(";") && same_name(in.token(1).text, "THEN")) {
        in.report().add("E010", in.token().span, "no ';' stands between a condition and THEN",
                        "leave it out");
        in.skip(2);
        return;
    }
    in.error_here("THEN after the condition",
                  in.at_symbol(")") ? "there is no '(' for this ')'"
                                    : "write IF condition THEN; AND, OR and XOR join two conditions");
    if (in.take_symbol(":")) return;
    const std::size_t before = in.position();
    while (!in.at("THEN") && !in.at_boundary() && !in.at_symbol(";")) in.skip();
    if (!in.take("THEN")) in.return_to(before);
}

}  // namespace

void ChoiceParser::parse(ast::Choice& choice) {
    const Span opened = in_.token().span;
    bool last = false;
    std::size_t ends_too_many = 0;
    do {
        ast::Branch branch;
        branch.span = in_.token().span;
        if (in_.at("ELSE") && same_name(in_.token(1).text, "IF")) {
            const Token first = in_.token();
            in_.skip();
            ++ends_too_many;
            in_.report().add("E010", {first.span.offset, in_.token().span.offset + 2 - first.span.offset},
                             "an IF cannot stand inside another: ELSE IF is the word ELSIF",
                             "write ELSIF, and one END_IF for all of it");
        }
        last = in_.at("ELSE") && !refuse_else_with_condition(in_);
        in_.skip();
        if (!last) {
            branch.condition.emplace();
            if (!conditions_.parse(*branch.condition)) {
                branch.condition->kind = ast::Expression::Kind::constant;
                while (!in_.at("THEN") && !in_.at_boundary() && !in_.at_symbol(";")) in_.skip();
            }
            parse_timing(branch, choice.branches.empty());
            take_then(in_);
        }
        parse_branch_body(branch, opened);
        choice.branches.push_back(std::move(branch));
    } while (!last && (in_.at("ELSIF") || in_.at("ELSE")));
    const ast::Branch& first = choice.branches.front();
    if (!last && first.timing && first.timing->is_limit) {
        in_.report()
            .add("E010", in_.place_here(), "WITHIN needs an ELSE: what happens when the time has passed",
                 "write ELSE NEXT := Step; before END_IF")
            .notes.push_back({first.timing->span, "the time limit is here"});
    }
    notes_.end_block("END_IF", opened);
    for (; ends_too_many > 0 && in_.take("END_IF"); --ends_too_many) in_.take_symbol(";");
}

/// WITHIN belongs to the whole IF, FOR to its condition.
void ChoiceParser::parse_timing(ast::Branch& branch, bool is_first) {
    const Token first = in_.token();
    const bool is_limit = in_.take("WITHIN");
    if (!is_limit && !in_.take("FOR")) return;
    ast::Timing timing;
    timing.is_limit = is_limit;
    if (!values_.expect_time(timing.time, is_limit ? "WITHIN" : "FOR")) {
        while (!in_.at("THEN") && !in_.at_boundary() && !in_.at_symbol(";")) in_.skip();
        return;
    }
    timing.span = in_.span_since(first);
    if (is_limit && !is_first) {
        in_.report().add("E010", timing.span, "WITHIN stands behind the condition of IF, not of ELSIF",
                         "it is the time limit of the whole IF: write it there");
        return;
    }
    branch.timing = std::move(timing);
}

void ChoiceParser::parse_branch_body(ast::Branch& branch, Span opened) {
    while (!in_.at("ELSIF") && !in_.at("ELSE") && !in_.at("END_STEP") && !in_.at("STEP") &&
           !in_.at("POWER_UP") && !in_.at("END_POWER_UP") && !in_.at("END_SEQUENCE") &&
           !in_.at_block_end("END_IF") && !in_.report().full()) {
        if (in_.take_symbol(";")) continue;
        const std::size_t before = in_.position();
        mend_statement(in_, notes_, {"ELSIF", "ELSE", "END_IF"});
        if (in_.at("ELSIF") || in_.at("ELSE") || in_.at("END_IF")) break;
        if (in_.at("IF")) {
            ast::Choice inner;
            in_.report()
                .add("E064", in_.token().span, "an IF cannot stand inside another",
                     "join the two conditions with AND, or use ELSIF")
                .notes.push_back({opened, "the outer IF begins here"});
            parse(inner);
        } else if (refuse_item_inside(in_, notes_)) {
            continue;
        } else if (in_.at("OUT")) {
            in_.report().add("E064", in_.token().span, "OUT cannot stand inside an IF",
                             "outputs belong to the step: write OUT Name WHEN condition; beside the IF");
            in_.recover();
        } else {
            ast::Statement statement;
            if (statements_.parse(statement)) branch.statements.push_back(std::move(statement));
        }
        if (in_.position() == before) in_.skip();
    }
}

}  // namespace nplc::seqc
