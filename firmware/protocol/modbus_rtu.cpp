#include "protocol/modbus_rtu.h"

#include <algorithm>

namespace nplc::protocol::modbus {
namespace {

constexpr std::uint8_t kException = 0x80;

bool is_read(std::uint8_t function) {
    return function >= 1 && function <= 4;
}

}  // namespace

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
    unsigned crc = 0xFFFF;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? crc >> 1 ^ 0xA001U : crc >> 1;
    }
    return static_cast<std::uint16_t>(crc);
}

/// Length of a request, from the bytes received so far; 0: unknown.
std::size_t RtuReader::request_size() const {
    const std::uint8_t function = bytes_[1];
    if (function >= 1 && function <= 6) return 8;
    if ((function == 15 || function == 16) && size_ > 6) return 9U + bytes_[6];
    return 0;
}

/// The same for another slave's answer.
std::size_t RtuReader::answer_size() const {
    const std::uint8_t function = bytes_[1];
    if ((function & kException) != 0) return 5;
    if (is_read(function)) return size_ > 2 ? 5U + bytes_[2] : 0;
    return function == 5 || function == 6 || function == 15 || function == 16 ? 8 : 0;
}

bool RtuReader::fits() const {
    const std::size_t data = size_ - 2;
    return crc16(std::span(bytes_).first(data)) == (bytes_[data] | bytes_[data + 1] << 8);
}

bool RtuReader::take(std::uint8_t byte) {
    if (is_whole_) {
        is_whole_ = false;
        size_ = 0;
    }
    if (is_deaf_) return false;
    if (size_ == bytes_.size()) {
        is_deaf_ = true;
        return false;
    }
    bytes_[size_++] = byte;
    if (size_ <= kAround || (size_ != request_size() && size_ != answer_size())) return false;
    if (!fits()) return false;
    is_whole_ = true;
    return true;
}

bool RtuReader::silence() {
    const bool is_frame = !is_deaf_ && !is_whole_ && size_ > kAround && fits();
    is_deaf_ = false;
    if (!is_frame) size_ = 0;
    is_whole_ = is_frame;
    return is_frame;
}

RtuFrame::RtuFrame(std::uint8_t unit, std::span<const std::uint8_t> pdu) {
    bytes_[size_++] = unit;
    for (const std::uint8_t byte : pdu.first(std::min(pdu.size(), kMostPdu))) bytes_[size_++] = byte;
    const std::uint16_t crc = crc16(std::span(bytes_).first(size_));
    bytes_[size_++] = static_cast<std::uint8_t>(crc);
    bytes_[size_++] = static_cast<std::uint8_t>(crc >> 8);
}

}  // namespace nplc::protocol::modbus
