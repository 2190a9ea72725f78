#include "meaning/units.h"

#include <fmt/format.h>

#include "registers/scale.h"
#include "syntax/names.h"

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
bool begins_with(std::string_view unit, std::string_view length) {
    if (!same_name(unit.substr(0, length.size()), length)) return false;
    return unit.size() == length.size() || unit[length.size()] == '/';
}

}  // namespace

std::optional<double> raw_per_unit(const Register& reg, Model model, const std::optional<LengthUnit>& length,
                                   std::string_view written) {
    std::string unit = without_blanks(written);
    double units_per_rev = 1;
    if (length && begins_with(unit, length->name)) {
        unit.replace(0, length->name.size(), "rev");
        units_per_rev = length->per_revolution;
    }
    const auto exact = registers::raw_per_unit(reg, model, unit);
    if (!exact) return std::nullopt;
    return static_cast<double>(exact->numerator) / static_cast<double>(exact->denominator) / units_per_rev;
}

std::string units_for(const Register& reg, const std::optional<LengthUnit>& length) {
    const std::string own = length ? fmt::format(" or {}", length->name) : std::string();
    const std::string own_speed = length ? fmt::format(" or {}/s", length->name) : std::string();
    switch (reg.unit) {
        case Unit::counts:
        case Unit::counts_16:
            return "counts or rev" + own;
        case Unit::velocity:
        case Unit::velocity_16:
        case Unit::velocity_inner:
            return "rpm or rev/s" + own_speed;
        case Unit::acceleration_16:
            return "rpm/s or rev/s2" + (length ? fmt::format(" or {}/s2", length->name) : "");
        case Unit::torque:
            return "%peak (1023 is 100 %peak) or %nominal (1023 is 300 %nominal)";
        case Unit::samples:
            return "samples, ms or s";
        case Unit::analogue_volts:
        case Unit::supply_volts:
        case Unit::logic_volts:
        case Unit::bus_volts:
            return "V or mV";
        case Unit::temperature:
            return "C (degrees Celsius)";
        case Unit::electrical_angle:
            return "eldeg (electrical degrees)";
        case Unit::none:
        case Unit::bits:
            break;
    }
    return "a plain number without unit";
}

}  // namespace nplc::seqc
