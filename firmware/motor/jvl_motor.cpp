#include "motor/jvl_motor.h"

#include <algorithm>
#include <utility>

#include "motor/jvl_orders.h"

namespace nplc::motor {
namespace {

using protocol::fastmac::command_byte;
using protocol::fastmac::Number;

constexpr std::uint8_t kModeReg = 2;
constexpr base::Microseconds kBlindPause{100'000};
/// Timeout of an answer that comes after the motor's acceptance: two answers' length at 19200 baud, sent
/// slowly.
constexpr base::Microseconds kLateReply{40'000};
/// Interval of the NOP with rapid communication, where a damaged one is another command.
constexpr base::Microseconds kRapidProof{1'000'000};
constexpr int kProofEchoes = 5;

/// Rounded up.
constexpr std::uint32_t bytes_within(base::Microseconds time, std::uint32_t baud) {
    return static_cast<std::uint32_t>(time.count()) * (baud / 100) / 100'000 + 1;
}

}  // namespace

JvlMotor::JvlMotor(ports::SerialPort& port, const Settings& settings)
    : safe_communication_(settings.safe_communication),
      registers_are_32_bit_(settings.registers_are_32_bit),
      register_code_(settings.register_code),
      link_(port, settings.link),
      hold_bytes_(bytes_within(2 * settings.sample_period, settings.link.baud) + 2) {}

void JvlMotor::poll(base::Instant now) {
    switch (link_.poll(now)) {
        case JvlLink::Result::none:
            break;
        case JvlLink::Result::accepted:
            on_accepted(now);
            break;
        case JvlLink::Result::refused:
        case JvlLink::Result::silent:
        case JvlLink::Result::out_of_step:
            lose_link(now);
            break;
    }
    update_hold();
    begin_orders(now);
}

void JvlMotor::begin_orders(base::Instant now) {
    if (link_.busy()) return;
    follow_access(now);
    if (reply_until_ && !wants_stop() && orders_.empty()) return;
    if (is_up()) {
        work(now);
    } else {
        start_up(now);
    }
}

base::Instant JvlMotor::next_poll(base::Instant now) const {
    base::Instant next = link_.next_poll(now);
    if (link_.busy()) return next;
    if (has_work()) return now;
    if (reply_until_) return std::min(next, *reply_until_);
    if (phase_ != Phase::down) return std::min(next, proof_due());
    if (blind_stop_.is_under_way()) return link_.has_left() ? now : next;
    if (link_.framing_error_seen()) next = std::min(next, next_blind_);
    if (wants_stop() && link_.has_left()) next = std::min(next, blind_stop_.due());
    return next;
}

void JvlMotor::lose_link(base::Instant now) {
    orders_.discard_all();
    if (was_up_) {
        link_error_ = true;
        ++losses_;
    }
    access_.fail_open();
    if (stop_ != Stop::confirmed) stop_ = Stop::wanted;
    was_up_ = safe_now_ = slowed_ = holds_ = is_aside_ = false;
    reply_until_.reset();
    sending_ = Sending::nothing;
    phase_ = Phase::down;
    link_.forget(now);
    blind_stop_.allow(now);
}

void JvlMotor::on_accepted(base::Instant now) {
    const Sending done = std::exchange(sending_, Sending::nothing);
    switch (done) {
        case Sending::nothing:
        case Sending::link_command:
            break;
        case Sending::start_up:
            phase_ = static_cast<Phase>(static_cast<int>(phase_) + 1);
            break;
        case Sending::order:
            orders_.end();
            on_executed(orders_.current());
            break;
        case Sending::stop:
            stop_ = Stop::unproven;
            hold_in_position();
            break;
        case Sending::access:
            if (!access_.access().is_write) {
                reply_until_ = now + kLateReply + link_.late_by();
                break;
            }
            access_.finish();
            hold_in_position();
            break;
    }
    if (!link_.flexmac() && !wants_stop()) stop_ = Stop::confirmed;
    if (is_up() && !was_up_) {
        was_up_ = true;
        safe_now_ = safe_communication_;
        link_.clear_framing_error();
    }
}

[[gnu::noinline]] void JvlMotor::on_executed(const Order& order) {
    if (makes_in_position_stale(order)) hold_in_position();
    if (order.is_register_write) return;
    if (order.command == command_byte(Number::reset_error)) link_error_ = false;
    if (order.command == command_byte(Number::rapid_communication)) safe_now_ = false;
    if (order.command == command_byte(Number::safe_communication)) safe_now_ = true;
    if (order.command == command_byte(Number::transmit_slowly)) slowed_ = true;
}

/// R: a NOP in each polarity proves that the link is in step. Safe communication is requested before, also in
/// each polarity: until the motor has it, a damaged byte is another command, and an echo does not show which
/// one was executed.
void JvlMotor::start_up(base::Instant now) {
    switch (phase_) {
        case Phase::down:
            if (send_blind_stop(now)) return;
            if (link_.known()) {
                link_.synchronize();
                phase_ = Phase::look;
            } else {
                request_slow_status_blind(now);
            }
            return;
        case Phase::look:
            if (link_.flexmac()) {
                sending_ = Sending::link_command;
                link_.leave_flexmac(now);
                return;
            }
            phase_ = Phase::first_safety;
            [[fallthrough]];
        case Phase::first_safety:
        case Phase::second_safety:
            return command(Sending::start_up, safety_command(), now);
        case Phase::first_nop:
        case Phase::second_nop:
            return command(Sending::start_up, command_byte(Number::nop), now);
        case Phase::up:
            return;
    }
}

/// True while it uses the line. Before the first status the link counts as lost after `silence`.
bool JvlMotor::send_blind_stop(base::Instant now) {
    if (!blind_stop_.is_allowed()) blind_stop_.allow(now + link_.silence());
    if (!link_.has_left()) return blind_stop_.is_under_way();
    if (!blind_stop_.is_under_way() && (!wants_stop() || !blind_stop_.is_due(now))) return false;
    const auto part = blind_stop_.take_part(registers_are_32_bit_, now);
    link_.forget(now);
    if (part.size != 0) link_.send_blind(part.view(), now);
    return part.size != 0;
}

std::uint8_t JvlMotor::safety_command() const {
    return command_byte(safe_communication_ ? Number::safe_communication : Number::rapid_communication);
}

/// The link cannot synchronize to a stream without pauses: sends "transmit slowly" with either toggle, twice
/// each for safe communication.
void JvlMotor::request_slow_status_blind(base::Instant now) {
    if (!link_.framing_error_seen() || now < next_blind_) return;
    constexpr std::uint8_t slowly = command_byte(Number::transmit_slowly);
    constexpr std::uint8_t other = protocol::fastmac::with_toggle(slowly, true);
    constexpr std::uint8_t bytes[]{slowly, slowly, other, other};
    link_.clear_framing_error();
    link_.send_blind(bytes, now);
    next_blind_ = now + kBlindPause;
}

/// There is something to send.
bool JvlMotor::has_work() const {
    if (!is_up()) return phase_ != Phase::down;
    if (wants_stop() || !orders_.empty()) return true;
    if (reply_until_) return false;
    return access_.waits() || link_.flexmac() || (link_.framing_error_seen() && !slowed_);
}

void JvlMotor::work(base::Instant now) {
    const bool in_flexmac = link_.flexmac();
    const bool idle = !wants_stop() && orders_.empty();
    const bool writes = wants_stop() || (!idle && orders_.front().is_register_write);
    const bool accesses = idle && access_.waits();
    if (in_flexmac && !writes && !accesses) {
        sending_ = Sending::link_command;
        return link_.leave_flexmac(now);
    }
    if (!in_flexmac && link_.framing_error_seen() && !slowed_) {
        slowed_ = true;
        return command(Sending::link_command, command_byte(Number::transmit_slowly), now);
    }
    is_aside_ = idle;
    if (!in_flexmac && (writes || accesses))
        return command(Sending::link_command, command_byte(Number::use_flexmac), now);
    if (wants_stop()) {
        return write_register(Sending::stop,
                              {.is_register_write = true, .reg = kModeReg, .longword = registers_are_32_bit_},
                              now);
    }
    if (accesses) return send_access(now);
    if (idle) return prove_link(now);
    const Order& order = orders_.begin();
    if (order.is_register_write) return write_register(Sending::order, order, now);
    command(Sending::order, order.command, now);
}

/// Unchanging frames may come from a broken wire: only an echo proves that the motor works.
void JvlMotor::prove_link(base::Instant now) {
    if (now >= proof_due()) command(Sending::link_command, command_byte(Number::nop), now);
}

base::Instant JvlMotor::proof_due() const {
    if (!safe_now_) return link_.left_at() + kRapidProof;
    const base::Microseconds echoes = kProofEchoes * link_.echo_time();
    const bool is_late = EchoTime::kMost.count() != 0 && echoes > link_.silence();
    return link_.left_at() + (is_late ? echoes : link_.silence());
}

void JvlMotor::write_register(Sending what, const Order& order, base::Instant now) {
    sending_ = what;
    link_.send_flexmac({.longword = order.longword,
                        .level = protocol::flexmac::Level::reg,
                        .target = order.reg,
                        .value = order.value},
                       now);
}

void JvlMotor::send_access(base::Instant now) {
    const Access& access = access_.access();
    access_.start();
    sending_ = Sending::access;
    const protocol::flexmac::Message message{.read = !access.is_write,
                                             .longword = access.longword,
                                             .level = protocol::flexmac::Level::reg,
                                             .target = access.reg,
                                             .value = access.is_write ? access.value : 0};
    access.is_write ? link_.send_flexmac(message, now) : link_.send_read(message, now);
}

/// Waits for the answer to a read that the motor has accepted.
void JvlMotor::follow_access(base::Instant now) {
    if (!reply_until_) return;
    const auto value = link_.take_reply();
    if (!value && now < *reply_until_) return;
    reply_until_.reset();
    if (!access_.is_under_way()) return;
    value ? access_.finish(*value) : access_.fail();
}

void JvlMotor::command(Sending what, std::uint8_t command, base::Instant now) {
    sending_ = what;
    const bool twice = safe_now_ || !is_up();
    link_.send_command(on_the_wire(command), twice ? 2 : 1, now);
}

std::uint8_t JvlMotor::on_the_wire(std::uint8_t command) const {
    const bool is_own_code = register_code_ == protocol::fastmac::RegisterCode::format_list;
    return is_own_code ? command : recoded(command, register_code_);
}

/// R: a MAC800 supports longwords only.
bool JvlMotor::can_execute(const Order& order) const {
    return !order.is_register_write || order.longword || !registers_are_32_bit_;
}

void JvlMotor::stop() {
    orders_.discard_waiting();
    access_.fail_waiting();
    stop_ = Stop::wanted;
    blind_stop_.begin_anew();
}

bool JvlMotor::orders_complete() const {
    if (!is_up()) return true;
    const bool wants_slow = link_.framing_error_seen() && !slowed_;
    if (is_aside_) return orders_.empty() && !wants_stop();
    return !link_.busy() && orders_.empty() && !wants_stop() && !link_.flexmac() && !wants_slow;
}

Counters JvlMotor::counters() const {
    Counters counters{.link_losses = losses_, .resent = link_.resent()};
    orders_.count(counters);
    access_.count(counters);
    return counters;
}

bool JvlMotor::in_position() const {
    return is_up() && !holds_ && !link_error_ && link_.status().in_position;
}

bool JvlMotor::error() const {
    return link_error_ || (is_up() && link_.status().error);
}

Link JvlMotor::link() const {
    if (phase_ == Phase::down) return Link::down;
    if (!is_up()) return Link::starting;
    return link_error_ ? Link::unacknowledged : Link::up;
}

void JvlMotor::hold_in_position() {
    holds_ = true;
    held_from_ = link_.confirmed();
}

/// Counted in status bytes, not in time: on a delayed line those that arrive may be old, but the motor sent
/// each one after the one before. The last two are a pair from after two samples.
void JvlMotor::update_hold() {
    if (link_.confirmed() - held_from_ >= hold_bytes_) holds_ = false;
}

}  // namespace nplc::motor
