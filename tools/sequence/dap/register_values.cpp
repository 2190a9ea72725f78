#include "register_values.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "debuggee.h"
#include "registers/scale.h"
#include "text/text.h"

namespace nplc::dap {
namespace {

/// Raw steps per unit; the unit of the program's SCALE is a fraction of a revolution.
std::optional<double> steps_in(const seqc::Symbols& symbols, const registers::Register& reg,
                               std::string unit) {
    double per_revolution = 1;
    if (symbols.scale && spelling::lower(unit).starts_with(spelling::lower(symbols.scale->unit))) {
        unit.replace(0, symbols.scale->unit.size(), "rev");
        per_revolution = symbols.scale->length / symbols.scale->revolutions;
    }
    const auto ratio = registers::raw_per_unit(reg, symbols.motor, unit);
    if (!ratio) return std::nullopt;
    return static_cast<double>(ratio->numerator) / static_cast<double>(ratio->denominator) / per_revolution;
}

std::string unit_of(const seqc::Symbols& symbols, const registers::Register& reg) {
    const auto units = registers::units_of(reg.unit);
    if (units.empty()) return "";
    if (symbols.scale) {
        for (const char* suffix : {"", "/s", "/s2"}) {
            std::string unit = symbols.scale->unit + suffix;
            if (steps_in(symbols, reg, unit)) return unit;
        }
    }
    return std::string(units.front());
}

}  // namespace

const registers::Register& register_of(const seqc::Symbols& symbols, const std::string& name) {
    std::string reg = name;
    for (const seqc::MotorName& named : symbols.motor_names) {
        if (spelling::is_same(named.name, name)) reg = named.reg;
    }
    const registers::Register* found = registers::find(symbols.motor, reg);
    if (found == nullptr) throw Problem(fmt::format("there is no register '{}'", name));
    return *found;
}

std::string value_text(const seqc::Symbols& symbols, const std::string& name, std::int64_t raw) {
    const registers::Register& reg = register_of(symbols, name);
    const std::string unit = unit_of(symbols, reg);
    const auto steps = unit.empty() ? std::nullopt : steps_in(symbols, reg, unit);
    return steps ? fmt::format("{:.6g} {} ({})", static_cast<double>(raw) / *steps, unit, raw)
                 : fmt::format("{}", raw);
}

std::int64_t raw_value(const seqc::Symbols& symbols, const registers::Register& reg,
                       const std::string& text) {
    const std::string_view trimmed = spelling::trimmed(std::string_view(text).substr(0, text.find('(')));
    double number = 0;
    const auto [end, error] = std::from_chars(trimmed.data(), trimmed.data() + trimmed.size(), number);
    if (error != std::errc()) throw Problem(fmt::format("'{}' is no number, such as 60 or 60 mm", text));
    const std::string unit(
        spelling::trimmed({end, static_cast<std::size_t>(trimmed.data() + trimmed.size() - end)}));
    const auto steps = unit.empty() ? std::optional(1.0) : steps_in(symbols, reg, unit);
    if (!steps) throw Problem(fmt::format("{} cannot be given in '{}'", reg.name, unit));
    const double raw = std::round(number * *steps);
    if (!(raw >= static_cast<double>(reg.min) && raw <= static_cast<double>(reg.max)))
        throw Problem(fmt::format("{} takes {} .. {}", reg.name, reg.min, reg.max));
    return static_cast<std::int64_t>(raw);
}

}  // namespace nplc::dap
