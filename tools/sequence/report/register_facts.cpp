#include "report/register_facts.h"

#include <fmt/format.h>

#include "registers/details.h"

namespace nplc::seqc {
namespace {

using registers::Access;
using registers::Model;
using registers::Register;

std::string preferred_unit(const Register& reg, const std::optional<LengthUnit>& length) {
    const auto units = fitting_units(reg, length);
    if (units.empty()) return "";
    if (!length && units.front() == "counts") return "rev";
    return length && reg.unit != registers::Unit::torque && reg.unit != registers::Unit::samples
               ? units.back()
               : units.front();
}

std::string number(double value) {
    return fmt::format("{:.6g}", value);
}

const char* access_text(Access access) {
    switch (access) {
        case Access::read_write:
            return "read and written";
        case Access::motor_writes:
            return "read and written, and the motor writes it too";
        case Access::read_only:
            return "the motor overwrites it";
    }
    return "";
}

std::string fields_text(const Register& reg, Model model) {
    std::string text;
    for (const registers::Field& field : registers::fields_of(model, reg.number)) {
        text += fmt::format("- {} `{}`: {}\n",
                            field.width == 1
                                ? fmt::format("bit {}", field.first)
                                : fmt::format("bits {}..{}", field.first, field.first + field.width - 1),
                            field.name, field.meaning);
        for (const registers::NamedValue& value : field.values)
            text += fmt::format("  - {} `{}` {}\n", value.value, value.name, value.meaning);
    }
    return text;
}

}  // namespace

std::string register_line(const Register& reg, Model model, const std::optional<LengthUnit>& length) {
    const std::string unit = preferred_unit(reg, length);
    const auto per_unit = raw_per_unit(reg, model, length, unit);
    if (unit.empty() || !per_unit) return fmt::format("{} .. {}", reg.min, reg.max);
    if (reg.max >= INT32_MAX) return fmt::format("1 {} = {}", unit, number(*per_unit));
    return fmt::format("1 {0} = {1}; {2} .. {3} {0}", unit, number(*per_unit),
                       number(static_cast<double>(reg.min) / *per_unit),
                       number(static_cast<double>(reg.max) / *per_unit));
}

std::string register_facts(const Register& reg, Model model, const std::optional<LengthUnit>& length) {
    std::string text = fmt::format("- {}\n", register_line(reg, model, length));
    text += fmt::format("- raw {} .. {}; {}\n", reg.min, reg.max, access_text(reg.access));
    const auto units = fitting_units(reg, length);
    if (!units.empty()) text += fmt::format("- units: {}\n", fmt::join(units, ", "));
    if (reg.dangerous) text += "- a wrong value can damage the motor\n";
    if (!reg.section.empty()) text += fmt::format("- manual: {}\n", reg.section);
    if (const std::string fields = fields_text(reg, model); !fields.empty()) text += "\n" + fields;
    const registers::Details* details = registers::details_of(model, reg.number);
    if (details != nullptr && !details->note.empty()) text += fmt::format("\n{}\n", details->note);
    return text;
}

}  // namespace nplc::seqc
