#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "registers/family.h"
#include "registers/mac.h"
#include "seqc/diagnostic.h"

namespace nplc::seqc {

/// A name of VAR_MOTOR.
struct MotorName {
    std::string name;
    std::string reg;                      ///< as in the manual: V1
    std::uint8_t number = 0;              ///< 1..127
    std::optional<std::int64_t> initial;  ///< what POWER_UP writes, in the register's own steps
    bool operator==(const MotorName&) const = default;
};

/// SCALE 1 rev = 5 mm
struct Scale {
    double revolutions = 1;
    double length = 1;
    std::string unit;
    bool operator==(const Scale&) const = default;
};

/// What the numbers of a table are called in its source.
struct Symbols {
    std::string program;
    registers::Model motor = registers::Model::mac140;  ///< whose registers they are
    /// The drive that the gateway translates them for; null: the motor has them itself.
    const registers::DriveModel* drive = nullptr;
    std::optional<Scale> scale;
    std::array<std::string, 63> steps;     ///< by step number; empty where the table has no such step
    std::array<std::string, 63> made_for;  ///< why the compiler made the step; empty: the program has it
    std::array<std::string, 6> inputs;     ///< as declared, else IN0..IN5
    std::array<std::string, 4> outputs;    ///< as declared, else OUT0..OUT3
    std::vector<MotorName> motor_names;    ///< in source order
    bool operator==(const Symbols&) const = default;
};

/// Where a step comes from, and what its OUT without WHEN switches on.
struct StepOrigin {
    std::uint8_t number = 0;
    Span span;  ///< of its name; length 0 for a POWER_UP that the compiler adds
    std::uint8_t outputs = 0;
};

/// A check of `seqc verify` that is switched off in a step.
struct Allowance {
    std::uint8_t step = 0;
    std::string code;  ///< V006
    std::string reason;
};

/// Where a term of the table comes from, in table order, the end term included.
struct TermOrigin {
    Span span;  ///< length 0 for what the compiler adds by itself
};

/// A constant that was rounded to what the register can hold.
struct Rounding {
    Span span;
    std::string text;  ///< "V1 := 1500 rpm is 3146 (1500.13 rpm, +0.009 %)"
};

struct Compilation {
    std::vector<std::uint8_t> table;      ///< whole terms up to the end term; empty when there are errors
    std::vector<Diagnostic> diagnostics;  ///< in source order, 100 at the most
    Symbols symbols;
    std::vector<TermOrigin> origins;
    std::vector<StepOrigin> steps;  ///< by number, POWER_UP first
    std::vector<Rounding> roundings;
    std::vector<Span> properties;  ///< PROPERTY Name: ... ; in source order, what it names not looked up
    std::vector<Allowance> allowances;
    bool more_diagnostics = false;  ///< there were more than 100
    bool ok = false;                ///< no errors; warnings do not count
};

/// Compiles the text of one program. Takes any bytes; never throws on bad input.
Compilation compile(std::string_view source);

/// All diagnostics as the user sees them, whether there are more, and their number. Empty if there are none.
std::string render_all(const Compilation& compilation, std::string_view source, std::string_view file_name,
                       Colour colour = Colour::off);

/// Every term with its bytes, what it does and its source line, then the rounded constants, room and time.
std::string listing(const Compilation& compilation, std::string_view source, std::string_view file_name);

struct Disassembly {
    std::string text;                ///< a program of TERM lines; compiling it gives the table's bytes again
    std::size_t trailing_bytes = 0;  ///< after the end term, left out
    std::string error;               ///< why there is no text; empty when there is
};

/// Takes a raw table: terms of 8 bytes up to the first whose STATE is 63. With symbols the comments name
/// steps, signals and registers as the program did.
Disassembly disassemble(std::span<const std::uint8_t> table, std::string_view program_name,
                        const Symbols* symbols = nullptr);

}  // namespace nplc::seqc
