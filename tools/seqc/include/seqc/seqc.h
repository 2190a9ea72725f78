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
#include "seqc/sources.h"
#include "seqc/written.h"
#include "set_points/record.h"

namespace nplc::seqc {

/// A name of VAR_MOTOR.
struct MotorName {
    std::string name;
    std::string reg;                      ///< as in the manual: V1
    std::uint8_t number = 0;              ///< 1..127
    std::optional<std::int64_t> initial;  ///< what POWER_UP writes, in the register's own steps
    bool operator==(const MotorName&) const = default;
};

/// A name for several steps: a GROUP, or the steps of a SEQUENCE.
struct StepGroup {
    std::string name;
    std::uint64_t steps = 0;  ///< a bit for each, copies included
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

/// What the numbers of a table are called in its source.
struct Symbols {
    std::string program;
    registers::Model motor = registers::Model::mac140;  ///< whose registers they are
    /// The drive that the gateway translates them for; null: the motor has them itself.
    const registers::DriveModel* drive = nullptr;
    std::optional<Scale> scale;
    std::array<std::string, 63> steps;     ///< by step number; empty where the table has no such step
    std::array<std::string, 63> made_for;  ///< why the compiler made the step; empty: the program has it
    /// Of which step it is a copy; a step's name means its copies too.
    std::array<std::optional<std::uint8_t>, 63> copy_of;
    std::vector<StepGroup> groups;
    std::vector<NamedTime> times;
    std::array<std::string, 6> inputs;   ///< as declared, else IN0..IN5
    std::array<std::string, 4> outputs;  ///< as declared, else OUT0..OUT3
    std::vector<MotorName> motor_names;  ///< in source order
    set_points::Record set_points;       ///< values that a user may change
    bool operator==(const Symbols&) const = default;
};

/// A bit for the step and for each copy of it, by number.
inline std::uint64_t with_copies(const Symbols& symbols, std::uint8_t step) {
    std::uint64_t bits = std::uint64_t{1} << step;
    for (std::size_t i = 0; i < symbols.copy_of.size(); ++i) {
        if (symbols.copy_of[i] == step) bits |= std::uint64_t{1} << i;
    }
    return bits;
}

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
    double lost = 0;   ///< what was written minus what the register gets, in its own steps
    double per_unit = 1;
    std::string unit = {};
    bool is_negative = false;
    bool is_made_good = false;  ///< a value of another register counts on the rounded one
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
    Written written;
    bool more_diagnostics = false;  ///< there were more than 100
    bool ok = false;                ///< no errors; warnings do not count
};

/// Compiles the text of one program. Takes any bytes; never throws on bad input.
Compilation compile(std::string_view source);
/// The same with the files that it includes.
Compilation compile(const Sources& sources);

/// All diagnostics as the user sees them, whether there are more, and their number. Empty if there are none.
std::string render_all(const Compilation& compilation, std::string_view source, std::string_view file_name,
                       Colour colour = Colour::off);
std::string render_all(const Compilation& compilation, const Sources& sources, Colour colour = Colour::off);

/// Every term with its bytes, what it does and its source line, then the rounded constants, room and time.
std::string listing(const Compilation& compilation, const Sources& sources);
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
