#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "registers/midi.h"
#include "registers/scale.h"

/// The parameters of a MIDI module by name, their values, and numbers with units, as users read and type
/// them.
namespace nplc::macreg::midi {

namespace reg = registers::midi;
using registers::midi::Model;

enum class Sort : std::uint8_t {
    position,     ///< increments
    period,       ///< of full speed
    long_period,  ///< of unstall speed
    ramp,
    torque,
    tolerance,  ///< increments, not negative
    choice,
    temperature,
    supply,
    status,
    terminals,
    release,
    number,
};

struct Choice {
    std::int32_t value;
    std::string_view name;
};

struct Parameter {
    std::string_view name;
    Sort sort;
    std::string_view title;
    std::optional<reg::Query> query{};  ///< nullopt: it cannot be read
    std::size_t field = 0;              ///< of the query's reply
    std::uint8_t sub_index = 0;
    std::optional<reg::Command> command{};  ///< nullopt: it is read-only
    std::span<const Choice> choices{};
};

std::span<const Parameter> parameters();
/// In any case of letters.
const Parameter* find_parameter(std::string_view name);
/// The parameter's value in a query's reply.
std::int64_t raw_in(const Parameter& parameter, std::uint32_t reply);
/// The command's four bytes.
std::uint32_t data_for(const Parameter& parameter, std::int64_t raw);
/// The command behind a parameter; needs one.
const reg::CommandRow& row_of(const Parameter& parameter);

struct Quantity {
    registers::Ratio size{0, 1};  ///< absolute value; 0 / 1 for no number
    bool negative = false;
    std::string unit{};  ///< as typed, without blanks; empty if there is none
};
/// `1500 rpm`, `-2.5rev`, `+10`, `50%`, `0x1F`; nullopt if it is no number, or has more than 12 digits.
std::optional<Quantity> read_quantity(std::string_view text);

/// A module's address on any kind of line, 0 to 127.
std::optional<std::uint8_t> read_address(std::string_view text);

/// The nearest whole number; nullopt beyond 32 bits.
std::optional<std::int64_t> nearest(const registers::Ratio& ratio);

/// The typed value, in whole increments or in a speed; `error` is a sentence, empty if it is valid.
struct TypedNumber {
    std::int64_t value = 0;
    bool exact = true;
    std::string error{};
};

/// A position or distance: `inc` (also without a unit) or `rev`, which needs the model.
TypedNumber typed_position(std::string_view text, std::optional<Model> model);
/// A speed's period in ticks of 0.125 us, negative for the other direction: `rpm`, `rev/s`, `inc/s`.
TypedNumber typed_period(std::string_view text, std::optional<Model> model);
/// Whole increments a second, or a second^2 with `squared`: `inc/s`, `rev/s`, `rpm`; `inc/s2`, `rev/s2`.
TypedNumber typed_rate(std::string_view text, std::optional<Model> model, bool squared);
/// `5s`, `200ms`, `0.5 min`; without a unit seconds. In microseconds.
TypedNumber typed_time(std::string_view text);

/// The reference values of turns, percent and degrees.
struct Scale {
    std::optional<reg::Model> model{};  ///< without it, increments
    std::int64_t imax = reg::kMostTorque;
    std::int64_t period = 0;  ///< of SPEED, for accelerations; 0: unknown
};

/// "20480 inc (2.0480 rev)", "300 rpm", "50.0 %", "standby"; raw numbers where the model is not known.
std::string value_text(const Parameter& parameter, std::int64_t raw, const Scale& scale);

struct TypedValue {
    std::int64_t raw = 0;
    std::string error{};     ///< a sentence, empty if it is valid
    std::string rounding{};  ///< how the value was rounded; empty if it is exact
};
/// Accepts what value_text shows and the units of `units_text`; `raw:480`. The result is always in range.
TypedValue typed_value(const Parameter& parameter, std::string_view text, const Scale& scale);

/// "rpm, rev/s, inc/s", "none, hardware, software, both"; empty for a read-only parameter.
std::string units_text(const Parameter& parameter);

/// Sentences for the bits that are set, and for states without a bit; empty if there is none.
std::string status_words(std::uint32_t status);
std::string terminal_words(std::uint32_t terminals);
/// "7.4" of 00000704h (R).
std::string release_text(std::uint32_t release);
/// "300 rpm (10000 inc/s)", or "10000 inc/s".
std::string speed_text(std::int64_t period, const Scale& scale);
/// "20480 inc (2.0480 rev)".
std::string position_text(std::int64_t position, const Scale& scale);

}  // namespace nplc::macreg::midi
