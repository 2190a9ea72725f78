#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "decompile/draft.h"
#include "decompile/layout.h"
#include "decompile/statements.h"

namespace nplc::seqc {

/// A stretch of the program and what it says.
struct Passage {
    enum class Kind : std::uint8_t { names, values, on_error, power_up, entry, step, rest };
    Kind kind = Kind::rest;
    std::uint8_t step = 0;
    std::size_t end = 0;  ///< it reaches from the one before to here
};

struct WrittenProgram {
    std::string text;
    std::vector<Passage> passages;
};

/// The program of a draft, `head` (comment lines) first.
WrittenProgram write_program(const Layout& layout, const Draft& draft, const WriterContext& context,
                             const std::string& head);

}  // namespace nplc::seqc
