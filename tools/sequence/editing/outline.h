#pragma once

#include <string>
#include <vector>

#include "editing/program.h"

namespace nplc::seqc::analysis {

struct Symbol {
    Kind kind = Kind::step;
    std::string name;
    std::string detail;
    Span whole;
    Span selection;
    std::vector<Symbol> children;
};

/// The program with its variables, steps, groups and properties below it.
std::vector<Symbol> symbols_of(const Program& program);

struct Fold {
    std::uint32_t first_line = 0;
    std::uint32_t last_line = 0;
    bool is_comment = false;
};
std::vector<Fold> folds_of(const Program& program);

/// Selection ranges around a place, from the word to the whole text.
std::vector<Span> selections_at(const Program& program, std::uint32_t offset);

/// Token types for syntax colouring.
enum class TokenType : std::uint8_t {
    keyword,
    step,
    group,
    input,
    output,
    register_name,
    command,
    number,
    unit,
    comment,
    text,
    property,
    word_operator,
    motor,
};
struct Coloured {
    Span span;
    TokenType type = TokenType::keyword;
    bool declares = false;
    bool read_only = false;
};
/// In source order; tokens do not overlap.
std::vector<Coloured> colours_of(const Program& program);

}  // namespace nplc::seqc::analysis
