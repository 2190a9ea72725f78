#include "sim/fastmac_slave.h"

#include "sim/motor_memory.h"

namespace nplc::sim {
namespace {

namespace fastmac = protocol::fastmac;
namespace flexmac = protocol::flexmac;

constexpr std::size_t kReplyBuffer = 64;
constexpr int kCharacter = 10;  // bits

// R: the read indices of 001 §5.2.2 whose registers have another number on MAC800 (004).
std::uint8_t mac800_number(std::uint8_t reg) {
    switch (reg) {
        case 120:
            return 163;  // V_EXT
        case 121:
            return 169;  // VF_OUT
        case 122:
            return 170;  // ANINP
        case 131:
            return 178;  // I_NOM
        default:
            return reg;
    }
}

}  // namespace

FastMacSlave::FastMacSlave(const Options& options) : options_(options) {
    if (options_.baud <= 0) options_.baud = 19200;
}

void FastMacSlave::power_up() {
    receiver_ = {};
    decoder_ = {};
    flexmac_ = slow_ = framing_error_ = false;
    last_received_.reset();
    pause_until_.reset();
    reply_.clear();
    address_due_in_.reset();
}

base::Microseconds FastMacSlave::bits(int count) const {
    return base::Microseconds(std::int64_t{1'000'000} * count / options_.baud);
}

void FastMacSlave::receive(std::uint8_t byte, bool framing_error, base::Instant now, LinkTarget& motor) {
    // R: resynchronization: after nine idle bits the next start bit is a start bit again.
    constexpr int kInStep = kCharacter + 9;
    const base::Microseconds since = last_received_ ? now - *last_received_ : base::Microseconds(0);
    last_received_ = now;
    if (since >= bits(3 * kCharacter) || framing_error) {
        receiver_.break_pair();
        decoder_.abandon();
    }
    if (framing_error || since >= bits(kInStep)) show_framing_error(framing_error, motor);
    if (framing_error) return;
    if (!flexmac_) {
        receive_command(byte, now, motor);
    } else if (const auto message = decoder_.receive(byte)) {
        receive_message(*message, now, motor);
    }
}

void FastMacSlave::show_framing_error(bool seen, LinkTarget& motor) {
    framing_error_ = seen;
    motor.show_framing_error(seen);
}

void FastMacSlave::receive_command(std::uint8_t byte, base::Instant now, LinkTarget& motor) {
    const auto accepted = receiver_.receive(byte);
    if (!accepted) return;
    const fastmac::Command command = fastmac::decode_command(*accepted, options_.code);
    // R: in SAFE_MODE the link's own commands still act, so that a master can communicate and read.
    const bool on_link = command.mode == fastmac::Mode::command &&
                         execute_on_link(static_cast<fastmac::Number>(command.number));
    const bool effective = on_link || !motor.in_safe_mode();
    log({.at = now, .command = *accepted, .effective = effective});
    if (!on_link && effective) motor.execute(command);
}

bool FastMacSlave::execute_on_link(fastmac::Number number) {
    switch (number) {
        case fastmac::Number::nop:
        case fastmac::Number::use_fastmac:
            return true;
        case fastmac::Number::rapid_communication:
            receiver_.set_safe(false);
            return true;
        case fastmac::Number::safe_communication:
            receiver_.set_safe(true);
            return true;
        case fastmac::Number::transmit_slowly:
            slow_ = true;
            return true;
        case fastmac::Number::transmit_address:
            // R: two, because a master accepts a status byte only when it is received twice.
            address_due_in_ = 2;
            return true;
        case fastmac::Number::use_flexmac:
            flexmac_ = true;
            decoder_ = {};
            return true;
        default:
            return false;
    }
}

bool FastMacSlave::takes(const flexmac::Message& message) const {
    if (message.read && reply_.size() + flexmac::kMaxBytes > kReplyBuffer) return false;
    if (!is_mac800(options_.model)) return true;
    // R: MAC800 supports longwords only, and registers by number only.
    return message.level != flexmac::Level::address && (message.read || message.longword);
}

std::uint8_t FastMacSlave::register_of(const flexmac::Message& message) const {
    const auto low = static_cast<std::uint8_t>(message.target);
    switch (message.level) {
        case flexmac::Level::reg:
            return low;
        case flexmac::Level::address:
            return flexmac::register_of_address(message.target).value_or(0);
        case flexmac::Level::index:
            break;
    }
    const std::uint8_t reg =
        message.read ? flexmac::register_of_read_index(low) : flexmac::register_of_write_index(low);
    return is_mac800(options_.model) ? mac800_number(reg) : reg;
}

void FastMacSlave::receive_message(const flexmac::Message& message, base::Instant now, LinkTarget& motor) {
    if (!takes(message)) return;
    receiver_.accept_other();
    show_framing_error(false,
                       motor);  // R: a line out of step cannot produce three header bytes and the inverses
    if (flexmac::is_protocol_command(message)) {
        flexmac_ = message.target == flexmac::kReadIndexUseFlexMac;
        return;
    }
    if (message.read) return reply(message, motor);
    const std::uint8_t reg = register_of(message);
    const bool effective = reg != 0 && !motor.in_safe_mode();
    log({.at = now, .flexmac = true, .message = message, .reg = reg, .effective = effective});
    if (effective) motor.write_register(reg, message.value, message.longword);
}

void FastMacSlave::reply(const flexmac::Message& request, const LinkTarget& motor) {
    const std::uint8_t reg = register_of(request);
    const std::uint32_t value = reg == 0 ? 0 : motor.read_register(reg, request.longword);
    const flexmac::Encoded answer = flexmac::encode_reply(request, value);
    reply_.insert(reply_.end(), answer.view().begin(), answer.view().end());
}

std::optional<std::uint8_t> FastMacSlave::transmit(base::Instant now, const LinkTarget& motor) {
    if (pause_until_ && now < *pause_until_) return std::nullopt;
    pause_until_.reset();
    if (slow_) pause_until_ = now + bits(2 * kCharacter);
    return next_byte(motor);
}

std::uint8_t FastMacSlave::next_byte(const LinkTarget& motor) {
    if (!reply_.empty()) {
        const std::uint8_t byte = reply_.front();
        reply_.pop_front();
        return byte;
    }
    if (address_due_in_ && (*address_due_in_)-- == 0) {
        address_due_in_.reset();
        return motor.my_address();
    }
    return status_byte(motor);
}

std::uint8_t FastMacSlave::status_byte(const LinkTarget& motor) const {
    const std::uint32_t errors = motor.error_status();
    const std::uint32_t changes = errors & 0x60;  // both only if a client wrote them: then neither
    return fastmac::encode_status({.toggle = receiver_.toggle(),
                                   .decelerating = changes == 0x40,
                                   .accelerating = changes == 0x20,
                                   .in_position = (errors & 0x10) != 0,
                                   .flexmac = flexmac_,
                                   .framing_error = framing_error_,
                                   .error = (errors & 0x0F) != 0});
}

void FastMacSlave::log(const Order& order) {
    if (orders_.size() >= options_.log_limit && !orders_.empty()) orders_.pop_front();
    if (options_.log_limit > 0) orders_.push_back(order);
}

}  // namespace nplc::sim
