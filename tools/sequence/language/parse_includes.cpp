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
    return std::any_of(tokens_.begin(), tokens_.end(), [](const Token& t) {
        return same_name(t.text, "PROGRAM") || same_name(t.text, "END_PROGRAM");
    });
}

bool Parser::at_item() const {
    return token().kind == TokenKind::identifier &&
           std::any_of(kPartWords.begin(), kPartWords.end(),
                       [&](std::string_view word) { return same_name(word, token().text); });
}

/// Hands over the data collected besides the tree.
void Parser::hand_over(ast::Program& program) {
    program.texts = std::move(texts_);
    program.uses = std::move(uses_);
    program.blocks = std::move(blocks_);
    program.names_missing = program.names_missing || names_missing_;
    program.has_calls = has_calls_;
    program.faulty_names = std::move(faulty_names_);
}

ast::Program Parser::parse_part() {
    ast::Program program;
    mend_split_words();
    parse_items(program);
    hand_over(program);
    return program;
}

void Parser::parse_items(ast::Program& program) {
    program.steps_missing = program.steps_missing || comment_is_open_;
    bool was_told = false;
    while (token().kind != TokenKind::end && !report_.full()) {
        if (!at("PROGRAM") && !at("END_PROGRAM")) {
            parse_item(program);
            continue;
        }
        if (!was_told) {
            report_.add(
                "E010", token().span, fmt::format("{} stands in a file that is included", shown(token())),
                "such a file has what stands between PROGRAM Name and END_PROGRAM, without these words");
        }
        if (at("PROGRAM") &&
            !std::exchange(was_told, true)) {  // a whole program: its declarations would conflict
            miss_names(program);
            at_ = tokens_.size() - 1;
            return;
        }
        was_told = true;
        ++at_;
    }
}

std::string Parser::help_of_headless() const {
    const ForeignWord* word = foreign_word(token().text);
    return word != nullptr ? std::string(word->help)
                           : "PROGRAM Name comes first; only comments stand before it";
}

/// A program that does not begin with PROGRAM, or other text.
void Parser::parse_headless(ast::Program& program) {
    error_here("PROGRAM at the start",
               is_program() ? help_of_headless()
                            : "a file for INCLUDE is checked with the program that includes it");
    while (token().kind != TokenKind::end && !report_.full()) {
        if (take("PROGRAM")) {
            if (is_word_at(0)) ++at_;
        } else if (!take("END_PROGRAM")) {
            parse_item(program);
        }
    }
    hand_over(program);
}

/// An unknown name may be one that could not be parsed.
void Parser::miss_names(ast::Program& program) {
    program.steps_missing = program.names_missing = program.motor_missing = program.scale_missing = true;
}

void Parser::parse_include(ast::Program& program) {
    ++at_;
    const Token path = token();
    if (path.kind != TokenKind::text) {
        error_here("the name of a file in single quotes", "write INCLUDE 'wiring.seqi';");
        miss_names(program);
        return recover();
    }
    ++at_;
    program.includes.push_back(path.span);
    end_statement();
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
    if (lexical.has_more()) report_.note_more();
    for (Diagnostic& diagnostic : lexical.take()) report_.add(std::move(diagnostic));
    std::swap(tokens_, tokens);
    const std::size_t at = std::exchange(at_, 0);
    const bool outer_comment = std::exchange(comment_is_open_, comment_is_open);
    const bool outer_end = std::exchange(end_reported_, false);
    mend_split_words();
    if (comment_is_open) miss_names(program);
    parse_items(program);
    std::swap(tokens_, tokens);
    at_ = at;
    comment_is_open_ = outer_comment;
    end_reported_ = outer_end;
}

}  // namespace nplc::seqc
