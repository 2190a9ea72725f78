#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "registers/midi.h"
#include "registers/scale.h"

/// Numbers with units as people type them for MIDI modules, exactly.
namespace nplc::macreg::midi {

using registers::midi::Model;

struct Quantity {
    registers::Ratio size{0, 1};  ///< without its sign; 0 / 1 for nothing
    bool negative = false;
    std::string unit{};  ///< as typed, without blanks; empty if there is none
};
/// `1500 rpm`, `-2.5rev`, `+10`, `50%`, `0x1F`; nothing if it is no number, or has more than 12 digits.
std::optional<Quantity> read_quantity(std::string_view text);

/// The nearest whole number; nothing beyond 32 bits.
std::optional<std::int64_t> nearest(const registers::Ratio& ratio);

/// What was typed, in whole increments or in a speed; `error` is a sentence, empty if all is well.
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

}  // namespace nplc::macreg::midi
