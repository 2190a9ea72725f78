#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "macreg/causes.h"
#include "registers/convert.h"
#include "registers/details.h"
#include "registers/mac.h"

/// A register's value as users read and type it.
namespace nplc::macreg {

/// "0 to 1023 (0 to 100 %peak)".
std::string range_text(const registers::Register& reg, registers::Model model);

/// The same, but of MODE_REG only the modes: its other values are not offered.
std::string choice_text(const registers::Register& reg, registers::Model model);

/// The value that a user typed for a register. `error` is a whole sentence, empty if it is valid.
struct TypedValue {
    std::int64_t raw = 0;
    std::string error{};
    std::string rounding{};  ///< "1500 rpm is 3145.73 steps, taken as 3146 (1500.13 rpm)"; empty if exact
};

/// Accepts what registers::parse accepts, also `raw:1600`, hex as `0x640`, names of values (`P_MODE`) and of
/// bits (`HICLK+INPSIGN`). The result is always in range.
TypedValue typed_value(const registers::Register& reg, registers::Model model, std::string_view text);

/// The register by name or number; if there is none, an error with the nearest names and what to do.
struct NamedRegister {
    const registers::Register* reg = nullptr;
    std::string error;
};
NamedRegister find_register(registers::Model model, std::string_view name_or_number);

struct Assignment {
    const registers::Register* reg;
    std::string text;
    std::int64_t raw = 0;
    std::string rounding{};  ///< as TypedValue's
};

struct ReadAssignments {
    std::vector<Assignment> all{};
    std::string error{};  ///< a sentence on the first wrong word; empty: all are valid
};

/// NAME VALUE or NAME=VALUE, also several; a unit may be a word of its own: `V_SOLL 1500 rpm`.
ReadAssignments read_assignments(registers::Model model, const std::vector<std::string>& words);

/// The name of the register in the program MacTalk (004, "MacTalk name"): "Max velocity". R: for MAC50 to
/// MAC141 that of the register of the same name, since 002 gives none. Empty: it has none.
std::string mactalk_name(const registers::Register& reg);

}  // namespace nplc::macreg
