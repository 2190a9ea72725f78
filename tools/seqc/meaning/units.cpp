#include "meaning/units.h"

#include <fmt/format.h>

#include "syntax/names.h"

namespace nplc::seqc {
namespace {

using registers::Format;
using registers::Model;
using registers::Register;
using registers::Unit;

constexpr double kSixteenth = 16;
constexpr double kFullTorque = 1023;  // 001 §3.2.7
constexpr double kPeakOfNominal = 3;  // 004, register 7: full torque is 300 % of the nominal one
constexpr double kSecondsPerMinute = 60;

double one_in(Format format) {
    switch (format) {
        case Format::fixed4:
            return 4096;
        case Format::fixed8:
            return 256;
        case Format::fixed16:
            return 65'536;
        case Format::fixed24:
            return 16'777'216;
        default:
            return 1;
    }
}

std::string without_blanks(std::string_view text) {
    std::string result;
    for (char c : text) {
        if (c > ' ') result += c;
    }
    return result;
}

/// Encoder counts in one `unit` of length.
std::optional<double> counts_in(std::string_view unit, double counts_per_rev,
                                const std::optional<LengthUnit>& length) {
    if (same_name(unit, "counts") || same_name(unit, "count")) return 1;
    if (same_name(unit, "rev")) return counts_per_rev;
    if (length && same_name(unit, length->name)) return counts_per_rev / length->per_revolution;
    return std::nullopt;
}

/// Counts a second in one `unit` of speed: rpm, or a length with /s.
std::optional<double> counts_per_second_in(std::string_view unit, double counts_per_rev,
                                           const std::optional<LengthUnit>& length) {
    if (same_name(unit, "rpm")) return counts_per_rev / kSecondsPerMinute;
    if (unit.size() > 2 && same_name(unit.substr(unit.size() - 2), "/s")) {
        return counts_in(unit.substr(0, unit.size() - 2), counts_per_rev, length);
    }
    return std::nullopt;
}

/// Counts a second squared: a speed with /s, or a length with /s2.
std::optional<double> counts_per_second2_in(std::string_view unit, double counts_per_rev,
                                            const std::optional<LengthUnit>& length) {
    if (unit.size() > 3 && same_name(unit.substr(unit.size() - 3), "/s2")) {
        return counts_in(unit.substr(0, unit.size() - 3), counts_per_rev, length);
    }
    if (unit.size() > 2 && same_name(unit.substr(unit.size() - 2), "/s")) {
        return counts_per_second_in(unit.substr(0, unit.size() - 2), counts_per_rev, length);
    }
    return std::nullopt;
}

std::optional<double> scaled(std::optional<double> value, double factor) {
    if (value) *value *= factor;
    return value;
}

std::optional<double> torque_in(std::string_view unit) {
    if (same_name(unit, "%peak")) return kFullTorque / 100;
    if (same_name(unit, "%nominal")) return kFullTorque / kPeakOfNominal / 100;
    return std::nullopt;
}

std::optional<double> samples_in(std::string_view unit, double rate) {
    if (same_name(unit, "samples")) return 1;
    if (same_name(unit, "s")) return rate;
    if (same_name(unit, "ms")) return rate / 1000;
    return std::nullopt;
}

}  // namespace

std::optional<double> raw_per_unit(const Register& reg, Model model, const std::optional<LengthUnit>& length,
                                   std::string_view written) {
    const std::string unit = without_blanks(written);
    if (unit.empty()) return one_in(reg.format);
    const auto [counts_per_rev_int, rate] = registers::scale_of(model);
    const double counts_per_rev = counts_per_rev_int;
    const auto speed = counts_per_second_in(unit, counts_per_rev, length);
    switch (reg.unit) {
        case Unit::none:
            return std::nullopt;
        case Unit::counts:
            return counts_in(unit, counts_per_rev, length);
        case Unit::counts_16:
            return scaled(counts_in(unit, counts_per_rev, length), kSixteenth);
        case Unit::velocity:
            return scaled(speed, 1 / rate);
        case Unit::velocity_16:
            return scaled(speed, kSixteenth / rate);
        case Unit::acceleration_16:
            return scaled(counts_per_second2_in(unit, counts_per_rev, length), kSixteenth / rate / rate);
        case Unit::torque:
            return torque_in(unit);
        case Unit::samples:
            return samples_in(unit, rate);
    }
    return std::nullopt;
}

std::vector<std::string> fitting_units(const Register& reg, const std::optional<LengthUnit>& length) {
    std::vector<std::string> units;
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
            return with_length({"rpm", "rev/s"}, "/s");
        case Unit::acceleration_16:
            return with_length({"rpm/s", "rev/s2"}, "/s2");
        case Unit::torque:
            return {"%peak", "%nominal"};
        case Unit::samples:
            return {"samples", "ms", "s"};
        case Unit::none:
            break;
    }
    return {};
}

bool is_known_unit(std::string_view unit) {
    const std::string plain = without_blanks(unit);
    for (const char* known : {"counts", "count", "rev", "rpm", "rev/s", "rpm/s", "rev/s2", "rev/s/s", "%peak",
                              "%nominal", "samples", "ms", "s"}) {
        if (same_name(plain, known)) return true;
    }
    return false;
}

std::string units_for(const Register& reg, const std::optional<LengthUnit>& length) {
    if (reg.unit == Unit::none) return "a plain number without unit";
    if (reg.unit == Unit::torque) return "%peak (1023 is 100 %peak) or %nominal (1023 is 300 %nominal)";
    std::vector<std::string> units = fitting_units(reg, length);
    const std::string last = std::move(units.back());
    units.pop_back();
    return fmt::format("{} or {}", fmt::join(units, ", "), last);
}

}  // namespace nplc::seqc
