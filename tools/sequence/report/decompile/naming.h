#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "registers/mac.h"
#include "report/decompile/formula.h"
#include "seqc/seqc.h"
#include "sequencer/term.h"

namespace nplc::seqc {

/// Names for the program to be written. All names are unique and none is a reserved word.
struct Naming {
    Symbols symbols;
    BitNames bits;                          ///< the inputs as in `symbols`, INPOS and so on
    std::array<bool, 6> declared_inputs{};  ///< has its own name, so it must be declared if it is used
    std::array<bool, 4> declared_outputs{};
    std::map<std::uint8_t, std::string> registers{};  ///< given names of VAR_MOTOR, by number
    /// Set-points that are known to own every occurrence of their value in the table.
    std::vector<set_points::SetPoint> set_points{};
    bool exact_places =
        false;             ///< positions that SCALE rounds are written in counts: relative moves add it up
    bool made_up = false;  ///< steps, inputs and outputs have no given names

    /// The set-point whose default is at this place; null: a constant.
    const set_points::SetPoint* set_point(set_points::ValueKind kind, std::uint8_t reg,
                                          std::int32_t value) const;
    const set_points::SetPoint* set_point_of(std::uint8_t reg) const;

    /// Name of a variable for the start value of a register without a given name.
    std::string value_name(std::string_view reg) const;
};

/// `given` may be null, or contain invalid names.
Naming naming_of(const Symbols* given, const std::string& program, registers::Model motor);

}  // namespace nplc::seqc
