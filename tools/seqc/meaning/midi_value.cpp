#include "meaning/midi_value.h"

#include <fmt/format.h>

#include "registers/midi_scale.h"

namespace nplc::seqc {
namespace {

namespace midi = registers::midi;
using registers::Unit;

constexpr double kCountsPerRev = 4096;  // of the registers, which are those of MAC50-141
constexpr std::uint8_t kImax = midi::kMostTorque;

double increments_per_count(midi::Model model) {
    return midi::facts_of(model).increments_per_rev / kCountsPerRev;
}

/// V_SOLL x period, exactly: v_soll_of_period() is rounded.
double speed_times_period(midi::Model model) {
    constexpr double kRpmPerStep = 15625.0 / 32768;  // 3125 / 6 samples a second
    return midi::rpm_times_period(model) / kRpmPerStep;
}

DriveValue position(midi::Model model, std::uint32_t bits) {
    const auto increments = midi::increments_of_counts(model, static_cast<std::int32_t>(bits)).value_or(0);
    return {increments / increments_per_count(model), fmt::format("{} increments", increments)};
}

DriveValue velocity(midi::Model model, std::uint32_t bits) {
    const auto v = static_cast<std::int16_t>(bits);
    const std::uint16_t period = midi::period_of_v_soll(model, v).value_or(0);
    if (period == 0) return {0, "a stop"};
    const double raw = speed_times_period(model) / period;
    return {v < 0 ? -raw : raw, fmt::format("period {}", period)};
}

DriveValue torque(std::uint32_t bits) {
    constexpr double kFull = 1023;
    const int share = midi::torque_of_t_soll(static_cast<std::uint16_t>(bits), kImax).value_or(0);
    return {share * kFull / kImax, fmt::format("torque {} of {}", share, kImax)};
}

DriveValue window(midi::Model model, std::uint32_t bits) {
    const int tolerance = midi::tolerance_of_window(model, static_cast<std::uint16_t>(bits)).value_or(0);
    return {static_cast<double>(bits), fmt::format("a tolerance of {} increments", tolerance)};
}

}  // namespace

std::optional<DriveValue> drive_value(midi::Model model, const registers::Register& reg, std::uint32_t bits) {
    switch (reg.unit) {
        case Unit::counts:
            if (registers::is_32_bit(reg.format)) return position(model, bits);
            return window(model, bits);
        case Unit::velocity_16:
            return velocity(model, bits);
        case Unit::torque:
            return torque(bits);
        default:
            return std::nullopt;
    }
}

midi::Lack lack_of(midi::Model model, const Send& send) {
    if (send.reg == nullptr) return midi::lack_of_command(send.command);
    return midi::lack_of_write(model, send.reg->number, registers::is_32_bit(send.reg->format), send.value);
}

}  // namespace nplc::seqc
