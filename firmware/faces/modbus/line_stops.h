#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/time.h"
#include "faces/command.h"
#include "protocol/modbus_rtu.h"

namespace nplc::modbus {

/// The stop, safe and hold commands of a request, in its order; what else it writes is left out.
std::vector<faces::Command> stops_in(std::span<const std::uint8_t> pdu, base::Instant now);

/// Finds writes of stop, safe and hold in the bytes of a line, wherever they begin: behind noise, a partial
/// frame or a frame of unknown length a receiver that waits for the next silence misses them, and a busy line
/// may never be silent.
class StopFinder {
  public:
    /// True: the bytes up to this one are such a request with a correct CRC, until the next byte.
    bool take(std::uint8_t byte);

    std::uint8_t unit() const { return found_[0]; }
    std::span<const std::uint8_t> pdu() const { return found_.subspan(1, found_.size() - kAround); }

  private:
    static constexpr std::size_t kAround = 3;  ///< address and CRC
    static constexpr std::size_t kShortest = 8;

    bool is_stop(std::span<const std::uint8_t> frame) const;

    std::array<std::uint8_t, 2 * protocol::modbus::kMostFrame> bytes_{};
    std::size_t size_ = 0;
    std::span<const std::uint8_t> found_{};
};

}  // namespace nplc::modbus
