#include "causes/texts.h"

#include <fmt/format.h>

#include <algorithm>

#include "registers/layout.h"
#include "registers/scale.h"

namespace nplc::causes {

using registers::Field;
using registers::Model;
using registers::Register;
using registers::Unit;

namespace {

bool is_position(const Register& reg) {
    return reg.unit == Unit::counts || reg.unit == Unit::counts_16;
}

std::string field_text(const Field& field, std::uint32_t bits) {
    const std::uint32_t value = registers::value_in(field, bits);
    if (const auto* name = registers::named(field, value))
        return fmt::format("{}={}", field.name, name->name);
    if (field.width == 1) return value != 0 ? std::string(field.name) : std::string();
    return value != 0 ? fmt::format("{}={}", field.name, value) : std::string();
}

/// The bits for which names_text() has a name.
std::uint32_t named_bits(const Register& reg, Model model, std::int64_t raw) {
    const auto bits = static_cast<std::uint32_t>(raw);
    std::uint32_t known = 0;
    for (const Field& field : registers::fields_of(model, reg.number)) {
        const bool is_named =
            field.width == 1 || registers::named(field, registers::value_in(field, bits)) != nullptr;
        if (is_named) known |= bits & registers::mask_of(field);
    }
    return known;
}

}  // namespace

const Field* whole_field(const Register& reg, Model model) {
    const auto fields = registers::fields_of(model, reg.number);
    if (fields.size() != 1 || fields[0].values.empty()) return nullptr;
    return fields[0].width >= 16 ? &fields[0] : nullptr;
}

std::string number_text(const Register& reg, Model model, std::int64_t raw) {
    if (is_position(reg)) return std::string(registers::to_text(raw, reg, model, shown_unit(reg)).view());
    return std::string(registers::to_text(raw, reg, model).view());
}

std::string names_text(const Register& reg, Model model, std::int64_t raw) {
    const auto bits = static_cast<std::uint32_t>(raw);
    if (const Field* field = whole_field(reg, model)) {
        const auto* name = registers::named(*field, bits);
        return name != nullptr ? std::string(name->name) : std::string();
    }
    std::string text;
    for (const Field& field : registers::fields_of(model, reg.number)) {
        const std::string one = field_text(field, bits);
        if (!one.empty()) text += (text.empty() ? "" : " ") + one;
    }
    return text;
}

std::string_view shown_unit(const Register& reg) {
    if (is_position(reg)) return "counts";
    const auto units = registers::units_of(reg.unit);
    return units.empty() ? std::string_view() : units.front();
}

std::string long_value_text(const Register& reg, Model model, std::int64_t raw) {
    std::string text = value_text(reg, model, raw);
    if (!is_position(reg) || raw == 0) return text;
    return fmt::format("{} ({})", text, registers::to_text(raw, reg, model, "rev").view());
}

std::string bits_word(const Register& reg, Model model, std::int64_t raw) {
    if (raw == 0) return "none";
    std::string word = names_text(reg, model, raw);
    std::replace(word.begin(), word.end(), ' ', '+');
    if (!word.empty() && named_bits(reg, model, raw) == registers::bits_of(reg.format, raw)) return word;
    return fmt::format("0x{:X}", registers::bits_of(reg.format, raw));
}

std::string value_text(const Register& reg, Model model, std::int64_t raw) {
    const std::string names = names_text(reg, model, raw);
    if (names.empty() && raw == 0 && reg.unit == Unit::bits) return "none";
    return names.empty() ? number_text(reg, model, raw) : names;
}

}  // namespace nplc::causes
