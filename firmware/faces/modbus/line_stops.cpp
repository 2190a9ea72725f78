#include "line_stops.h"

#include <algorithm>

#include "modbus/map.h"
#include "modbus/session.h"

namespace nplc::modbus {

namespace gw = registers::gateway;
using protocol::modbus::kMostFrame;

std::vector<faces::Command> stops_in(std::span<const std::uint8_t> pdu, base::Instant now) {
    if (!Session::asks_stop(pdu)) return {};
    const Request request = decode(pdu).request;
    if (request.space == Space::holding_register)
        return {faces::Command::of(static_cast<gw::Command>(request.word(0)), now)};
    constexpr std::array kStops{std::pair{kStop, gw::Command::stop}, std::pair{kSafe, gw::Command::safe},
                                std::pair{kHold, gw::Command::hold}};
    std::vector<faces::Command> stops;
    for (const auto& [coil, command] : kStops) {
        const unsigned first = request.address;
        if (coil >= first && coil < first + request.count && request.bit(coil - first))
            stops.push_back(faces::Command::of(command, now));
    }
    return stops;
}

bool StopFinder::is_stop(std::span<const std::uint8_t> frame) const {
    constexpr std::uint8_t kWriteCoil = 5;
    constexpr std::uint8_t kWriteRegister = 6;
    constexpr std::uint8_t kWriteCoils = 15;
    constexpr std::uint8_t kWriteRegisters = 16;
    const std::uint8_t function = frame[1];
    const bool writes_one = function == kWriteCoil || function == kWriteRegister;
    const bool writes_many = function == kWriteCoils || function == kWriteRegisters;
    if (!writes_one && !writes_many) return false;
    if (frame.size() != (writes_one ? kShortest : std::size_t{9} + frame[6])) return false;
    if (!Session::asks_stop(frame.subspan(1, frame.size() - kAround))) return false;
    const std::size_t data = frame.size() - 2;
    return protocol::modbus::crc16(frame.first(data)) == (frame[data] | frame[data + 1] << 8);
}

bool StopFinder::take(std::uint8_t byte) {
    if (size_ == bytes_.size()) {
        std::copy(bytes_.end() - kMostFrame, bytes_.end(), bytes_.begin());
        size_ = kMostFrame;
    }
    bytes_[size_++] = byte;
    const std::size_t longest = std::min(size_, kMostFrame);
    for (std::size_t length = kShortest; length <= longest; ++length) {
        found_ = std::span<const std::uint8_t>(bytes_).subspan(size_ - length, length);
        if (is_stop(found_)) return true;
    }
    return false;
}

}  // namespace nplc::modbus
