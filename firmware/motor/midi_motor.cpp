#include "motor/midi_motor.h"

#include <algorithm>
#include <utility>

#include "motor/midi_guidance.h"

namespace nplc::motor {
namespace {

namespace midi = registers::midi;
using registers::INPOSWIN;
using registers::MODE_REG;
using registers::T_SOLL;
using registers::V_SOLL;
using Kind = MidiOutcome::Kind;
constexpr auto kNothing = MidiNext::nothing;

constexpr std::uint8_t kMostRepeats = 3;  ///< of one command
constexpr base::Microseconds kRetry{20'000};
constexpr std::uint8_t kMostRefusals = 50;  ///< of a command that waits for standstill
/// Time limit of an unexplained motion; then it is stopped.
constexpr base::Microseconds kPatience{1'000'000};
/// Query intervals while something moves, and at standstill.
constexpr base::Microseconds kPace{5'000};
constexpr base::Microseconds kRestPace{20'000};
constexpr int kMostAtOnce = 7;  ///< orders in a poll
constexpr std::uint8_t kCommandMode = 3;
constexpr std::uint8_t kNop = 0x60;

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

void MidiMotor::poll(base::Instant now) {
    const MidiOutcome outcome = link_.poll(now);
    if (outcome.kind != Kind::none) on_outcome(outcome, now);
    if (link_.take_boot() && session_.on_boot(now)) {
        lose_link(MidiFault::restarted, now);
        session_.ask_at(now);
    }
    look_for_trouble(now);
    work(now);
}

base::Instant MidiMotor::next_poll(base::Instant now) const {
    if (link_.busy() && !(stop_wanted_ && session_.is_blind())) return link_.next_poll(now);
    base::Instant next = std::min(link_.next_poll(now), session_.next_send(has_work(now), now));
    if (!session_.is_up()) return next;
    if ((refusals_ != 0 || stop_wanted_) && retry_at_ > now) next = std::min(next, retry_at_);
    if (motion_.state() == MidiMotion::State::stopping)
        next = std::min(next, std::max(now, motion_.ramp_end()));
    return next;
}

bool MidiMotor::has_work(base::Instant now) const {
    return (stop_wanted_ ? now >= retry_at_ : reset_wanted_ || zero_wanted_) ||
           registers_.awaits_position() || orders_.is_executing() || !orders_.empty() || !status_is_new_ ||
           motion_.motion_unconfirmed() || access_.is_open();
}

// Outcomes of messages.

/// Both drives obey the stop, and where answers are damaged the requests may still be understood.
void MidiMotor::look_for_trouble(base::Instant now) {
    const BusFault trouble = link_.trouble();
    if (trouble == BusFault::none) return;
    const bool down = session_.is_down();
    if (trouble == BusFault::no_bus) return down ? void() : lose_link(MidiFault::link_lost, now);
    if (down && fault_ == MidiFault::several) return;
    session_.expect_up();  // reported even at a start, and before a loss that is not acknowledged yet
    fault_ = MidiFault::none;
    lose_link(MidiFault::several, now);
}

void MidiMotor::drop_orders() {
    orders_.discard_all();
    link_.withdraw();
}

void MidiMotor::lose_link(MidiFault why, base::Instant now) {
    drop_orders();
    if (why != MidiFault::link_lost && why != MidiFault::restarted) stop_wanted_ = true;
    if (session_.lose(link_.busy(), stop_wanted_, now)) raise(why);
    access_.fail_open();
    reset_wanted_ = false;
    motion_.forget_goal();
    repeats_ = refusals_ = 0;
}

void MidiMotor::on_outcome(const MidiOutcome& outcome, base::Instant now) {
    if (session_.ends_old_message()) return;
    // A probe or a blind stop: its answer counts as soon as only one module gives it.
    if (session_.is_down()) {
        probe_ = outcome;
        const bool counts = outcome.kind <= Kind::refused && link_.trouble() == BusFault::none;
        session_.note_probe(counts);
        if (!counts) return;
    }
    switch (outcome.kind) {
        case Kind::none:
            return;
        case Kind::accepted:
            session_.note_success();
            return on_accepted(now);
        case Kind::value:
            session_.note_success();
            return on_value(outcome.value, now);
        case Kind::refused:
            if (session_.skips_refused()) return session_.note_success();
            if (!message_.is_query) return on_refused(now);
            [[fallthrough]];
        case Kind::not_taken:
        case Kind::unclear:
            if (session_.note_failure())
                return lose_link(outcome.damaged ? MidiFault::unreadable : MidiFault::link_lost, now);
            if (outcome.kind != Kind::not_taken) return on_unclear(now);
            ++resent_;
    }
}

void MidiMotor::on_accepted(base::Instant now) {
    status_is_new_ = false;
    repeats_ = 0;
    motion_.begin_command();
    switch (message_.number) {
        case midi::ZERO_POSITION:
            zero_wanted_ = false;
            drive_.set_origin();
            return motion_.begin_origin();
        case midi::TORQUE:
            return drive_.set_torque(message_.data);
        case midi::TOLERANCE:
            return drive_.set_tolerance(message_.data);
        case midi::SPEED:
            refusals_ = 0;
            return drive_.set_period(message_.data);
        case midi::RAMP:
            refusals_ = 0;
            return drive_.set_ramp(message_.data);
        case midi::GO_TO:
            refusals_ = 0;
            motion_.begin_move(static_cast<std::int32_t>(message_.data));
            break;
        case midi::RUN:
            refusals_ = 0;
            motion_.begin_run(message_.data, drive_, now);
            break;
        case midi::RESET:
            return begin_reset(now);
        default:
            give_up_stop();
            motion_.begin_stop(drive_, now);
            break;
    }
    session_.ask_at(now);
}

void MidiMotor::on_value(std::uint32_t value, base::Instant now) {
    drive_.take_answer(message_.number, value, now);
    if (message_.number == midi::GET_STATUS) on_status();
    if (message_.number == midi::GET_MEASURES) motion_.on_measures(drive_, now);
    if (message_.number == midi::GET_POSITION) on_position(now);
    if (session_.on_answer(motion_.at_rest() ? kRestPace : kPace, now)) motion_.restart();
}

/// 003 §VII 01h: a trip cuts the motor power.
void MidiMotor::on_status() {
    status_is_new_ = true;
    if (!session_.is_up() || !drive_.trips()) return;
    raise(MidiFault::tripped);
    if (!stop_wanted_) motion_.end_by_trip();
}

void MidiMotor::on_position(base::Instant now) {
    if (std::exchange(zero_unclear_, false) && drive_.position() == 0) {
        zero_wanted_ = false;
        motion_.drop_goal();
    }
    registers_.on_position(drive_.counts());
    if (access_.is_under_way() && !access_.access().is_write) finish_read();
    const bool was_at_rest = motion_.at_rest();
    const MidiMotion::Event event = motion_.on_position(drive_, asked_at_, now);
    if (!was_at_rest && motion_.at_rest()) give_up_stop();  // confirmed
    on_motion(event);
}

void MidiMotor::on_motion(MidiMotion::Event event) {
    switch (event) {
        case MidiMotion::Event::none:
            return;
        case MidiMotion::Event::jumped:
            return raise(MidiFault::jumped);
        case MidiMotion::Event::end_stop:
            return raise(MidiFault::end_stop);
        case MidiMotion::Event::not_arrived:
            return raise_and_stop(MidiFault::not_arrived);
        case MidiMotion::Event::not_taken:
            if (repeats_ > kMostRepeats) return raise_and_stop(MidiFault::unclear);
            ++resent_;
    }
}

/// Parameters and stops may be sent again. For a motion the module's state is queried; a change of a run's
/// speed and a zeroing in motion cannot be verified.
void MidiMotor::on_unclear(base::Instant now) {
    session_.ask_first();
    if (message_.is_query) return;
    const bool in_run = message_.number == midi::RUN && motion_.state() == MidiMotion::State::running;
    const bool moved_origin = message_.number == midi::ZERO_POSITION && !motion_.at_rest();
    if (in_run || moved_origin || ++repeats_ > kMostRepeats) {
        if (stop_wanted_) pause_stop(now);
        forget_parameter();
        raise(MidiFault::unclear);
        stop_wanted_ = true;
    } else if (message_.number == midi::ZERO_POSITION) {
        zero_unclear_ = true;
        motion_.stop_watching();
    } else if (message_.number == midi::RESET) {
        begin_reset(now);
    } else if (message_.number == midi::GO_TO || message_.number == midi::RUN) {
        const std::uint8_t repeats = repeats_;
        on_accepted(now);
        repeats_ = repeats;
        motion_.doubt();
    } else {
        ++resent_;
    }
}

void MidiMotor::on_refused(base::Instant now) {
    session_.note_success();
    status_is_new_ = false;
    switch (message_.number) {
        case midi::GO_TO:
        case midi::RUN:
        case midi::SPEED:
        case midi::RAMP:
            return on_refused_motion(now);
        case midi::STOP:
            stop_wanted_ = stop_hard_ = true;
            return;
        case midi::EMERGENCY_STOP:
            pause_stop(now);
            break;
        default:
            forget_parameter();
            break;
    }
    raise(MidiFault::refused);
}

/// Nothing confirms the stop: the shaft may, before it is sent again.
[[gnu::noinline]] void MidiMotor::pause_stop(base::Instant now) {
    stop_hard_ = stop_wanted_;
    if (motion_.state() != MidiMotion::State::unknown) motion_.forget();
    retry_at_ = now + session_.stop_pause();
}

/// The shaft moves, contrary to the driver's former conclusion.
void MidiMotor::on_refused_motion(base::Instant now) {
    motion_.wait_for_rest(refusals_ == 0 ? now + kPatience : base::Instant{});
    retry_at_ = now + kRetry;
    if (++refusals_ > kMostRefusals) raise(MidiFault::refused);
}

/// Gives up a parameter that the module does not accept, so that it is not retried endlessly.
void MidiMotor::forget_parameter() {
    repeats_ = 0;
    if (message_.number == midi::TORQUE) registers_.unset(T_SOLL);
    if (message_.number == midi::TOLERANCE) registers_.unset(INPOSWIN);
    if (message_.number == midi::RESET) reset_wanted_ = false;
    zero_wanted_ = zero_unclear_ = false;
}

/// The position is kept (R: "a status similar to the startup status").
[[gnu::noinline]] void MidiMotor::begin_reset(base::Instant now) {
    reset_wanted_ = false;
    fault_ = MidiFault::none;
    motion_.drop_goal();
    session_.begin_reset(now);
    orders_.end();
    drop_orders();
    access_.fail_open();
}

/// Keeps the first reason. The drive is brought to a stop.
void MidiMotor::raise(MidiFault fault, Limitation limitation) {
    if (fault_ == MidiFault::none) {
        fault_ = fault;
        limitation_ = limitation;
    }
    registers_.set_word(MODE_REG, 0);
    registers_.drop_awaited();
    refusals_ = 0;
    zero_wanted_ = zero_unclear_ = false;
}

/// A command may still be deferred until another master's SYNC; 18h cancels that too.
void MidiMotor::raise_and_stop(MidiFault fault) {
    raise(fault);
    stop_wanted_ = stop_hard_ = true;
}

// Selection of the next message.

void MidiMotor::work(base::Instant now) {
    if (link_.busy() && !(stop_wanted_ && session_.is_stop_due(now))) return;
    const MidiNext next = next_message(now);
    if (next == kNothing) return;
    message_ = message_of(next);
    asked_at_ = static_cast<std::uint32_t>(now.time_since_epoch().count());
    link_.begin(message_, now);
}

MidiNext MidiMotor::next_message(base::Instant now) {
    if (!session_.is_up()) return session_.start_up(stop_wanted_, now);
    if (session_.must_ask()) return midi_query(midi::GET_STATUS);
    // Less than the queue: a scan with more orders goes on before the last of these is taken.
    for (int left = kMostAtOnce; left != 0; --left) {
        if (const MidiNext next = next_command(now); next != kNothing) return next;
        if (zero_unclear_ || registers_.awaits_position()) return midi_query(midi::GET_POSITION);
        if (motion_.motion_unconfirmed()) return next_query(now);
        orders_.end();
        if (orders_.empty()) {
            if (!status_is_new_) return midi_query(midi::GET_STATUS);
            if (const MidiNext next = next_access(); next != kNothing) return next;
            return next_query(now);
        }
        execute(orders_.begin());
    }
    return kNothing;
}

MidiNext MidiMotor::next_query(base::Instant now) {
    return session_.next_query(motion_.moves() || motion_.needs_position(drive_),
                               motion_.motion_unconfirmed(), now);
}

/// The command that can be sent now to bring the drive to the state in the registers; nothing while it has to
/// wait for standstill.
MidiNext MidiMotor::next_command(base::Instant now) {
    if (motion_.stops_late(now)) stop_wanted_ = stop_hard_ = true;
    if (stop_wanted_)
        return now < retry_at_ ? kNothing : midi_command(stop_hard_ ? midi::EMERGENCY_STOP : midi::STOP);
    if (reset_wanted_) return midi_command(midi::RESET);
    if (zero_unclear_ || motion_.motion_unconfirmed()) return kNothing;
    if (zero_wanted_) return midi_command(midi::ZERO_POSITION);
    MidiGuidance guidance(registers_, drive_, motion_);
    if (const MidiNext next = guidance.next_parameter(); next != kNothing) return next;
    if (registers_.mode() == 0)
        return motion_.moves() || (motion_.unexpected_motion() && error()) ? midi_command(midi::STOP)
                                                                           : kNothing;
    if (refusals_ != 0 && now < retry_at_) return kNothing;
    // POSITION(P1, V1) is V1, then P1: no motion towards the old P_SOLL in between, which could not be
    // redirected.
    if (motion_.at_rest() && !orders_.empty()) return kNothing;
    if (motion_.unexpected_motion()) return midi_command(midi::STOP);
    if (!session_.is_alone(now)) return kNothing;
    const MidiNext motion = guidance.next_motion();
    if (guidance.limitation() != Limitation::none) raise(MidiFault::bad_value, guidance.limitation());
    return motion;
}

/// Accesses come after all orders. A write is done when its commands have been carried out.
MidiNext MidiMotor::next_access() {
    const Access& access = access_.access();
    if (access_.is_under_way()) {
        if (!access.is_write) return midi_query(midi::GET_POSITION);
        error() == access_error_ ? access_.finish() : access_.fail();
    }
    if (!access_.waits()) return kNothing;
    access_.start();
    if (access.is_write) {
        begin_write();
        return kNothing;
    }
    const unsigned last = access.reg + (access.longword ? 1U : 0U);
    if (last >= registers::P_IST && access.reg <= registers::V_IST) return midi_query(midi::GET_POSITION);
    finish_read();
    return kNothing;
}

// Effects of an order.

MidiMotor::Limitation MidiMotor::limitation_of(const Order& order) const {
    return order.is_register_write
               ? midi::limitation_of_write(drive_.model(), order.reg, order.longword, order.value)
               : midi::limitation_of_command(order.command);
}

void MidiMotor::execute(const Order& order) {
    const Limitation limitation = limitation_of(order);
    if (limitation != Limitation::none) return raise(MidiFault::bad_value, limitation);
    const unsigned number = order.command & 0x1FU;
    const auto mode = static_cast<std::uint16_t>(order.command >> 5 & 3);
    if (order.is_register_write) {
        write(order);
    } else if (mode != kCommandMode) {
        registers_.select(number);
        write_word(MODE_REG, mode);
    } else if (number == 0x01) {
        reset_error();
    } else if (number == 0x03) {
        zero_wanted_ = true;
    } else {
        registers_.execute(static_cast<std::uint8_t>(number));
    }
    if (!order.is_register_write && order.command == kNop) return;
    if (const auto goal = target(); goal && registers_.mode() == 2) motion_.check_again(*goal);
}

void MidiMotor::write(const Order& order) {
    if (order.reg == registers::P_IST) {
        zero_wanted_ = true;
        return;
    }
    write_word(order.reg, static_cast<std::uint16_t>(order.value));
    if (order.longword) write_word(order.reg + 1U, static_cast<std::uint16_t>(order.value >> 16));
}

/// 001 §4.4: with an error the mode is kept.
void MidiMotor::write_word(unsigned number, std::uint16_t value) {
    if (number == MODE_REG && value != 0 && error()) return;
    registers_.write(number, value);
}

/// 003 §VII 01h: a trip is acknowledged by 00h only.
void MidiMotor::reset_error() {
    session_.acknowledge();
    fault_ = MidiFault::none;
    limitation_ = Limitation::none;
    if (!drive_.trips()) return;
    reset_wanted_ = true;
    fault_ = MidiFault::tripped;
}

void MidiMotor::begin_write() {
    const Access& access = access_.access();
    const Order order{
        .is_register_write = true, .reg = access.reg, .longword = access.longword, .value = access.value};
    access_error_ = error();
    const bool in_vain = order.reg == MODE_REG && access_error_;
    if (in_vain || limitation_of(order) != Limitation::none) return access_.fail();
    execute(order);
}

void MidiMotor::finish_read() {
    const Access& access = access_.access();
    std::uint32_t value = read_word(access.reg);
    if (access.longword) value |= std::uint32_t{read_word(access.reg + 1U)} << 16;
    access_.finish(value);
}

std::uint16_t MidiMotor::read_word(unsigned number) const {
    const auto counts = static_cast<std::uint32_t>(drive_.counts());
    switch (number) {
        case registers::P_IST:
            return static_cast<std::uint16_t>(counts);
        case registers::P_IST + 1:
            return static_cast<std::uint16_t>(counts >> 16);
        case registers::V_IST:
            return static_cast<std::uint16_t>(drive_.speed());
        case registers::ERR_STAT:
            return static_cast<std::uint16_t>(error_bits());
        case V_SOLL:
            if (!registers_.is_set(number))
                return static_cast<std::uint16_t>(midi::v_soll_of_period(drive_.model(), drive_.period()));
            break;
        default:
            break;
    }
    return registers_.word(number);
}

std::uint32_t MidiMotor::error_bits() const {
    const bool supply = (drive_.status() & midi::kSupplyTrip) != 0;
    return bit(drive_.trips() && !supply, kI2t) | bit(supply, kUit) | bit(in_position(), kInPos) |
           bit(fault_ == MidiFault::end_stop, kPositionLimit) |
           bit(error() && !drive_.trips() && fault_ != MidiFault::end_stop, kFollow) |
           bit(registers_.is_relative(), kRelative);
}

std::optional<std::int32_t> MidiMotor::target() const {
    return MidiGuidance(registers_, drive_, motion_).target();
}

void MidiMotor::stop() {
    drop_orders();
    reset_wanted_ = zero_wanted_ = zero_unclear_ = false;
    registers_.drop_awaited();
    refusals_ = 0;
    registers_.set_word(MODE_REG, 0);
    access_.fail_waiting();
    stop_wanted_ = true;
    retry_at_ = {};
    motion_.begin_command();
    session_.begin_stop();
}

// Reported state.

bool MidiMotor::orders_complete() const {
    if (!session_.is_up()) return true;
    return orders_.empty() && !orders_.is_executing() && !stop_wanted_ && !reset_wanted_ &&
           !session_.must_ask() && !motion_.motion_unconfirmed() && status_is_new_;
}

bool MidiMotor::error() const {
    return session_.has_error() || fault_ != MidiFault::none || (session_.is_up() && drive_.trips());
}

MidiFault MidiMotor::fault() const {
    if (fault_ != MidiFault::none || !error()) return fault_;
    return session_.link_error() ? MidiFault::link_lost : MidiFault::tripped;
}

bool MidiMotor::in_position() const {
    if (!session_.is_up() || error() || motion_.motion_unconfirmed()) return false;
    if (registers_.mode() == 2) {
        const auto goal = target();
        return goal && motion_.has_arrived_at(*goal);
    }
    if (registers_.mode() != 1) return false;
    return registers_.v_soll() == 0 ? motion_.at_rest() : motion_.at_speed();
}

Counters MidiMotor::counters() const {
    Counters counters{.link_losses = session_.losses(), .resent = resent_};
    orders_.count(counters);
    access_.count(counters);
    return counters;
}

}  // namespace nplc::motor
