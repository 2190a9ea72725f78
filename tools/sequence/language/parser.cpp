#include "language/parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "language/foreign_words.h"
#include "language/item_mistakes.h"
#include "language/names.h"

namespace nplc::seqc {
namespace {

constexpr auto kPartWords = std::to_array<std::string_view>(
    {"MOTOR", "SCALE", "CONST", "VAR_INPUT", "VAR_OUTPUT", "VAR_MOTOR", "ON", "GROUP", "POWER_UP", "STEP",
     "SEQUENCE", "TERM", "PROPERTY", "ASSUME", "INCLUDE"});

bool at_item(const TokenStream& in) {
    return in.token().kind == TokenKind::identifier &&
           std::any_of(kPartWords.begin(), kPartWords.end(),
                       [&](std::string_view word) { return same_name(word, in.token().text); });
}

bool is_program(const TokenStream& in) {
    return std::any_of(in.tokens().begin(), in.tokens().end(), [](const Token& t) {
        return same_name(t.text, "PROGRAM") || same_name(t.text, "END_PROGRAM");
    });
}

std::string help_of_headless(const TokenStream& in) {
    const ForeignWord* word = foreign_word(in.token().text);
    return word != nullptr ? std::string(word->help)
                           : "PROGRAM Name comes first; only comments stand before it";
}

}  // namespace

ast::Program Parser::parse() {
    ast::Program program;
    const Span opened = in_.token().span;
    mend_split_words(in_);
    program.steps_missing = in_.has_open_comment();
    if (in_.at_end()) {
        if (!in_.report().has_errors())
            in_.report().add("E010", {}, "the file holds no program", "write PROGRAM Name ... END_PROGRAM");
        return program;
    }
    if (at_item(in_)) {
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

ast::Program Parser::parse_part() {
    ast::Program program;
    mend_split_words(in_);
    parse_items(program);
    notes_.hand_over(program);
    return program;
}

ast::Program Parser::parse_claims() {
    ast::Program program;
    properties_.parse_file(program);
    notes_.hand_over(program);
    return program;
}

bool Parser::at_part() const {
    return at_item(in_) && !is_program(in_);
}

/// A program that does not begin with PROGRAM, or other text.
void Parser::parse_headless(ast::Program& program) {
    in_.error_here("PROGRAM at the start",
                   is_program(in_) ? help_of_headless(in_)
                                   : "a file for INCLUDE is checked with the program that includes it");
    while (!in_.at_end() && !in_.report().full()) {
        if (in_.take("PROGRAM")) {
            if (in_.is_word_at(0)) in_.skip();
        } else if (!in_.take("END_PROGRAM")) {
            parse_item(program);
        }
    }
    notes_.hand_over(program);
}

void Parser::parse_items(ast::Program& program) {
    program.steps_missing = program.steps_missing || in_.has_open_comment();
    bool was_told = false;
    while (!in_.at_end() && !in_.report().full()) {
        if (!in_.at("PROGRAM") && !in_.at("END_PROGRAM")) {
            parse_item(program);
            continue;
        }
        if (!was_told) {
            in_.report().add(
                "E010", in_.token().span,
                fmt::format("{} stands in a file that is included", shown(in_.token())),
                "such a file has what stands between PROGRAM Name and END_PROGRAM, without these words");
        }
        if (in_.at("PROGRAM") &&
            !std::exchange(was_told, true)) {  // a whole program: its declarations would conflict
            miss_names(program);
            while (!in_.at_end()) in_.skip();
            return;
        }
        was_told = true;
        in_.skip();
    }
}

void Parser::parse_item(ast::Program& program) {
    if (in_.take_symbol(";") || (program.steps_missing && in_.take("END_STEP"))) return;
    if (in_.at("MOTOR")) return declarations_.parse_motor(program);
    if (in_.at("SCALE")) return declarations_.parse_scale(program);
    if (in_.at("ON")) return many_steps_.parse_on(program);
    if (in_.at("GROUP")) return many_steps_.parse_group(program);
    if (many_steps_.at_group_output()) return many_steps_.parse_group_output(program);
    if (in_.at("CONST")) return declarations_.parse_constant(program);
    if (in_.at("SET_POINT")) return set_points_.parse(program);
    if (in_.take("VAR_INPUT")) return declarations_.parse_variables(program.inputs, ast::Role::input);
    if (in_.take("VAR_OUTPUT")) return declarations_.parse_variables(program.outputs, ast::Role::output);
    if (in_.take("VAR_MOTOR"))
        return declarations_.parse_variables(program.motor_variables, ast::Role::motor_variable);
    if (in_.at("POWER_UP")) return steps_.parse_power_up(program);
    if (in_.at("STEP")) return steps_.parse(program);
    if (in_.at("SEQUENCE")) return sequences_.parse(program);
    if (in_.at("INCLUDE")) return parse_include(program);
    if (in_.at("PROPERTY")) return properties_.parse(program);
    if (in_.at("ASSUME")) return properties_.parse_assumption(program);
    if (in_.at("TERM")) {
        if (!terms_.parse(program.terms)) in_.recover();
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
    if (refuse_foreign_item(in_, program)) return;
    in_.error_here(expected, "this belongs into a step, or a block above it ends too early");
    program.steps_missing = true;
    in_.skip();
    recover_item(in_);
}

void Parser::parse_include(ast::Program& program) {
    in_.skip();
    const Token path = in_.token();
    if (path.kind != TokenKind::text) {
        in_.error_here("the name of a file in single quotes", "write INCLUDE 'wiring.seqi';");
        miss_names(program);
        return in_.recover();
    }
    in_.skip();
    program.includes.push_back(path.span);
    in_.end_statement();
    const Sources::Inclusion* inclusion =
        sources_ == nullptr ? nullptr : sources_->inclusion_at(path.span.offset);
    if (inclusion == nullptr || inclusion->failed) {
        miss_names(program);
    } else if (inclusion->file) {
        parse_file(sources_->files()[*inclusion->file], program);
    }
}

/// Parses another file's tokens and returns to these.
void Parser::parse_file(const SourceFile& file, ast::Program& program) {
    Report lexical;
    std::vector<Token> tokens = tokens_of(*sources_, file, lexical);
    const bool comment_is_open = lexical.has("E002");
    if (lexical.has_more()) in_.report().note_more();
    for (Diagnostic& diagnostic : lexical.take()) in_.report().add(std::move(diagnostic));
    TokenStream::File outer = in_.exchange({std::move(tokens), comment_is_open});
    mend_split_words(in_);
    if (comment_is_open) miss_names(program);
    parse_items(program);
    in_.exchange(std::move(outer));
}

}  // namespace nplc::seqc
