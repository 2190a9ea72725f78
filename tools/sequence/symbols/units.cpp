#include "symbols/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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

struct BaseUnit {
    std::string_view name;
    char dimension;  ///< length, angle, turn, time
    double factor;
};

constexpr auto kBaseUnits = std::to_array<BaseUnit>({
    {"mm", 'l', 1},
    {"cm", 'l', 10},
    {"m", 'l', 1000},
    {"um", 'l', 0.001},
    {"inch", 'l', 25.4},
    {"in", 'l', 25.4},
    {"deg", 'a', 1},
    {"rad", 'a', 180 / 3.14159265358979323846},
    {"rev", 't', 1},
    {"U", 't', 1},
});

/// A unit as a multiple of one of its dimension: "l", "l/s" or "l/s2".
struct InBase {
    std::string dimension;
    double factor = 1;
};

std::optional<InBase> in_base(std::string_view unit) {
    if (same_name(unit, "rpm")) return InBase{"t/s", 1.0 / 60};
    if (same_name(unit, "rpm/s")) return InBase{"t/s2", 1.0 / 60};
    const std::size_t bar = unit.find('/');
    const std::string_view length = unit.substr(0, bar);
    const auto* const base = std::find_if(kBaseUnits.begin(), kBaseUnits.end(), [&](const BaseUnit& known) {
        return same_name(known.name, length);
    });
    if (base == kBaseUnits.end()) return std::nullopt;
    const std::string dimension(1, base->dimension);
    if (bar == unit.npos) return InBase{dimension, base->factor};
    const std::string_view time = unit.substr(bar + 1);
    if (same_name(time, "s")) return InBase{dimension + "/s", base->factor};
    if (same_name(time, "min")) return InBase{dimension + "/s", base->factor / 60};
    if (same_name(time, "s2") || same_name(time, "s/s")) return InBase{dimension + "/s2", base->factor};
    return std::nullopt;
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

std::optional<Converted> converted(double number, std::string_view unit,
                                   const std::vector<std::string>& fitting) {
    const auto written = in_base(without_blanks(unit));
    if (!written) return std::nullopt;
    for (const std::string& own : fitting) {
        const auto base = in_base(own);
        if (!base || base->dimension != written->dimension || same_name(own, unit)) continue;
        return Converted{number * written->factor / base->factor, own};
    }
    return std::nullopt;
}

}  // namespace nplc::seqc
