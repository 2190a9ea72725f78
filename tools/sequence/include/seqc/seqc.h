#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "registers/family.h"
#include "registers/mac.h"
#include "seqc/diagnostic.h"
#include "seqc/sources.h"
#include "seqc/written.h"
#include "set_points/record.h"

namespace nplc::seqc {

/// A name of VAR_MOTOR.
struct MotorName {
    std::string name;
    std::string reg;                      ///< manual's name: V1
    std::uint8_t number = 0;              ///< 1..127
    std::optional<std::int64_t> initial;  ///< the value that POWER_UP writes, raw
    bool operator==(const MotorName&) const = default;
};

/// A name for several steps: a GROUP, or the steps of a SEQUENCE.
struct StepGroup {
    std::string name;
    std::uint64_t steps = 0;  ///< bit mask, copies included
    bool operator==(const StepGroup&) const = default;
};

/// A constant that is a time.
struct NamedTime {
    std::string name;
    std::uint32_t milliseconds = 0;
    bool operator==(const NamedTime&) const = default;
};

/// SCALE 1 rev = 5 mm
struct Scale {
    double revolutions = 1;
    double length = 1;
    std::string unit;
    bool operator==(const Scale&) const = default;
};

/// The names of a table's numbers in its source.
struct Symbols {
    std::string program;
    registers::Model motor = registers::Model::mac140;  ///< the motor with these registers
    /// The drive for which the gateway translates the registers; null: the motor has them itself.
    const registers::DriveModel* drive = nullptr;
    std::optional<Scale> scale;
    std::array<std::string, 63> steps;  ///< by step number; empty if the table has no such step
    std::array<std::string, 63>
        made_for;  ///< why the compiler generated the step; empty: it is in the program
    /// The original of a copied step; a step's name includes its copies.
    std::array<std::optional<std::uint8_t>, 63> copy_of;
    /// A bit for each step whose timer only limits it (WITHIN) or makes it blink.
    std::uint64_t timer_is_limit = 0;
    std::vector<StepGroup> groups;
    std::vector<NamedTime> times;
    std::array<std::string, 6> inputs;  ///< as declared, else IN0..IN5
    /// A bit for each input whose name holds while its wire is off: AT NOT.
    std::uint8_t inverted_inputs = 0;
    std::array<std::string, 4> outputs;  ///< as declared, else OUT0..OUT3
    std::vector<MotorName> motor_names;  ///< in source order
    set_points::Record set_points;       ///< values that a user may change
    /// What the program first writes a register in, by its number; empty: a plain number.
    std::map<std::uint8_t, std::string> units;
    bool operator==(const Symbols&) const = default;
};

inline bool is_inverted(const Symbols& symbols, std::size_t input) {
    return ((symbols.inverted_inputs >> input) & 1U) != 0;
}

/// What holds while the wire of the input is on: "Start", "NOT Estop".
inline std::string wire_name(const Symbols& symbols, std::size_t input) {
    return (is_inverted(symbols, input) ? "NOT " : "") + symbols.inputs[input];
}

/// The step as it was written: for a copy that the compiler made (for an edge, blinking, an output that is
/// set) its original. A step of a later CALL is its own original.
inline std::uint8_t step_as_written(const Symbols& symbols, std::uint8_t step) {
    if (step >= symbols.copy_of.size() || !symbols.made_for[step].starts_with("copy of ")) return step;
    return symbols.copy_of[step].value_or(step);
}

/// Bit mask of the step and its copies.
inline std::uint64_t with_copies(const Symbols& symbols, std::uint8_t step) {
    std::uint64_t bits = std::uint64_t{1} << step;
    for (std::size_t i = 0; i < symbols.copy_of.size(); ++i) {
        if (symbols.copy_of[i] == step) bits |= std::uint64_t{1} << i;
    }
    return bits;
}

/// Source of a step, and the outputs of its OUT without WHEN.
struct StepOrigin {
    std::uint8_t number = 0;
    Span span;  ///< of its name; length 0 for a POWER_UP added by the compiler
    std::uint8_t outputs = 0;
};

/// A check of `seqc verify` that a step disables.
struct Allowance {
    std::uint8_t step = 0;
    std::string code;  ///< V006
    std::string reason;
};

/// Source of each term in table order, end term included.
struct TermOrigin {
    Span span;  ///< length 0 for terms added by the compiler
};

/// A constant that was rounded to the register's resolution.
struct Rounding {
    Span span;
    std::string text;  ///< "V1 := 1500 rpm is 3146 (1500.13 rpm, +0.009 %)"
    double lost =
        0;  ///< what was written minus what a place or a distance adds up to, in the register's steps
    double per_unit = 1;
    std::string unit = {};
    bool is_negative = false;
    bool is_made_good = false;  ///< a value of another register counts on the rounded one
    bool makes_good = false;    ///< it counts on another one itself
};

struct Compilation {
    std::vector<std::uint8_t> table;      ///< whole terms up to the end term; empty on errors
    std::vector<Diagnostic> diagnostics;  ///< in source order, 100 at the most
    Symbols symbols;
    std::vector<TermOrigin> origins;
    std::vector<StepOrigin> steps;  ///< by number, POWER_UP first
    std::vector<Rounding> roundings;
    std::vector<Allowance> allowances;
    Written written;
    bool more_diagnostics = false;  ///< there were more than 100
    bool ok = false;                ///< no errors; warnings do not count
};

/// Compiles the text of one program. Accepts any bytes; never throws on bad input.
Compilation compile(std::string_view source);
/// The same with included files.
Compilation compile(const Sources& sources);

/// All diagnostics as shown to the user, with their number and whether there are more. Empty if there are
/// none.
std::string render_all(const Compilation& compilation, std::string_view source, std::string_view file_name,
                       Colour colour = Colour::off);
std::string render_all(const Compilation& compilation, const Sources& sources, Colour colour = Colour::off);

/// Every term with its bytes, its effect and its source line, then the rounded constants, memory use and
/// time.
std::string listing(const Compilation& compilation, const Sources& sources);
std::string listing(const Compilation& compilation, std::string_view source, std::string_view file_name);

struct Disassembly {
    std::string text;                ///< a program of TERM lines; compiling it reproduces the table's bytes
    std::size_t trailing_bytes = 0;  ///< after the end term, ignored
    std::string error;               ///< why there is no text; empty on success
};

/// Reads a raw table: terms of 8 bytes up to the first whose STATE is 63. With symbols the comments use the
/// program's names of steps, signals and registers.
Disassembly disassemble(std::span<const std::uint8_t> table, std::string_view program_name,
                        const Symbols* symbols = nullptr);

}  // namespace nplc::seqc
