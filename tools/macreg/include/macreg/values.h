#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "macreg/causes.h"
#include "registers/convert.h"
#include "registers/details.h"
#include "registers/mac.h"

/// A register's value as people read and type it.
namespace nplc::macreg {

/// "0 to 1023 (0 to 100 %peak)".
std::string range_text(const registers::Register& reg, registers::Model model);

/// The same, but of MODE_REG only the modes: what else it takes is no value to choose.
std::string choice_text(const registers::Register& reg, registers::Model model);

/// What a user typed for a register. `error` is a whole sentence, empty if all is well.
struct TypedValue {
    std::int64_t raw = 0;
    std::string error{};
    std::string rounding{};  ///< "1500 rpm is 3145.73 steps, taken as 3146 (1500.13 rpm)"; empty if exact
};

/// Takes what registers::parse takes, further `raw:1600`, hex as `0x640`, names of values (`P_MODE`) and of
/// bits
/// (`HICLK+INPSIGN`). Never out of range.
TypedValue typed_value(const registers::Register& reg, registers::Model model, std::string_view text);

/// The register by name or number, with what to do if there is none; nearest names are told.
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
    std::string error{};  ///< a sentence on the first word that is wrong; empty: all is well
};

/// NAME VALUE or NAME=VALUE, also several; a unit may stand apart: `V_SOLL 1500 rpm`.
ReadAssignments read_assignments(registers::Model model, const std::vector<std::string>& words);

/// What the program MacTalk calls the register (004, "MacTalk name"): "Max velocity". R: of MAC50 to MAC141
/// the register of the same name, for 002 gives none. Empty: it has none of its own.
std::string mactalk_name(const registers::Register& reg);

}  // namespace nplc::macreg
