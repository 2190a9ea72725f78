#include "language/step_parser.h"

#include <fmt/format.h>

#include <utility>

#include "language/item_mistakes.h"
#include "language/names.h"
#include "language/statement_mistakes.h"
#include "language/step_mistakes.h"

namespace nplc::seqc {
namespace {

void parse_takes(TokenStream& in, ast::Step& step) {
    const Token first = in.token();
    step.takes_set_points_span = first.span;
    in.skip();
    if (!in.expect("SET_POINTS", "after TAKES")) return in.recover();
    step.takes_set_points_span = in.span_since(first);
    step.takes_set_points = true;
    in.end_statement();
}

}  // namespace

void StepParser::parse(ast::Program& program) {
    const Span opened = in_.token().span;
    in_.skip();
    if (in_.at("STEP") && !in_.is_symbol_at(1, ":") && !same_name(in_.token(1).text, "AT")) {
        in_.report().add("E010", in_.token().span, "STEP stands twice", "write it once: STEP Name:");
        in_.skip();
    }
    ast::Step step;
    if (take_digits_first(in_, step.name)) {
        in_.report().add("E010", step.name.span, "a name begins with a letter",
                         fmt::format("write STEP S{0}: and NEXT := S{0};", step.name.text));
    } else if (!notes_.expect_name(step.name, "the step's name", ast::Role::step, true)) {
        if (in_.token().kind == TokenKind::number)
            in_.report().last().help =
                fmt::format("give it a name: STEP Name: or STEP Name AT {}:", in_.token().text);
        step.name = {"", opened};
        program.steps_missing = true;
        if (!in_.at_boundary()) in_.skip();
    }
    parse_head(program, step);
    parse_body(step, "END_STEP");
    notes_.end_block("END_STEP", opened);
    if (!step.name.text.empty()) program.steps.push_back(std::move(step));
}

void StepParser::parse_power_up(ast::Program& program) {
    const Token first = in_.token();
    in_.skip();
    in_.take_symbol(":");
    ast::Step step;
    step.name = name_of(first);
    parse_body(step, "END_POWER_UP");
    notes_.end_block("END_POWER_UP", first.span);
    if (program.power_up) refuse_twice(in_, first.span, "POWER_UP", program.power_up->name.span);
    program.power_up = std::move(step);
}

/// The step's name, its number and the colon; a name of several words is reported once.
void StepParser::parse_head(ast::Program& program, ast::Step& step) {
    const Token& name = in_.last();
    if (in_.is_word_at(0) || in_.at_symbol("-")) {
        std::string joined(name.text);
        std::size_t ahead = 0;
        for (; in_.is_word_at(ahead) || in_.is_symbol_at(ahead, "-") ||
               in_.token(ahead).kind == TokenKind::number;
             ++ahead)
            joined.append(in_.is_symbol_at(ahead, "-") ? "" : "_")
                .append(in_.is_symbol_at(ahead, "-") ? "" : in_.token(ahead).text);
        if (in_.is_symbol_at(ahead, ":")) {
            const Token first = name;
            in_.skip(ahead);
            in_.report().add("E010", in_.span_since(first), "a name is one word of letters, digits and _",
                             fmt::format("write STEP {}:, and the same where it is named", joined));
            program.steps_missing = true;
        }
    }
    if (in_.take("AT")) {
        step.number.emplace();
        if (!values_.parse_literal(*step.number)) step.number.reset();
    }
    if (in_.take_symbol(":")) return;
    const Token& last = in_.last();
    if (in_.in_open_comment() || in_.end_was_reported()) return;
    in_.report().add("E010", {last.span.offset + last.span.length, 1},
                     fmt::format("expected ':' after the step's name, found {}", shown(in_.token())),
                     fmt::format("write STEP {}:", step.name.text.empty() ? "Name" : step.name.text));
}

void StepParser::parse_body(ast::Step& step, std::string_view end_word) {
    while (!in_.at_block_end(end_word) && !in_.at("STEP") && !in_.at("POWER_UP") && !in_.at("END_STEP") &&
           !in_.at("END_SEQUENCE") && !in_.report().full()) {
        const std::size_t before = in_.position();
        if (in_.take_symbol(";")) continue;
        if (in_.at("ALLOW")) {
            parse_allowance(step);
            continue;
        }
        mend_statement(in_, notes_, {end_word});
        if (in_.at(end_word)) break;
        if (refuse_item_inside(in_, notes_)) {
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
            parse_takes(in_, step);
        } else if (in_.take("ENTRY")) {
            ast::Statement statement;
            if (!refuse_entry_with_condition() && !refuse_entry_of_outputs(step) &&
                statements_.parse(statement))
                step.entry.push_back(std::move(statement));
        } else if (in_.at("TERM")) {
            if (!terms_.parse(step.terms)) in_.recover();
        } else if (in_.at("IF")) {
            ast::Choice choice;
            choices_.parse(choice);
            step.choices.push_back(std::move(choice));
        } else {
            ast::Statement statement;
            if (statements_.parse(statement)) {
                if (step.choices.empty() || !step.choices.back().bare) {
                    step.choices.push_back({{ast::Branch{{}, statement.span, {}}}, true});
                }
                step.choices.back().branches.front().statements.push_back(std::move(statement));
            }
        }
        if (in_.position() == before) in_.skip();
    }
}

/// ENTRY IF Start THEN ..
bool StepParser::refuse_entry_with_condition() {
    if (!in_.at("IF")) return false;
    in_.report().add(
        "E064", in_.token().span, "ENTRY has no conditions",
        "let the branch that leads to the step decide, and name another step where it does not hold");
    ast::Choice choice;
    choices_.parse(choice);
    return true;
}

/// ENTRY OUT Lamp;
bool StepParser::refuse_entry_of_outputs(ast::Step& step) {
    if (!in_.at("OUT")) return false;
    in_.report().add(
        "E064", in_.token().span, "ENTRY cannot hold OUT",
        "write OUT without ENTRY: the output is on from the scan that enters the step until it is left");
    parse_out(step);
    return true;
}

void StepParser::parse_out(ast::Step& step) {
    const Token first = in_.token();
    in_.skip();
    std::vector<ast::Name> outputs;
    if (is_one_of(in_.token(), {"NOT"})) {
        in_.report().add("E010", in_.token().span, "OUT names what is on in the step",
                         "leave it out: an output that OUT does not name is off");
        return in_.recover();
    }
    if (in_.at_symbol("(") && in_.is_word_at(1)) {
        in_.report().add("E010", in_.token().span, "OUT has no parentheses",
                         fmt::format("write OUT {};", in_.token(1).text));
        return in_.recover();
    }
    if (refuse_out_of_set(in_) || !statements_.parse_outputs(outputs)) return in_.recover();
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
    if (refuse_out_tail(in_) || !parse_out_tail(first, std::move(outputs), step)) return in_.recover();
    in_.end_statement();
}

/// The part after the names: WHEN, BLINKING or nothing.
bool StepParser::parse_out_tail(const Token& first, std::vector<ast::Name> outputs, ast::Step& step) {
    mend_blinking(in_);
    if (!in_.at("WHEN") && !in_.at("BLINKING")) in_.mend({"WHEN", "BLINKING"}, "';', WHEN or BLINKING");
    if (in_.take("BLINKING")) {
        notes_.add_use(ast::Role::keyword, in_.last().span);
        ast::Blinking blinking;
        blinking.outputs = std::move(outputs);
        if (!values_.expect_time(blinking.time, "BLINKING") || refuse_behind_blinking(in_)) return false;
        blinking.span = in_.span_since(first);
        step.blinking.push_back(std::move(blinking));
    } else if (in_.take("WHEN")) {
        ast::ConditionalOutput conditional;
        conditional.outputs = std::move(outputs);
        if (!conditions_.parse(conditional.condition)) return false;
        conditional.span = in_.span_since(first);
        step.conditional.push_back(std::move(conditional));
    } else {
        step.outputs.insert(step.outputs.end(), outputs.begin(), outputs.end());
    }
    return true;
}

void StepParser::parse_allowance(ast::Step& step) {
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

}  // namespace nplc::seqc
