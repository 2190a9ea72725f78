#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "registers/mac.h"

/// The words of `set`.
namespace nplc::macreg {

struct Assignment {
    const registers::Register* reg;
    std::string text;
    std::int64_t raw = 0;
    std::string rounding{};  ///< as TypedValue's
};

struct ReadAssignments {
    std::vector<Assignment> all{};
    std::string error{};  ///< a sentence on the first word that is wrong; empty: all is well
};

/// NAME VALUE or NAME=VALUE, also several; a unit may stand apart: `V_SOLL 1500 rpm`.
ReadAssignments read_assignments(registers::Model model, const std::vector<std::string>& words);

}  // namespace nplc::macreg
