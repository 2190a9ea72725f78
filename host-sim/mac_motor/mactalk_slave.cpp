#include "sim/mactalk_slave.h"

#include <algorithm>
#include <span>

#include "base/bytes.h"
#include "sim/motor_memory.h"

namespace nplc::sim {

namespace mactalk = protocol::mactalk;

void MacTalkSlave::power_up() {
    decoder_ = {};
    answer_.clear();
}

void MacTalkSlave::receive(std::uint8_t byte, bool framing_error, MacTalkTarget& motor) {
    if (framing_error) return decoder_.abandon();
    const auto request = decoder_.receive(byte);
    if (!request) return;
    if (request->address != motor.my_address() && request->address != mactalk::kEveryone) return;
    execute(*request, motor);
}

std::optional<std::uint8_t> MacTalkSlave::transmit() {
    if (answer_.empty()) return std::nullopt;
    const std::uint8_t byte = answer_.front();
    answer_.pop_front();
    return byte;
}

void MacTalkSlave::execute(const mactalk::Request& request, MacTalkTarget& motor) {
    using mactalk::Kind;
    switch (request.kind) {
        case Kind::read:
            return answer_registers(request.reg, mactalk::kReadBytes, motor);
        case Kind::read_block:
            return answer_registers(request.reg, mactalk::kBlockBytes, motor);
        case Kind::write:
            return write(request, motor);
        case Kind::read_samples:
            return answer_sample(motor);
        case Kind::safe_mode:
            if (motor.enter_safe_mode()) accept();
            return;
        case Kind::init_mode:
            motor.go_to_init();
            return accept();
        case Kind::write_flash:
            motor.write_flash();
            return;
        case Kind::reset:
            motor.reset();
            return;
    }
}

// R: MAC800 takes longwords only; a longword on the others overwrites the register after it too.
void MacTalkSlave::write(const mactalk::Request& request, MacTalkTarget& motor) {
    const bool longword = request.length == 4;
    if (is_mac800(model_) && !longword) return;
    motor.write_register(request.reg, request.value, longword);
    accept();
}

/// Whole memory cells from `reg` on; what lies beyond register 255 reads 0.
void MacTalkSlave::answer_registers(std::uint8_t reg, std::size_t bytes, const MacTalkTarget& motor) {
    const std::size_t cell = is_mac800(model_) ? 4 : 2;
    std::array<std::uint8_t, mactalk::kMaxReplyData> data{};
    for (std::size_t at = 0; at < bytes; at += cell) {
        const std::size_t number = reg + at / cell;
        if (number > 255) break;
        const std::uint32_t value = motor.read_register(static_cast<std::uint8_t>(number), is_mac800(model_));
        if (is_mac800(model_)) {
            base::store_u32(&data[at], value);
        } else {
            base::store_u16(&data[at], static_cast<std::uint16_t>(value));
        }
    }
    send(mactalk::encode_registers(reg, std::span(data).first(bytes)));
}

void MacTalkSlave::answer_sample(MacTalkTarget& motor) {
    const auto sample = motor.next_sample();
    std::array<std::uint8_t, mactalk::kMac800SampleBytes> data{};
    for (std::size_t i = 0; i < sample.size(); ++i) {
        if (is_mac800(model_)) {
            base::store_u32(&data[4 * i], sample[i]);
        } else {
            base::store_u16(&data[2 * i], static_cast<std::uint16_t>(sample[i]));
        }
    }
    const std::size_t bytes = is_mac800(model_) ? mactalk::kMac800SampleBytes : mactalk::kSampleBytes;
    send(mactalk::encode_samples(std::span(data).first(bytes)));
}

void MacTalkSlave::accept() {
    send(mactalk::encode_accept());
}

void MacTalkSlave::send(const mactalk::EncodedReply& reply) {
    answer_.insert(answer_.end(), reply.view().begin(), reply.view().end());
}

}  // namespace nplc::sim
