#include "protocol/modbus_pdu.h"

#include <algorithm>

namespace nplc::protocol::modbus {
namespace {

constexpr std::size_t kHead = 5;  ///< function, address, count or value

std::uint16_t word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

std::optional<Space> space_of(std::uint8_t function) {
    switch (function) {
        case 1:
        case 5:
        case 15:
            return Space::coil;
        case 2:
            return Space::discrete_input;
        case 3:
        case 6:
        case 16:
            return Space::holding_register;
        case 4:
            return Space::input_register;
        default:
            return std::nullopt;
    }
}

bool is_bits(Space space) {
    return space == Space::coil || space == Space::discrete_input;
}

/// Checks the number of value bytes of a multiple write.
bool fits(const Request& request, std::span<const std::uint8_t> pdu) {
    const bool bits = is_bits(request.space);
    const std::uint16_t most = bits ? kMostBitsWritten : kMostWordsWritten;
    if (request.count == 0 || request.count > most || pdu.size() <= kHead) return false;
    const std::size_t bytes = bits ? (request.count + 7U) / 8U : 2U * request.count;
    return pdu[kHead] == bytes && pdu.size() == kHead + 1 + bytes;
}

}  // namespace

bool Request::bit(std::size_t index) const {
    if (function == 5) return values[0] == 0xFF;
    return (values[index / 8] >> (index % 8) & 1) != 0;
}

std::uint16_t Request::word(std::size_t index) const {
    return word_at(values, 2 * index);
}

Decoded decode(std::span<const std::uint8_t> pdu) {
    Decoded decoded;
    Request& request = decoded.request;
    request.function = pdu[0];
    const auto space = space_of(request.function);
    const auto refuse = [&decoded](Exception exception) {
        decoded.exception = exception;
        return decoded;
    };
    if (!space) return refuse(Exception::illegal_function);
    if (pdu.size() < kHead) return refuse(Exception::illegal_value);
    request.space = *space;
    request.writes = request.function >= 5;
    request.address = word_at(pdu, 1);
    request.count = word_at(pdu, 3);
    if (request.function == 5 || request.function == 6) {
        const bool is_level = request.count == 0 || request.count == 0xFF00;
        if (pdu.size() != kHead || (request.function == 5 && !is_level))
            return refuse(Exception::illegal_value);
        request.values = pdu.subspan(3, 2);
        request.count = 1;
    } else if (request.writes) {
        if (!fits(request, pdu)) return refuse(Exception::illegal_value);
        request.values = pdu.subspan(kHead + 1);
    } else {
        const std::uint16_t most = is_bits(request.space) ? kMostBitsRead : kMostWordsRead;
        if (pdu.size() != kHead || request.count == 0 || request.count > most)
            return refuse(Exception::illegal_value);
    }
    if (std::size_t{request.address} + request.count > 0x1'0000) return refuse(Exception::illegal_address);
    return decoded;
}

Answer Answer::refusal(std::uint8_t function, Exception exception) {
    Answer answer;
    answer.bytes_[0] = static_cast<std::uint8_t>(function | 0x80U);
    answer.bytes_[1] = static_cast<std::uint8_t>(exception);
    answer.size_ = 2;
    return answer;
}

Answer Answer::echo(std::span<const std::uint8_t> pdu) {
    Answer answer;
    std::copy_n(pdu.begin(), kHead, answer.bytes_.begin());
    answer.size_ = kHead;
    return answer;
}

Answer::Answer(const Request& request) : size_(2) {
    bytes_[0] = request.function;
    bytes_[1] =
        static_cast<std::uint8_t>(is_bits(request.space) ? (request.count + 7U) / 8U : 2U * request.count);
}

void Answer::put_bit(bool value) {
    if (bits_ % 8 == 0) bytes_[size_++] = 0;
    if (value) bytes_[size_ - 1] = static_cast<std::uint8_t>(bytes_[size_ - 1] | 1U << bits_ % 8);
    ++bits_;
}

void Answer::put_word(std::uint16_t value) {
    bytes_[size_++] = static_cast<std::uint8_t>(value >> 8);
    bytes_[size_++] = static_cast<std::uint8_t>(value);
}

}  // namespace nplc::protocol::modbus
