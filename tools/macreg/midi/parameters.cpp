#include "macreg/midi/parameters.h"

#include <algorithm>
#include <cctype>

namespace nplc::macreg::midi {
namespace {

constexpr Choice kOnOff[] = {{0, "off"}, {1, "on"}};
constexpr Choice kStops[] = {{0, "none"}, {1, "hardware"}, {8, "software"}, {9, "both"}};
constexpr Choice kStopTorque[] = {{0, "nominal"}, {1, "standby"}};

// clang-format off
constexpr Parameter kParameters[] = {
    {.name = "POSITION", .sort = Sort::position, .title = "Where the shaft is", .query = reg::GET_POSITION},
    {.name = "STATUS", .sort = Sort::status, .title = "Faults, warnings, end-stops", .query = reg::GET_STATUS},
    {.name = "SPEED", .sort = Sort::period, .title = "Full speed of moves", .query = reg::GET_SPEEDS, .field = 1, .command = reg::SPEED},
    {.name = "RAMP", .sort = Sort::ramp, .title = "Length of a ramp, from standstill to full speed", .query = reg::GET_SETTINGS, .field = 0, .command = reg::RAMP},
    {.name = "UNSTALL", .sort = Sort::long_period, .title = "Speed at which what is missing at the end of a move is made up", .query = reg::GET_SPEEDS, .field = 0, .command = reg::UNSTALL},
    {.name = "TORQUE", .sort = Sort::torque, .title = "Limit of the torque", .query = reg::GET_SETTINGS, .field = 1, .command = reg::TORQUE},
    {.name = "STOP_TORQUE", .sort = Sort::choice, .title = "Torque at standstill: all of it, or half", .query = reg::GET_SETTINGS, .field = 2, .command = reg::STOP_TORQUE, .choices = kStopTorque},
    {.name = "TOLERANCE", .sort = Sort::tolerance, .title = "How far from its target a move counts as done", .query = reg::GET_SETTINGS, .field = 4, .command = reg::TOLERANCE},
    {.name = "END_STOPS", .sort = Sort::choice, .title = "Which end-stops act", .query = reg::GET_SETTINGS, .field = 3, .command = reg::END_STOPS, .choices = kStops},
    {.name = "UPPER_STOP", .sort = Sort::position, .title = "Upper software end-stop", .query = reg::GET_UPPER_STOP, .command = reg::UPPER_STOP},
    {.name = "LOWER_STOP", .sort = Sort::position, .title = "Lower software end-stop", .query = reg::GET_LOWER_STOP, .command = reg::LOWER_STOP},
    {.name = "REFERENCE", .sort = Sort::choice, .title = "The reference input sets the position to 0; cannot be read, off after each start", .command = reg::REFERENCE, .choices = kOnOff},
    {.name = "TEMPERATURE", .sort = Sort::temperature, .title = "Temperature", .query = reg::GET_MEASURES, .field = 0},
    {.name = "SUPPLY", .sort = Sort::supply, .title = "Supply voltage", .query = reg::GET_MEASURES, .field = 1},
    {.name = "TERMINALS", .sort = Sort::terminals, .title = "End-stop and reference inputs, and whether it follows", .query = reg::GET_MEASURES, .field = 2},
    {.name = "IMAX", .sort = Sort::number, .title = "What TORQUE has at full torque (RAM AFh)", .query = reg::GET_RAM, .sub_index = reg::kImaxAddress},
    {.name = "RELEASE", .sort = Sort::release, .title = "Software release", .query = reg::GET_RELEASE},
};
// clang-format on

bool same(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) {
        return std::toupper(static_cast<unsigned char>(x)) == std::toupper(static_cast<unsigned char>(y));
    });
}

}  // namespace

std::span<const Parameter> parameters() {
    return kParameters;
}

const Parameter* find_parameter(std::string_view name) {
    const auto* found = std::find_if(std::begin(kParameters), std::end(kParameters),
                                     [name](const Parameter& one) { return same(one.name, name); });
    return found == std::end(kParameters) ? nullptr : found;
}

std::int64_t raw_in(const Parameter& parameter, std::uint32_t reply) {
    if (parameter.sub_index == reg::kImaxAddress) return reply >> 24;
    const reg::Field& field = reg::find_query(*parameter.query)->fields[parameter.field];
    const std::int32_t value = reg::unpack(field, reply);
    return field.bits == 32 && !field.is_signed ? std::int64_t{static_cast<std::uint32_t>(value)} : value;
}

const reg::CommandRow& row_of(const Parameter& parameter) {
    return *reg::find_command(*parameter.command);
}

std::uint32_t data_for(const Parameter& parameter, std::int64_t raw) {
    return reg::pack(row_of(parameter), static_cast<std::int32_t>(raw)).value_or(0);
}

}  // namespace nplc::macreg::midi
