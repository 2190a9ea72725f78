#include "motor/midi_motor.h"

namespace nplc::motor {
namespace {

namespace midi = registers::midi;
using registers::A_SOLL;
using registers::INPOSWIN;
using registers::MODE_REG;
using registers::P_SOLL;
using registers::T_SOLL;
using registers::V_SOLL;

constexpr std::uint8_t kCommandMode = 3;
constexpr std::uint8_t kNop = 0x60;

constexpr MidiMessage command(midi::Command number, std::uint32_t data = 0) {
    return {.number = number, .data = data};
}

}  // namespace

MidiMotor::Lack MidiMotor::lack_of(const Order& order) const {
    return order.is_register_write ? midi::lack_of_write(model_, order.reg, order.longword, order.value)
                                   : midi::lack_of_command(order.command);
}

/// The first reason counts. The drive is led to a stop.
void MidiMotor::raise(MidiFault fault, Lack lack) {
    if (fault_ == MidiFault::none) {
        fault_ = fault;
        lack_ = lack;
    }
    registers_.set_word(MODE_REG, 0);
    base_ = refusals_ = 0;
    zero_wanted_ = zero_unclear_ = false;
}

/// 001 §4.4: with an error a mode byte selects its register and the mode stays.
bool MidiMotor::may_move() const {
    return !error();
}

void MidiMotor::execute(const Order& order) {
    const Lack lack = lack_of(order);
    if (lack != Lack::none) return raise(MidiFault::bad_value, lack);
    if (order.is_register_write) {
        write(order);
    } else if ((order.command >> 5 & 3) == kCommandMode) {
        execute_number(order.command & 0x1F);
    } else {
        registers_.select(order.command & 0x1FU, relative_);
        write_word(MODE_REG, order.command >> 5 & 3);
    }
    if (order.is_register_write || order.command != kNop) recheck();
}

/// To the place where it is: IN_POS is worked out anew.
void MidiMotor::recheck() {
    if (mode() != 2 || motion_ != Motion::at_rest || !goal_holds_ || target() != goal_) return;
    motion_ = Motion::going;
    arrived_ = measured_ = false;
}

void MidiMotor::execute_number(std::uint8_t number) {
    switch (number) {
        case 0x01:
            return reset_error();
        case 0x02:
            return registers_.set_position(P_SOLL, 0);
        case 0x03:
            zero_wanted_ = true;
            return;
        case 0x05:
            return registers_.set_word(V_SOLL, 0);
        case 0x06:
            return registers_.set_word(T_SOLL, 0);
        case 0x0C:
        case 0x0D:
        case 0x0E:
        case 0x0F:
            return registers_.select_set(number - 0x0BU, relative_);
        case 0x11:
        case 0x12:
            base_ = static_cast<std::uint8_t>(number - 0x0A);
            return;
        case 0x14:
        case 0x15:
            relative_ = number == 0x15;
            return;
        default:
            return;  // NOP, 07h, and what concerns JVL's line
    }
}

void MidiMotor::write(const Order& order) {
    if (order.reg == registers::P_IST) {
        zero_wanted_ = true;
        return;
    }
    write_word(order.reg, static_cast<std::uint16_t>(order.value));
    if (order.longword) write_word(order.reg + 1U, static_cast<std::uint16_t>(order.value >> 16));
}

void MidiMotor::write_word(unsigned number, std::uint16_t value) {
    if (number == MODE_REG && value != 0 && !may_move()) return;
    if (number >= registers::P_REG_P && number <= registers::Z_REG_P)
        return registers_.select_by_pointer(number, value, relative_);
    registers_.set_word(number, value);
}

/// 003 §VII 01h: a trip is acknowledged by 00h only.
void MidiMotor::reset_error() {
    link_error_ = false;
    fault_ = MidiFault::none;
    lack_ = Lack::none;
    if ((status_ & midi::kTrips) == 0) return;
    reset_wanted_ = true;
    fault_ = MidiFault::tripped;
}

std::int32_t MidiMotor::v_soll() const {
    return static_cast<std::int16_t>(registers_.word(V_SOLL));
}

std::optional<std::int32_t> MidiMotor::target() const {
    return midi::increments_of_counts(model_, registers_.position(P_SOLL));
}

/// What can be sent at once to lead the drive to what the registers say; nothing while that has to wait for
/// standstill.
MidiMotor::Message MidiMotor::next_command(base::Instant now) {
    if (motion_ == Motion::stopping && now >= ramp_end_) stop_wanted_ = stop_hard_ = true;
    if (stop_wanted_) return command(stop_hard_ ? midi::EMERGENCY_STOP : midi::STOP);
    if (reset_wanted_) return command(midi::RESET);
    if (zero_unclear_ || doubtful_) return {};
    if (zero_wanted_) return command(midi::ZERO_POSITION);
    if (registers_.is_set(T_SOLL)) {
        const auto torque = midi::torque_of_t_soll(registers_.word(T_SOLL), imax_);
        if (torque && *torque != torque_) return command(midi::TORQUE, *torque);
    }
    if (registers_.is_set(INPOSWIN)) {
        const auto tolerance = midi::tolerance_of_window(model_, registers_.word(INPOSWIN));
        if (tolerance && *tolerance != tolerance_) return command(midi::TOLERANCE, *tolerance);
    }
    if (mode() == 0) return moves() || is_stray() ? stop_first() : Message{};
    if (refusals_ != 0 && now < retry_at_) return {};
    if (motion_ == Motion::unknown && seen_moving_) return stop_first();
    if (now < alone_at_) return {};
    return mode() == 1 ? next_for_run() : next_for_move();
}

MidiMotor::Message MidiMotor::stop_first() {
    return command(midi::STOP);
}

bool MidiMotor::ramp_fits(std::uint16_t period, std::uint8_t& ramp) {
    ramp = ramp_;
    if (!registers_.is_set(A_SOLL)) return true;
    const auto needed = midi::ramp_of_a_soll(model_, registers_.word(A_SOLL), period);
    if (needed) {
        ramp = *needed;
        return true;
    }
    raise(MidiFault::bad_value, Lack::too_soft);
    return false;
}

/// 000 §VI 15h: the speed may be changed in mid-run, the direction may not, nor the ramp.
MidiMotor::Message MidiMotor::next_for_run() {
    const std::int32_t speed = v_soll();
    if (speed == 0) return moves() ? stop_first() : Message{};
    const auto period = midi::period_of_v_soll(model_, static_cast<std::int16_t>(speed));
    if (!period) {
        raise(MidiFault::bad_value, Lack::too_slow);
        return {};
    }
    const bool left = speed < 0;
    const std::uint32_t run =
        std::uint32_t{left ? std::uint8_t{midi::kTurnsLeft} : std::uint8_t{0}} << 16 | *period;
    if (motion_ == Motion::running && left == left_)
        return *period == run_period_ ? Message{} : command(midi::RUN, run);
    if (moves()) return stop_first();
    std::uint8_t ramp = 0;
    if (motion_ != Motion::at_rest || !ramp_fits(*period, ramp)) return {};
    if (ramp != ramp_) return command(midi::RAMP, ramp);
    return command(midi::RUN, run);
}

/// V_SOLL 0 holds a move back, as JVL's does; unset, the module's own speed holds.
MidiMotor::Message MidiMotor::next_for_move() {
    const bool has_speed = registers_.is_set(V_SOLL);
    if (motion_ == Motion::running || (has_speed && v_soll() == 0)) return moves() ? stop_first() : Message{};
    const auto goal = target();
    if (!goal) {
        raise(MidiFault::bad_value, Lack::too_far);
        return {};
    }
    if ((goal_holds_ && *goal == goal_) || motion_ != Motion::at_rest) return {};
    std::uint16_t period = period_;
    if (has_speed) {
        const auto wanted = midi::period_of_v_soll(model_, static_cast<std::int16_t>(v_soll()));
        if (!wanted) {
            raise(MidiFault::bad_value, Lack::too_slow);
            return {};
        }
        period = *wanted;
    }
    if (period == 0) {
        raise(MidiFault::bad_value, Lack::no_speed);
        return {};
    }
    std::uint8_t ramp = 0;
    if (!ramp_fits(period, ramp)) return {};
    if (period != period_) return command(midi::SPEED, period);
    if (ramp != ramp_) return command(midi::RAMP, ramp);
    return command(midi::GO_TO, static_cast<std::uint32_t>(*goal));
}

std::string_view text_of(MidiFault fault) {
    switch (fault) {
        case MidiFault::none:
            return "no error";
        case MidiFault::link_lost:
            return "the MIDI drive does not answer: check its supply, the cable, its address and the baud or "
                   "bit rate";
        case MidiFault::restarted:
            return "the MIDI drive started anew by itself: check its supply and its security input";
        case MidiFault::tripped:
            return "the MIDI drive has tripped: see its status word, and send \"reset error\" (01h) once the "
                   "cause is gone";
        case MidiFault::end_stop:
            return "an end-stop ended the MIDI drive's motion: acknowledge with 01h and move the other way";
        case MidiFault::not_arrived:
            return "the MIDI drive stands and is not where it was sent: look for another master, or for "
                   "commands "
                   "that it has ended the motion by";
        case MidiFault::refused:
            return "the MIDI drive refused a command that it should take: check its model and its software "
                   "release";
        case MidiFault::unclear:
            return "it is not known whether the MIDI drive took a command: it was told to stop; check the "
                   "line, and "
                   "the position";
        case MidiFault::jumped:
            return "the MIDI drive's position jumped in mid-motion: look for another master that has set its "
                   "origin (0Bh), and let the sequence find the origin again";
        case MidiFault::bad_value:
            return "an order is not for a MIDI drive";
        case MidiFault::unreadable:
            return "each answer of the MIDI drive came damaged: look for noise on the line, for another baud "
                   "rate, and for a second drive at its address; leave one connected, give it an address of "
                   "its own, then send \"reset error\" (01h)";
        case MidiFault::several:
            return "more than one MIDI drive answers to this address, and what moves one moves both: they "
                   "were "
                   "told to stop; switch off all but one, give that one another address (`macreg midi "
                   "address "
                   "set`), then send \"reset error\" (01h)";
    }
    return {};
}

}  // namespace nplc::motor
