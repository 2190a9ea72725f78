#pragma once

#include <optional>

#include "registers/mac.h"

namespace nplc::registers {

/// A range of raw values; 0..0 is none.
struct RawRange {
    std::int32_t from = 0;
    std::int32_t to = 0;
};

/// Description of a register besides its row in the map.
struct Details {
    std::uint8_t number;
    std::string_view title;
    RawRange recommended{};   ///< by the manual; both ends equal: its nominal value
    std::string_view note{};  ///< unclear or contradictory parts of the manual, and what applies here
};

/// The meaning of a field's value.
struct NamedValue {
    std::uint16_t value;
    std::string_view name;
    std::string_view meaning;
};

/// One or more bits of a register with a meaning of their own; for a mode or a pointer the whole register.
struct Field {
    std::uint8_t number;  ///< of the register
    std::uint8_t first;   ///< lowest bit
    std::uint8_t width;   ///< bits
    std::string_view name;
    std::string_view meaning;
    std::span<const NamedValue> values{};
};

constexpr std::uint32_t mask_of(const Field& field) {
    return (field.width >= 32 ? ~std::uint32_t{0} : (std::uint32_t{1} << field.width) - 1) << field.first;
}

constexpr std::uint32_t value_in(const Field& field, std::uint32_t bits) {
    return (bits & mask_of(field)) >> field.first;
}

/// Every register of the map has details. The manuals give no factory values.
const Details* details_of(Model model, std::uint8_t number);

/// Of a register, lowest bit first; none if it is just a number.
std::span<const Field> fields_of(Model model, std::uint8_t number);
/// By the manual's name, such as ERR_STAT's IN_POS. Case-insensitive.
const Field* field_of(Model model, std::uint8_t number, std::string_view name);
/// The register's bits for a name: a bit, or a value of a field as wide as the register. With `part` the
/// field's name and a value of it: HOME_MODE's BY_COMMAND, HOME2_MODE. Case-insensitive.
std::optional<std::uint32_t> bits_named(Model model, const Register& reg, std::string_view name);
std::optional<std::uint32_t> bits_named(Model model, const Register& reg, std::string_view part,
                                        std::string_view value);
/// The name of a value of a whole register, such as a mode; empty if it has none.
std::string_view name_of_value(Model model, const Register& reg, std::uint32_t bits);
/// Whether any register of the motor has a mode, a bit or a field of this name.
bool is_name_of_value(Model model, std::string_view name);
/// Null if the value has no name.
const NamedValue* named(const Field& field, std::uint32_t value);

std::string_view name_of(Format format);  ///< as the manuals write it: LongInt, Fixed8
std::string_view name_of(Access access);

}  // namespace nplc::registers
