#include "symbols/units.h"

#include <fmt/format.h>

#include "language/names.h"
#include "registers/scale.h"

namespace nplc::seqc {
namespace {

using registers::Model;
using registers::Register;
using registers::Unit;

std::string without_blanks(std::string_view text) {
    std::string result;
    for (char c : text) {
        if (c > ' ') result += c;
    }
    return result;
}

/// `mm/s` begins with `mm`; `m/s` and `mmx` do not.
bool is_length_or_rate(std::string_view unit, std::string_view length) {
    if (!same_name(unit.substr(0, length.size()), length)) return false;
    return unit.size() == length.size() || unit[length.size()] == '/';
}

}  // namespace

std::optional<double> raw_per_unit(const Register& reg, Model model, const std::optional<LengthUnit>& length,
                                   std::string_view written) {
    std::string unit = without_blanks(written);
    double units_per_rev = 1;
    if (length && is_length_or_rate(unit, length->name)) {
        unit.replace(0, length->name.size(), "rev");
        units_per_rev = length->per_revolution;
    }
    const auto exact = registers::raw_per_unit(reg, model, unit);
    if (!exact) return std::nullopt;
    return static_cast<double>(exact->numerator) / static_cast<double>(exact->denominator) / units_per_rev;
}

std::vector<std::string> fitting_units(const Register& reg, const std::optional<LengthUnit>& length) {
    const auto with_length = [&](std::vector<std::string> own, const char* suffix) {
        if (length) own.push_back(fmt::format("{}{}", length->name, suffix));
        return own;
    };
    switch (reg.unit) {
        case Unit::counts:
        case Unit::counts_16:
            return with_length({"counts", "rev"}, "");
        case Unit::velocity:
        case Unit::velocity_16:
        case Unit::velocity_inner:
            return with_length({"rpm", "rev/s"}, "/s");
        case Unit::acceleration_16:
            return with_length({"rpm/s", "rev/s2"}, "/s2");
        case Unit::torque:
            return {"%peak", "%nominal"};
        case Unit::samples:
            return {"samples", "ms", "s"};
        case Unit::analogue_volts:
        case Unit::supply_volts:
        case Unit::logic_volts:
        case Unit::bus_volts:
            return {"V", "mV"};
        case Unit::temperature:
            return {"C"};
        case Unit::electrical_angle:
            return {"eldeg"};
        case Unit::none:
        case Unit::bits:
            break;
    }
    return {};
}

bool is_known_unit(std::string_view unit) {
    const std::string plain = without_blanks(unit);
    for (const char* known : {"counts", "count", "rev", "rpm", "rev/s", "rpm/s", "rev/s2", "rev/s/s", "%peak",
                              "%nominal", "samples", "ms", "s", "V", "mV", "C", "eldeg"}) {
        if (same_name(plain, known)) return true;
    }
    return false;
}

std::string units_for(const Register& reg, const std::optional<LengthUnit>& length) {
    if (reg.unit == Unit::torque) return "%peak (1023 is 100 %peak) or %nominal (1023 is 300 %nominal)";
    std::vector<std::string> units = fitting_units(reg, length);
    if (units.empty()) return "a plain number without unit";
    if (units.size() == 1) return units.front();
    const std::string last = std::move(units.back());
    units.pop_back();
    return fmt::format("{} or {}", fmt::join(units, ", "), last);
}

}  // namespace nplc::seqc
