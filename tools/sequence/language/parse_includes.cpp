#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "language/foreign_words.h"
#include "language/names.h"
#include "language/parser.h"

/// INCLUDE 'wiring.seqi'; and the included files.
namespace nplc::seqc {
namespace {

constexpr auto kPartWords = std::to_array<std::string_view>(
    {"MOTOR", "SCALE", "CONST", "VAR_INPUT", "VAR_OUTPUT", "VAR_MOTOR", "ON", "GROUP", "POWER_UP", "STEP",
     "SEQUENCE", "TERM", "PROPERTY", "ASSUME", "INCLUDE"});

}  // namespace

bool Parser::is_program() const {
    return std::any_of(in_.tokens().begin(), in_.tokens().end(), [](const Token& t) {
        return same_name(t.text, "PROGRAM") || same_name(t.text, "END_PROGRAM");
    });
}

bool Parser::at_item() const {
    return in_.token().kind == TokenKind::identifier &&
           std::any_of(kPartWords.begin(), kPartWords.end(),
                       [&](std::string_view word) { return same_name(word, in_.token().text); });
}

ast::Program Parser::parse_part() {
    ast::Program program;
    mend_split_words();
    parse_items(program);
    notes_.hand_over(program);
    return program;
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

std::string Parser::help_of_headless() const {
    const ForeignWord* word = foreign_word(in_.token().text);
    return word != nullptr ? std::string(word->help)
                           : "PROGRAM Name comes first; only comments stand before it";
}

/// A program that does not begin with PROGRAM, or other text.
void Parser::parse_headless(ast::Program& program) {
    in_.error_here("PROGRAM at the start",
                   is_program() ? help_of_headless()
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

/// An unknown name may be one that could not be parsed.
void Parser::miss_names(ast::Program& program) {
    program.steps_missing = program.names_missing = program.motor_missing = program.scale_missing = true;
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
    mend_split_words();
    if (comment_is_open) miss_names(program);
    parse_items(program);
    in_.exchange(std::move(outer));
}

}  // namespace nplc::seqc
