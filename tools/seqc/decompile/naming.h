#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "decompile/formula.h"
#include "registers/mac.h"
#include "seqc/seqc.h"
#include "sequencer/term.h"

namespace nplc::seqc {

/// What things are called in the program to be written. No name stands twice, none has a meaning already.
struct Naming {
    Symbols symbols;
    BitNames bits;                          ///< the inputs as in `symbols`, INPOS and so on
    std::array<bool, 6> declared_inputs{};  ///< a name of its own, so it must be declared if it is used
    std::array<bool, 4> declared_outputs{};
    std::map<std::uint8_t, std::string> registers{};  ///< given names of VAR_MOTOR, by number
    /// Set-points of which every value in the table is known to be theirs.
    std::vector<set_points::SetPoint> set_points{};
    bool made_up = false;  ///< steps, inputs and outputs have no given names

    /// The set-point whose default stands here; null: a constant.
    const set_points::SetPoint* set_point(set_points::ValueKind kind, std::uint8_t reg,
                                          std::int32_t value) const;
    const set_points::SetPoint* set_point_of(std::uint8_t reg) const;

    /// A name for a variable that holds the start value of a register without a given one.
    std::string value_name(std::string_view reg) const;
};

/// `given` may be null, or hold names that are none.
Naming naming_of(const Symbols* given, const std::string& program, registers::Model motor);

}  // namespace nplc::seqc
