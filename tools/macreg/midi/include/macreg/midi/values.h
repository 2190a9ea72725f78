#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "macreg/midi/parameters.h"

/// A parameter's value as people read and type it.
namespace nplc::macreg::midi {

/// What turns, percent and degrees are of.
struct Scale {
    std::optional<reg::Model> model{};  ///< without it, increments
    std::int64_t imax = reg::kMostTorque;
    std::int64_t period = 0;  ///< of SPEED, for accelerations; 0: not known
};

/// "20480 inc (2.0480 rev)", "300 rpm", "50.0 %", "standby"; numbers as the module has them where the model
/// is not known.
std::string value_text(const Parameter& parameter, std::int64_t raw, const Scale& scale);

struct TypedValue {
    std::int64_t raw = 0;
    std::string error{};     ///< a sentence, empty if all is well
    std::string rounding{};  ///< what became of the value; empty if it is exact
};
/// Takes what value_text shows and the units of `units_text`; `raw:480`. Never out of range.
TypedValue typed_value(const Parameter& parameter, std::string_view text, const Scale& scale);

/// "rpm, rev/s, inc/s", "none, hardware, software, both"; empty for what is read only.
std::string units_text(const Parameter& parameter);

/// Sentences of the bits that are set, and what there is no bit for; empty if none is.
std::string status_words(std::uint32_t status);
std::string terminal_words(std::uint32_t terminals);
/// "7.4" of 00000704h (R).
std::string release_text(std::uint32_t release);
/// "300 rpm (10000 inc/s)", or "10000 inc/s".
std::string speed_text(std::int64_t period, const Scale& scale);
/// "20480 inc (2.0480 rev)".
std::string position_text(std::int64_t position, const Scale& scale);

}  // namespace nplc::macreg::midi
