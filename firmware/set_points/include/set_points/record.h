#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "registers/set_points.h"

/// The set-points of a table in the form used by programs, and their record (registers/set_points.h).
namespace nplc::set_points {

using registers::set_points::ValueKind;

struct SetPoint {
    std::string name;
    ValueKind kind = ValueKind::motor_register;
    std::uint8_t reg = 0;  ///< for a motor register
    bool longword = false;
    bool at_power_up = false;  ///< POWER_UP writes it
    std::uint8_t unit_code = 0;
    std::string unit;  ///< as written in the program; may be empty
    double steps_per_unit = 1;
    double step = 0;  ///< in `unit`; 0: every value of the range
    /// Origin of the steps, in `unit`: the lower end as the program has it. Empty: as shown.
    std::optional<double> grid_from{};
    std::int32_t initial = 0;
    std::int32_t lowest = 0;
    std::int32_t highest = 0;
    std::vector<std::uint16_t> places;  ///< numbers of the terms with the value
    bool operator==(const SetPoint&) const = default;
};

struct Record {
    std::vector<SetPoint> values;
    std::uint64_t takes = 0;  ///< bit n: step n takes changed values
    bool operator==(const Record&) const = default;
};

/// CRC-32 of the name in capitals: identifies the set-point of a stored value.
std::uint32_t hash_of(std::string_view name);

/// Empty without set-points.
std::vector<std::uint8_t> encode(const Record& record);
/// Empty if the bytes are no valid record of this table. `bytes`: the record only.
std::optional<Record> decode(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> table);
/// The same without the table: checks the record itself only.
std::optional<Record> decode(std::span<const std::uint8_t> bytes);

/// The uploaded content: the table, then its record if it has one.
std::vector<std::uint8_t> with_record(std::span<const std::uint8_t> table, const Record& record);

/// Case-insensitive; null if there is none.
const SetPoint* find(const Record& record, std::string_view name);

}  // namespace nplc::set_points
