#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "registers/midi.h"

/// What a MIDI module can be asked for and told, by name.
namespace nplc::macreg::midi {

namespace reg = registers::midi;

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
    std::optional<reg::Query> query{};  ///< nothing: it cannot be read
    std::size_t field = 0;              ///< of the query's reply
    std::uint8_t sub_index = 0;
    std::optional<reg::Command> command{};  ///< nothing: it is read only
    std::span<const Choice> choices{};
};

std::span<const Parameter> parameters();
/// In any case of letters.
const Parameter* find_parameter(std::string_view name);
/// What a query's reply holds of it.
std::int64_t raw_in(const Parameter& parameter, std::uint32_t reply);
/// The command's four bytes.
std::uint32_t data_for(const Parameter& parameter, std::int64_t raw);
/// The command behind a parameter; needs one.
const reg::CommandRow& row_of(const Parameter& parameter);

}  // namespace nplc::macreg::midi
