#include <algorithm>
#include <cstdlib>

#include "motor/midi_motor.h"

namespace nplc::motor {
namespace {

namespace midi = registers::midi;

/// Between two queries while something moves, and while nothing does.
constexpr base::Microseconds kPace{5'000};
constexpr base::Microseconds kRestPace{20'000};
constexpr base::Microseconds kSurely{20'000};
constexpr base::Microseconds kSwing{1'000'000};
/// Its longest answer, and time for the proof.
constexpr base::Microseconds kOthersShow{200'000};
constexpr base::Microseconds kLongestStep{500'000};
constexpr std::int32_t kStandby = 5;     ///< increments by which a shaft at rest may swing (003 §VII 02h)
constexpr std::int32_t kSample = 1'920;  ///< us, of a MAC50-141
constexpr std::int32_t kMostCounts = INT32_MAX / kSample;
constexpr std::uint32_t kStops =
    midi::kAtUpperInput | midi::kAtLowerInput | midi::kAtUpperStop | midi::kAtLowerStop;

/// ERR_STAT (001 §3.2.35).
enum ErrorBit : std::uint32_t {
    kI2t = 1U << 0,
    kFollow = 1U << 1,
    kUit = 1U << 3,
    kInPos = 1U << 4,
    kPositionLimit = 1U << 7,
    kRelative = 1U << 9,
};

constexpr std::uint32_t bit(bool set, std::uint32_t mask) {
    return set ? mask : 0;
}

}  // namespace

void MidiMotor::on_value(std::uint32_t value, base::Instant now) {
    resync_ = false;
    keep(value, now);
    if (phase_ == Phase::up) {
        next_query_ = now + (motion_ == Motion::at_rest ? kRestPace : kPace);
        return;
    }
    phase_ = phase_ == Phase::down ? Phase::imax : static_cast<Phase>(static_cast<int>(phase_) + 1);
    if (phase_ != Phase::up) return;
    was_up_ = true;
    resetting_ = arrived_ = measured_ = steady_begun_ = seen_moving_ = false;
    motion_ = Motion::unknown;  // perhaps the run from before: its period stays
    next_query_ = now;
    alone_at_ = now + kOthersShow;
}

void MidiMotor::keep(std::uint32_t value, base::Instant now) {
    switch (message_.number) {
        case midi::GET_STATUS:
            status_ = value;
            return on_status();
        case midi::GET_MEASURES:
            not_busy_ = (value & midi::kNotBusy) != 0;
            referenced_ =
                static_cast<std::uint8_t>(unsigned{referenced_} << 1 | (value / midi::kReferenceInput & 1));
            return on_measures(now);
        case midi::GET_POSITION:
            position_before_ = position_;
            position_step_ = now - position_at_;
            position_ = static_cast<std::int32_t>(value);
            position_at_ = now;
            return on_position(now);
        case midi::GET_SPEEDS:
            period_ = static_cast<std::uint16_t>(value);
            unstall_ = static_cast<std::uint8_t>(value >> 24);
            return;
        case midi::GET_SETTINGS:
            ramp_ = static_cast<std::uint8_t>(value >> 24);
            torque_ = static_cast<std::uint8_t>(value >> 16);
            tolerance_ = static_cast<std::uint8_t>(value);
            return;
        default:
            imax_ = static_cast<std::uint8_t>(value >> 24);
            if (imax_ == 0) imax_ = midi::kMostTorque;
            return;
    }
}

/// 003 §VII 01h: a trip cuts the power.
void MidiMotor::on_status() {
    status_is_new_ = true;
    if (phase_ != Phase::up || (status_ & midi::kTrips) == 0) return;
    raise(MidiFault::tripped);
    motion_ = Motion::at_rest;
    goal_holds_ = doubtful_ = false;
}

void MidiMotor::on_measures(base::Instant now) {
    measured_ = true;
    if (!not_busy_ && moves()) doubtful_ = false;
    if (motion_ == Motion::running) at_speed_ = not_busy_ && !doubtful_ && now >= ramp_end_;
    if (motion_ == Motion::at_rest && goal_holds_ && !not_busy_) {
        motion_ = Motion::going;
        arrived_ = false;
    }
}

bool MidiMotor::needs_position() const {
    switch (motion_) {
        case Motion::at_rest:
            return arrived_ && goal_holds_;
        case Motion::going:
            return measured_ && not_busy_;
        case Motion::unknown:
        case Motion::running:
        case Motion::stopping:
            break;
    }
    return true;
}

bool MidiMotor::is_within(std::int32_t slack) const {
    const auto away = static_cast<std::int64_t>(position_) - goal_;
    return std::abs(away) <= slack;
}

void MidiMotor::on_position(base::Instant now) {
    if (zero_unclear_) {
        zero_unclear_ = false;
        if (position_ == 0) zero_wanted_ = goal_holds_ = false;
    }
    if (base_ != 0) {
        const auto now_at = static_cast<std::uint32_t>(midi::counts_of_increments(model_, position_));
        const auto by = static_cast<std::uint32_t>(registers_.position(registers::P1 + 2U * (base_ - 1U)));
        registers_.set_position(registers::P_SOLL, static_cast<std::int32_t>(now_at + by));
        base_ = 0;
    }
    if (access_state_ == AccessState::under_way && !access_.is_write) finish_access();
    if (!is_explained(now)) return raise(MidiFault::jumped);
    if (motion_ == Motion::going && measured_ && not_busy_ && goal_holds_ && is_within(tolerance_)) {
        motion_ = Motion::at_rest;
        arrived_ = true;
        doubtful_ = false;
        return;
    }
    if (motion_ == Motion::at_rest) return check_still_there();
    if (needs_position()) check_steady(now);
}

/// Another master's move may have been too short to be seen as busy.
void MidiMotor::check_still_there() {
    if (!arrived_ || !goal_holds_ || is_within(std::max<std::int32_t>(tolerance_, kStandby))) return;
    motion_ = Motion::going;
    arrived_ = measured_ = false;
}

/// By how much a shaft that stands may move.
std::int32_t MidiMotor::slack() const {
    return motion_ == Motion::running ? 0 : kStandby;
}

/// Long enough for one increment more than the slack, the slowest of a ramp and of catching up. Who swings in
/// standby is within the tolerance now and then only.
base::Microseconds MidiMotor::steady_time() const {
    if (motion_ == Motion::going && goal_holds_ && is_within(kStandby)) return kSwing;
    const std::int32_t slowest =
        std::max<std::int32_t>(2 * std::max(run_period_, period_), 200 * std::int32_t{unstall_});
    return base::Microseconds((slack() + 1) * slowest) + kSurely;
}

void MidiMotor::check_steady(base::Instant now) {
    const auto away = static_cast<std::int64_t>(position_) - steady_position_;
    if (!steady_begun_ || std::abs(away) > slack()) {
        if (steady_begun_ && motion_ == Motion::running) doubtful_ = false;
        if (steady_begun_ && motion_ == Motion::unknown) seen_moving_ = true;
        steady_begun_ = true;
        steady_position_ = position_;
        steady_since_ = now;
    } else if (now - steady_since_ >= steady_time()) {
        steady_begun_ = false;
        conclude(now);
    }
}

/// The shaft stands.
void MidiMotor::conclude(base::Instant) {
    const Motion ended = motion_;
    if (ended == Motion::running && !(measured_ && not_busy_)) return;  // held, and it goes on trying
    motion_ = Motion::at_rest;
    run_period_ = 0;
    const bool expected = ended == Motion::running || (ended == Motion::going && goal_holds_);
    if (!expected) return;
    goal_holds_ = false;
    if (doubtful_) return not_taken_after_all();
    if ((status_ & kStops) != 0) return raise(MidiFault::end_stop);
    give_up(MidiFault::not_arrived);
}

/// What it was told may still wait, for another master's SYNC; 18h ends that too.
void MidiMotor::give_up(MidiFault why) {
    raise(why);
    stop_wanted_ = stop_hard_ = true;
}

void MidiMotor::not_taken_after_all() {
    doubtful_ = false;
    if (repeats_ > kMostRepeats) return give_up(MidiFault::unclear);
    ++counters_.resent;
}

/// After all orders. A write is done when its commands are through.
MidiMotor::Message MidiMotor::serve_access() {
    constexpr MidiMessage kAsk{.is_query = true, .number = midi::GET_POSITION};
    if (access_state_ == AccessState::under_way) {
        if (!access_.is_write) return kAsk;
        end_access(error() == access_error_ ? AccessState::done : AccessState::failed);
    }
    if (access_state_ != AccessState::waiting) return {};
    access_state_ = AccessState::under_way;
    if (access_.is_write) {
        begin_write();
        return {};
    }
    const unsigned last = access_.reg + (access_.longword ? 1U : 0U);
    if (last >= registers::P_IST && access_.reg <= registers::V_IST) return kAsk;
    finish_access();
    return {};
}

void MidiMotor::begin_write() {
    const Order order{
        .is_register_write = true, .reg = access_.reg, .longword = access_.longword, .value = access_.value};
    access_error_ = error();
    const bool in_vain = order.reg == registers::MODE_REG && !may_move();
    if (in_vain || lack_of(order) != Lack::none) return end_access(AccessState::failed);
    execute(order);
}

void MidiMotor::finish_access() {
    access_value_ = read_word(access_.reg);
    if (access_.longword) access_value_ |= std::uint32_t{read_word(access_.reg + 1U)} << 16;
    end_access(AccessState::done);
}

void MidiMotor::end_access(AccessState state) {
    ++(state == AccessState::done ? counters_.accesses : counters_.access_fails);
    access_state_ = state;
}

bool MidiMotor::begin_access(const Access& access) {
    if (phase_ != Phase::up || is_open(access_state_)) return false;
    access_ = access;
    access_state_ = AccessState::waiting;
    return true;
}

void MidiMotor::drop_access() {
    if (access_state_ != AccessState::under_way) access_state_ = AccessState::none;
}

std::uint16_t MidiMotor::read_word(unsigned number) const {
    const auto counts = static_cast<std::uint32_t>(midi::counts_of_increments(model_, position_));
    switch (number) {
        case registers::P_IST:
            return static_cast<std::uint16_t>(counts);
        case registers::P_IST + 1:
            return static_cast<std::uint16_t>(counts >> 16);
        case registers::V_IST:
            return static_cast<std::uint16_t>(speed());
        case registers::ERR_STAT:
            return static_cast<std::uint16_t>(error_bits());
        case registers::V_SOLL:
            if (!registers_.is_set(number))
                return static_cast<std::uint16_t>(midi::v_soll_of_period(model_, period_));
            break;
        default:
            break;
    }
    return registers_.word(number);
}

/// Counts a sample, from the last two positions if they are close enough.
std::int32_t MidiMotor::speed() const {
    if (position_step_ <= base::Microseconds(0) || position_step_ > kLongestStep) return 0;
    const auto moved = static_cast<std::int32_t>(static_cast<std::uint32_t>(position_) -
                                                 static_cast<std::uint32_t>(position_before_));
    const std::int32_t counts =
        std::clamp(midi::counts_of_increments(model_, moved), -kMostCounts, kMostCounts);
    const std::int32_t a_sample = counts * kSample / static_cast<std::int32_t>(position_step_.count());
    return std::clamp<std::int32_t>(a_sample, INT16_MIN, INT16_MAX);
}

std::uint32_t MidiMotor::error_bits() const {
    const bool trips = (status_ & midi::kTrips) != 0;
    const bool supply = (status_ & midi::kSupplyTrip) != 0;
    return bit(trips && !supply, kI2t) | bit(supply, kUit) | bit(in_position(), kInPos) |
           bit(fault_ == MidiFault::end_stop, kPositionLimit) |
           bit(error() && !trips && fault_ != MidiFault::end_stop, kFollow) | bit(relative_, kRelative);
}

}  // namespace nplc::motor
