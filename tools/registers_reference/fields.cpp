#include <fmt/format.h>

#include "parts.h"

namespace nplc::registers_reference {
namespace {

using registers::Field;
using registers::Model;
using registers::Register;

bool is_whole(const Register& reg, const Field& field) {
    return field.width == (registers::is_32_bit(reg.format) ? 32 : 16);
}

std::string bits(const Register& reg, const Field& field) {
    if (is_whole(reg, field)) return "all";
    if (field.width == 1) return fmt::format("{}", field.first);
    return fmt::format("{}..{}", field.first + field.width - 1, field.first);
}

std::string values(const Field& field) {
    std::string text = fmt::format("\n| {} | name | meaning |\n| --- | --- | --- |\n", field.name);
    for (const auto& value : field.values) {
        text += fmt::format("| {} | {} | {} |\n", value.value, value.name, cell(value.meaning));
    }
    return text;
}

/// The register that shows the same values before this one, if any.
const Register* shown_before(Model model, const Register& reg, const Field& field) {
    for (const Register& earlier : registers::map_of(model)) {
        if (earlier.number >= reg.number) return nullptr;
        for (const Field& other : registers::fields_of(model, earlier.number)) {
            if (other.values.data() == field.values.data()) return &earlier;
        }
    }
    return nullptr;
}

std::string register_section(Model model, const Register& reg) {
    const auto fields = registers::fields_of(model, reg.number);
    std::string text =
        fmt::format("\n### {} {}\n\n| bits | name | meaning |\n| --- | --- | --- |\n", reg.number, reg.name);
    for (const Field& field : fields) {
        text += fmt::format("| {} | {} | {} |\n", bits(reg, field), field.name, cell(field.meaning));
    }
    const std::span<const registers::NamedValue>* last = nullptr;
    for (const Field& field : fields) {
        if (field.values.empty()) continue;
        if (last != nullptr && last->data() == field.values.data()) {
            text += fmt::format("\nThe same for {}.\n", field.name);
        } else if (const Register* earlier = shown_before(model, reg, field)) {
            text += fmt::format("\nValues as of [{} {}](#{}).\n", earlier->number, earlier->name,
                                anchor(*earlier));
        } else {
            text += values(field);
        }
        last = &field.values;
    }
    return text;
}

}  // namespace

std::string bits_and_values(Model model) {
    std::string text;
    for (const Register& reg : registers::map_of(model)) {
        if (!registers::fields_of(model, reg.number).empty()) text += register_section(model, reg);
    }
    return text;
}

}  // namespace nplc::registers_reference
