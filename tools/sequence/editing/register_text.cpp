#include "editing/register_text.h"

#include <fmt/format.h>

#include "language/names.h"
#include "registers/details.h"
#include "report/table_text.h"
#include "symbols/units.h"

namespace nplc::seqc::analysis {
namespace {

using registers::Access;
using registers::Register;

std::string preferred_unit(const Program& program, const Register& reg) {
    const auto units = fitting_units(reg, program.length_unit());
    if (units.empty()) return "";
    return program.length_unit() && reg.unit != registers::Unit::torque &&
                   reg.unit != registers::Unit::samples
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

std::string fields_text(const Program& program, const Register& reg) {
    std::string text;
    for (const registers::Field& field : registers::fields_of(program.symbols().motor, reg.number)) {
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

std::string register_line(const Program& program, const Register& reg) {
    const std::string unit = preferred_unit(program, reg);
    const auto per_unit = raw_per_unit(reg, program.symbols().motor, program.length_unit(), unit);
    if (unit.empty() || !per_unit) return fmt::format("{} .. {}", reg.min, reg.max);
    return fmt::format("1 {0} = {1}; {2} .. {3} {0}", unit, number(*per_unit),
                       number(static_cast<double>(reg.min) / *per_unit),
                       number(static_cast<double>(reg.max) / *per_unit));
}

std::string register_text(const Program& program, const Register& reg) {
    const registers::Details* details = registers::details_of(program.symbols().motor, reg.number);
    std::string text = fmt::format("**{}**, register {}{}{}\n\n", reg.name, reg.number,
                                   details != nullptr ? ": " : "", details != nullptr ? details->title : "");
    text += fmt::format("- {}\n", register_line(program, reg));
    text += fmt::format("- raw {} .. {}; {}\n", reg.min, reg.max, access_text(reg.access));
    const auto units = fitting_units(reg, program.length_unit());
    if (!units.empty()) text += fmt::format("- units: {}\n", fmt::join(units, ", "));
    if (reg.dangerous) text += "- a wrong value can damage the motor\n";
    if (!reg.section.empty()) text += fmt::format("- manual: {}\n", reg.section);
    if (const std::string fields = fields_text(program, reg); !fields.empty()) text += "\n" + fields;
    if (details != nullptr && !details->note.empty()) text += fmt::format("\n{}\n", details->note);
    return text;
}

std::string constant_text(const Program& program, const Constant& constant) {
    const auto shown = with_unit(constant.raw, constant.reg->number, &program.symbols());
    return shown ? fmt::format("{} ({})", constant.raw, *shown) : std::to_string(constant.raw);
}

}  // namespace nplc::seqc::analysis
