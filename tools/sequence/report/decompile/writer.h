#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/decompile/draft.h"
#include "report/decompile/layout.h"
#include "report/decompile/statements.h"

namespace nplc::seqc {

/// A section of the program and its meaning.
struct Passage {
    enum class Kind : std::uint8_t { names, values, on_error, power_up, entry, step, rest };
    Kind kind = Kind::rest;
    std::uint8_t step = 0;
    std::size_t end = 0;  ///< it extends from the previous one to here
};

struct WrittenProgram {
    std::string text;
    std::vector<Passage> passages;
};

/// "SET_POINT Speed AT V1 := 600 rpm RANGE 60 rpm .. 2000 rpm;"
std::string declaration_of(const set_points::SetPoint& point, const WriterContext& context);

/// Writes the program of a draft, with `head` (comment lines) first.
WrittenProgram write_program(const Layout& layout, const Draft& draft, const WriterContext& context,
                             const std::string& head);

}  // namespace nplc::seqc
