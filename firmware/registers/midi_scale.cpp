#include "registers/midi_scale.h"

#include <algorithm>

namespace nplc::registers::midi {
namespace {

constexpr std::uint32_t kMinutePerRev = kTicksPerSecond * 60;
constexpr auto kTwiceRamp = std::uint64_t{2} * kRampIncrements;

/// measure = (value + offset) x numerator / denominator, a value in thousandths.
struct Line {
    std::int32_t offset;
    std::int32_t numerator;
    std::int32_t denominator;
};

constexpr Line temperature_line(Model model) {
    return model == Model::mac23 ? Line{215'000, 1, 2'500} : Line{140'000, 1, 2'450};
}

constexpr Line supply_line(Model model) {
    if (model == Model::mac23) return {0, 48, 10'000};
    return {0, 1, model == Model::mac34_1 ? 400 : 800};
}

constexpr std::int32_t rounded(std::int32_t dividend, std::int32_t divisor) {
    return (dividend + divisor / 2) / divisor;
}

std::int32_t value_of(const Line& line, std::uint8_t measure) {
    return rounded(measure * line.denominator, line.numerator) - line.offset;
}

std::uint8_t measure_of(const Line& line, std::int32_t value) {
    const std::int32_t highest = value_of(line, 0xFF);
    const std::int32_t bounded = std::clamp(value, -line.offset, highest) + line.offset;
    return static_cast<std::uint8_t>(rounded(bounded * line.numerator, line.denominator));
}

}  // namespace

std::uint32_t rpm_times_period(Model model) {
    return kMinutePerRev / static_cast<std::uint32_t>(facts_of(model).increments_per_rev);
}

std::optional<std::uint8_t> unstall_of_speed(std::uint32_t increments_per_second) {
    constexpr std::uint32_t kFastest = kTicksPerSecond / kTicksPerLongPeriod;
    const std::uint32_t speed = increments_per_second;
    if (speed > kFastest || speed == 0) return std::nullopt;
    const std::uint32_t period = (kFastest + speed - 1) / speed;
    if (period > 0xFF) return std::nullopt;
    return static_cast<std::uint8_t>(period);
}

std::optional<std::uint8_t> ramp_of(std::uint32_t speed, std::uint32_t acceleration) {
    const std::uint64_t square = std::uint64_t{speed} * speed;
    const auto is_enough = [square, acceleration](unsigned ramp) {
        return kTwiceRamp * ramp * acceleration >= square;
    };
    if (acceleration == 0 || !is_enough(0xFF)) return std::nullopt;
    unsigned below = 0;
    unsigned ramp = 0xFF;
    while (ramp - below > 1) {
        const unsigned middle = (ramp + below) / 2;
        (is_enough(middle) ? ramp : below) = middle;
    }
    return static_cast<std::uint8_t>(ramp);
}

std::int32_t temperature_of(Model model, std::uint8_t measure) {
    return value_of(temperature_line(model), measure);
}

std::uint8_t measure_of_temperature(Model model, std::int32_t thousandths) {
    return measure_of(temperature_line(model), thousandths);
}

std::int32_t supply_of(Model model, std::uint8_t measure) {
    return value_of(supply_line(model), measure);
}

std::uint8_t measure_of_supply(Model model, std::int32_t millivolts) {
    return measure_of(supply_line(model), millivolts);
}

}  // namespace nplc::registers::midi
