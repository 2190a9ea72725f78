#pragma once

#include <cstdint>
#include <string_view>

#include "seqc/diagnostic.h"

namespace nplc::seqc {

enum class TokenKind : std::uint8_t {
    end,
    identifier,  ///< keywords too, by their place
    number,      ///< 12, 1_000, 3.5
    based,       ///< 16#C0, 2#1010, 8#17
    time,        ///< T#1s500ms
    direct,      ///< %IX0.0, %peak
    text,        ///< 'words in quotes'
    symbol,      ///< one of  := : ; , ( ) . = + - * /
    comment,     ///< only on request
};

struct Token {
    TokenKind kind = TokenKind::end;
    std::string_view text;
    Span span;
};

}  // namespace nplc::seqc
