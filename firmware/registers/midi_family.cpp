#include "registers/family.h"
#include "registers/midi_motor.h"
#include "registers/midi_scale.h"

/// MIDI Ingenierie's MAC23 and MAC34, which the gateway translates for: firmware/motor/MIDI.md.
namespace nplc::registers {

const DriveFamily& midi_family();

namespace {

constexpr double kCountsPerRev = 4096;                       // of the registers, which are those of MAC50-141
constexpr std::uint32_t kBauds[] = {9'600, 19'200, 38'400};  // 000 §VI 1Bh
constexpr double kFullTorque = 1023;
constexpr std::uint8_t kImax = midi::kMostTorque;

class MidiFamily final : public DriveFamily {
  public:
    std::string_view name() const override { return "MIDI"; }
    std::span<const DriveModel> models() const override;
    std::span<const std::uint32_t> bauds() const override { return kBauds; }
    bool waits_for_standstill() const override { return true; }
    Refusal refuses_command(const DriveModel& model, std::uint8_t command) const override;
    Refusal refuses_write(const DriveModel& model, std::uint8_t reg, bool longword,
                          std::uint32_t value) const override;
    Refusal refuses_profile(const DriveModel& model, std::int16_t v_soll,
                            std::uint16_t a_soll) const override;
    std::optional<DriveValue> value_of(const DriveModel& model, const Register& reg,
                                       std::uint32_t bits) const override;
    std::optional<DriveValue> ramp_of(const DriveModel& model, std::int16_t v_soll,
                                      std::uint16_t a_soll) const override;
};

constinit const MidiFamily kFamily;

constexpr DriveModel model(midi::Model which, std::string_view name, std::string_view program_name,
                           std::string_view alias, bool has_can) {
    const auto index = static_cast<std::uint8_t>(which);
    return {&kFamily, index,  static_cast<std::uint8_t>(index + 1), Model::mac140, name, program_name,
            alias,    has_can};
}

constexpr DriveModel kModels[] = {model(midi::Model::mac23, "MAC23", "MAC23", {}, false),
                                  model(midi::Model::mac34_1, "MAC34-1", "MAC34", "MAC34_1", true),
                                  model(midi::Model::mac34_2, "MAC34-2", "MAC34", "MAC34_2", true)};

midi::Model which(const DriveModel& model) {
    return static_cast<midi::Model>(model.index);
}

Refusal refusal_of(midi::Limitation limitation) {
    return limitation == midi::Limitation::none ? Refusal() : midi::text_of(limitation);
}

DriveValue position(midi::Model model, std::uint32_t bits) {
    const auto increments = midi::increments_of_counts(model, static_cast<std::int32_t>(bits)).value_or(0);
    const double per_count = midi::facts_of(model).increments_per_rev / kCountsPerRev;
    return {increments / per_count, "", increments, " increments"};
}

DriveValue velocity(midi::Model model, std::uint32_t bits) {
    constexpr double kRpmPerStep = 15625.0 / 32768;  // 3125 / 6 samples a second
    const auto v = static_cast<std::int16_t>(bits);
    const std::uint16_t period = midi::period_of_v_soll(model, v).value_or(0);
    if (period == 0) return {0, "a stop"};
    // exactly: v_soll_of_period() is rounded
    const double raw = midi::rpm_times_period(model) / kRpmPerStep / period;
    return {v < 0 ? -raw : raw, "period ", period};
}

DriveValue torque(std::uint32_t bits) {
    const int share = midi::torque_of_t_soll(static_cast<std::uint16_t>(bits), kImax).value_or(0);
    static_assert(kImax == 128);
    return {share * kFullTorque / kImax, "torque ", share, " of 128"};
}

DriveValue window(midi::Model model, std::uint32_t bits) {
    const int tolerance = midi::tolerance_of_window(model, static_cast<std::uint16_t>(bits)).value_or(0);
    return {static_cast<double>(bits), "a tolerance of ", tolerance, " increments"};
}

std::span<const DriveModel> MidiFamily::models() const {
    return kModels;
}

Refusal MidiFamily::refuses_command(const DriveModel&, std::uint8_t command) const {
    return refusal_of(midi::limitation_of_command(command));
}

Refusal MidiFamily::refuses_write(const DriveModel& model, std::uint8_t reg, bool longword,
                                  std::uint32_t value) const {
    return refusal_of(midi::limitation_of_write(which(model), reg, longword, value));
}

Refusal MidiFamily::refuses_profile(const DriveModel& model, std::int16_t v_soll,
                                    std::uint16_t a_soll) const {
    return refusal_of(midi::limitation_of_profile(which(model), v_soll, a_soll));
}

std::optional<DriveValue> MidiFamily::value_of(const DriveModel& model, const Register& reg,
                                               std::uint32_t bits) const {
    switch (reg.unit) {
        case Unit::counts:
            if (is_32_bit(reg.format)) return position(which(model), bits);
            return window(which(model), bits);
        case Unit::velocity_16:
            return velocity(which(model), bits);
        case Unit::torque:
            return torque(bits);
        default:
            return std::nullopt;
    }
}

/// The ramp is rounded up, so the motor accelerates at most as fast as wanted; the ramp is longer by less
/// than 120 increments.
std::optional<DriveValue> MidiFamily::ramp_of(const DriveModel& model, std::int16_t v_soll,
                                              std::uint16_t a_soll) const {
    constexpr double kStep = 9'765'625.0 / 576;  // of A_SOLL, in counts/s^2
    const auto period = midi::period_of_v_soll(which(model), v_soll);
    if (v_soll == 0 || !period) return std::nullopt;
    const int ramp = midi::ramp_of_a_soll(which(model), a_soll, *period).value_or(0);
    const double speed = static_cast<double>(midi::kTicksPerSecond) / *period;  // increments a second
    const double done = speed * speed / (2.0 * midi::kRampIncrements * ramp);   // increments/s^2
    const double per_count = midi::facts_of(which(model)).increments_per_rev / kCountsPerRev;
    static_assert(midi::kRampIncrements == 120);
    return DriveValue{done / per_count / kStep, "a ramp of ", ramp, " x 120 increments"};
}

}  // namespace

const DriveFamily& midi_family() {
    return kFamily;
}

}  // namespace nplc::registers
