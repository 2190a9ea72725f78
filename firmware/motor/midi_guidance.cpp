#include "motor/midi_guidance.h"

namespace nplc::motor {
namespace {

namespace midi = registers::midi;

constexpr auto kNothing = MidiNext::nothing;

}  // namespace

MidiNext MidiGuidance::next_parameter() const {
    if (registers_.is_set(registers::T_SOLL)) {
        const auto torque = midi::torque_of_t_soll(registers_.word(registers::T_SOLL), drive_.most_torque());
        if (torque && *torque != drive_.torque()) return midi_command(midi::TORQUE, *torque);
    }
    if (registers_.is_set(registers::INPOSWIN)) {
        const auto tolerance =
            midi::tolerance_of_window(drive_.model(), registers_.word(registers::INPOSWIN));
        if (tolerance && *tolerance != drive_.tolerance()) return midi_command(midi::TOLERANCE, *tolerance);
    }
    return kNothing;
}

MidiNext MidiGuidance::next_motion() {
    return registers_.mode() == 1 ? next_for_run() : next_for_move();
}

MidiNext MidiGuidance::stop_first() const {
    return motion_.moves() ? midi_command(midi::STOP) : kNothing;
}

MidiNext MidiGuidance::refuse(Limitation why) {
    limitation_ = why;
    return kNothing;
}

bool MidiGuidance::fit_ramp(std::uint16_t period, std::uint8_t& ramp) {
    ramp = drive_.ramp();
    if (!registers_.is_set(registers::A_SOLL)) return true;
    const auto needed = midi::ramp_of_a_soll(drive_.model(), registers_.word(registers::A_SOLL), period);
    if (needed) {
        ramp = *needed;
        return true;
    }
    limitation_ = Limitation::too_soft;
    return false;
}

/// 000 §VI 15h: during a run the speed may be changed, but not the direction or the ramp.
MidiNext MidiGuidance::next_for_run() {
    const std::int32_t speed = registers_.v_soll();
    if (speed == 0) return stop_first();
    const auto period = midi::period_of_v_soll(drive_.model(), static_cast<std::int16_t>(speed));
    if (!period) return refuse(Limitation::too_slow);
    const bool left = speed < 0;
    const std::uint32_t run =
        std::uint32_t{left ? std::uint8_t{midi::kTurnsLeft} : std::uint8_t{0}} << 16 | *period;
    if (motion_.state() == MidiMotion::State::running && left == motion_.turns_left())
        return *period == motion_.period() ? kNothing : midi_command(midi::RUN, run);
    if (motion_.moves()) return midi_command(midi::STOP);
    std::uint8_t ramp = 0;
    if (!motion_.at_rest() || !fit_ramp(*period, ramp)) return kNothing;
    if (ramp != drive_.ramp()) return midi_command(midi::RAMP, ramp);
    return midi_command(midi::RUN, run);
}

/// V_SOLL 0 blocks a move, as on a JVL motor; if unset, the module's own speed applies.
MidiNext MidiGuidance::next_for_move() {
    const bool has_speed = registers_.is_set(registers::V_SOLL);
    const bool is_held_back = has_speed && registers_.v_soll() == 0;
    if (motion_.state() == MidiMotion::State::running || is_held_back) return stop_first();
    const auto goal = target();
    if (!goal) return refuse(Limitation::too_far);
    if (motion_.holds(*goal) || !motion_.at_rest()) return kNothing;
    std::uint16_t period = drive_.period();
    if (has_speed) {
        const auto wanted =
            midi::period_of_v_soll(drive_.model(), static_cast<std::int16_t>(registers_.v_soll()));
        if (!wanted) return refuse(Limitation::too_slow);
        period = *wanted;
    }
    if (period == 0) return refuse(Limitation::no_speed);
    std::uint8_t ramp = 0;
    if (!fit_ramp(period, ramp)) return kNothing;
    if (period != drive_.period()) return midi_command(midi::SPEED, period);
    if (ramp != drive_.ramp()) return midi_command(midi::RAMP, ramp);
    return midi_command(midi::GO_TO, static_cast<std::uint32_t>(*goal));
}

std::optional<std::int32_t> MidiGuidance::target() const {
    return midi::increments_of_counts(drive_.model(), registers_.position(registers::P_SOLL));
}

}  // namespace nplc::motor
