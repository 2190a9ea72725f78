#include "registers/scale.h"

#include <array>

#include "registers/names.h"

namespace nplc::registers {
namespace {

using std::string_view;
using Factor = std::optional<Ratio>;

constexpr Ratio kSixteenth{16, 1};
constexpr Ratio kPercentOfPeak{1023, 100};    // 001 §3.2.7
constexpr Ratio kPercentOfNominal{341, 100};  // 004, register 7: 1023 is 300 %
constexpr Ratio kAnalogueSmall{1023, 10};     // 001 §3.2.122: 10 V is 1023
constexpr Ratio kAnalogueLarge{1024, 5};      // 004, register 170: a step is 0.0048828 V, 10 V are 2048
constexpr Ratio kSupply{10'000, 537};         // 001 §3.2.151: a step is 53.7 mV
constexpr Ratio kLogic{250'000, 3357};        // 004, register 21: a step is 0.013428 V
constexpr Ratio kBus{500'000, 444'399};       // 004, register 198: a step is 0.888798 V (366 are 325 V)
constexpr Ratio kCelsius{100'000, 12'207};    // 004, register 29: a step is 0.12207 degrees
constexpr Ratio kElectricalDegree{256, 45};   // 001 §3.2.129: 360 of them are 2048

constexpr Ratio kInnerRate{15'625, 2};         // 7812.5 Hz
constexpr ExactScale kSmall{4096, {3125, 6}};  // a fifteenth of it
constexpr ExactScale kLarge{8000, {770, 1}};

Factor scaled(Factor factor, Ratio by) {
    if (factor) *factor = *factor * by;
    return factor;
}

Factor one_of(string_view unit, std::initializer_list<string_view> names, Ratio factor) {
    for (string_view name : names) {
        if (same_name(unit, name)) return factor;
    }
    return std::nullopt;
}

/// `unit` without the suffix `end`; empty if it has another suffix or nothing before it.
string_view before(string_view unit, string_view end) {
    if (unit.size() <= end.size() || !same_name(unit.substr(unit.size() - end.size()), end)) return {};
    return unit.substr(0, unit.size() - end.size());
}

/// Encoder counts per unit of length.
Factor length(string_view unit, const ExactScale& scale) {
    if (const Factor counts = one_of(unit, {"counts", "count"}, {1, 1})) return counts;
    return one_of(unit, {"rev"}, {scale.counts_per_rev, 1});
}

/// Counts a second.
Factor speed(string_view unit, const ExactScale& scale) {
    if (same_name(unit, "rpm")) return Ratio{scale.counts_per_rev, 1} / Ratio{60, 1};
    if (const string_view of_length = before(unit, "/sample"); !of_length.empty())
        return scaled(length(of_length, scale), scale.samples_per_second);
    return length(before(unit, "/s"), scale);
}

/// Counts a second squared.
Factor acceleration(string_view unit, const ExactScale& scale) {
    if (const string_view of_length = before(unit, "/s2"); !of_length.empty())
        return length(of_length, scale);
    return speed(before(unit, "/s"), scale);
}

Factor torque(string_view unit) {
    if (const Factor peak = one_of(unit, {"%peak", "%"}, kPercentOfPeak)) return peak;
    return one_of(unit, {"%nominal"}, kPercentOfNominal);
}

Factor samples(string_view unit, Ratio rate) {
    if (same_name(unit, "samples")) return Ratio{};
    if (same_name(unit, "s")) return rate;
    return one_of(unit, {"ms"}, rate / Ratio{1000, 1});
}

Factor volts(string_view unit, Ratio steps) {
    if (same_name(unit, "V")) return steps;
    return one_of(unit, {"mV"}, steps / Ratio{1000, 1});
}

Factor factor_of(Unit kind, Model model, string_view unit) {
    const ExactScale scale = exact_scale_of(model);
    const Ratio sample = Ratio{1, 1} / scale.samples_per_second;
    switch (kind) {
        case Unit::none:
        case Unit::bits:
            return std::nullopt;
        case Unit::counts:
            return length(unit, scale);
        case Unit::counts_16:
            return scaled(length(unit, scale), kSixteenth);
        case Unit::velocity:
            return scaled(speed(unit, scale), sample);
        case Unit::velocity_16:
            return scaled(speed(unit, scale), kSixteenth * sample);
        case Unit::velocity_inner:
            if (model == Model::mac800) return std::nullopt;  // its current loop's rate is in no manual
            return scaled(speed(unit, scale), Ratio{1, 1} / kInnerRate);
        case Unit::acceleration_16:
            return scaled(acceleration(unit, scale), kSixteenth * sample * sample);
        case Unit::torque:
            return torque(unit);
        case Unit::samples:
            return samples(unit, scale.samples_per_second);
        case Unit::analogue_volts:
            return volts(unit, model == Model::mac800 ? kAnalogueLarge : kAnalogueSmall);
        case Unit::supply_volts:
            return volts(unit, kSupply);
        case Unit::logic_volts:
            return volts(unit, kLogic);
        case Unit::bus_volts:
            return volts(unit, kBus);
        case Unit::temperature:
            return one_of(unit, {"C", "°C"}, kCelsius);
        case Unit::electrical_angle:
            return one_of(unit, {"eldeg"}, kElectricalDegree);
    }
    return std::nullopt;
}

constexpr string_view kLengths[] = {"rev", "counts"};
constexpr string_view kSpeeds[] = {"rpm", "rev/s", "counts/s", "counts/sample"};
constexpr string_view kAccelerations[] = {"rpm/s", "rev/s2", "counts/s2"};
constexpr string_view kTorques[] = {"%peak", "%nominal"};
constexpr string_view kTimes[] = {"ms", "s", "samples"};
constexpr string_view kVolts[] = {"V", "mV"};
constexpr string_view kTemperatures[] = {"°C", "C"};
constexpr string_view kAngles[] = {"eldeg"};

}  // namespace

ExactScale exact_scale_of(Model model) {
    return model == Model::mac800 ? kLarge : kSmall;
}

std::int64_t one_in(Format format) {
    switch (format) {
        case Format::fixed4:
            return 4096;
        case Format::fixed8:
            return 256;
        case Format::fixed16:
            return 65'536;
        case Format::fixed24:
            return 16'777'216;
        case Format::word:
        case Format::integer:
        case Format::long_int:
            break;
    }
    return 1;
}

std::optional<Ratio> raw_per_unit(const Register& reg, Model model, string_view unit) {
    std::array<char, 16> kept{};
    std::size_t size = 0;
    for (const char c : unit) {
        if (is_blank(c)) continue;
        if (size == kept.size()) return std::nullopt;
        kept[size++] = c;
    }
    if (size == 0) return Ratio{one_in(reg.format), 1};
    return factor_of(reg.unit, model, string_view(kept.data(), size));
}

std::span<const string_view> units_of(Unit unit) {
    switch (unit) {
        case Unit::none:
        case Unit::bits:
            return {};
        case Unit::counts:
        case Unit::counts_16:
            return kLengths;
        case Unit::velocity:
        case Unit::velocity_16:
        case Unit::velocity_inner:
            return kSpeeds;
        case Unit::acceleration_16:
            return kAccelerations;
        case Unit::torque:
            return kTorques;
        case Unit::samples:
            return kTimes;
        case Unit::analogue_volts:
        case Unit::supply_volts:
        case Unit::logic_volts:
        case Unit::bus_volts:
            return kVolts;
        case Unit::temperature:
            return kTemperatures;
        case Unit::electrical_angle:
            return kAngles;
    }
    return {};
}

}  // namespace nplc::registers
