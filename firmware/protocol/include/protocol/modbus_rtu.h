#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/time.h"
#include "protocol/modbus_pdu.h"

/// Modbus over Serial Line V1.02 §2.5: RTU frames, receiver and sender of a slave. No heap.
namespace nplc::protocol::modbus {

/// §2.5.1.2: polynomial A001h reflected, initial value FFFFh; "123456789" gives 4B37h. Sent low byte first.
std::uint16_t crc16(std::span<const std::uint8_t> bytes);

constexpr std::size_t kMostFrame = 256;
constexpr std::uint8_t kBroadcast = 0;
/// Slaves' addresses.
constexpr std::uint8_t kLowestUnit = 1;
constexpr std::uint8_t kHighestUnit = 247;

/// The silence between two frames: 3.5 characters of 11 bits, above 19200 baud 1.75 ms (§2.5.1.1).
constexpr base::Microseconds silence_between_frames(std::uint32_t baud) {
    constexpr std::uint32_t kSteadyFrom = 19'200;
    if (baud > kSteadyFrom) return base::Microseconds(1'750);
    return base::Microseconds((38'500'000U + baud - 1U) / baud);
}

/// Splits the bytes of a line with several slaves into frames. A frame ends at the length given by its
/// function, or at a silence; other slaves' answers are skipped. After an error everything is skipped up to
/// the next silence.
class RtuReader {
  public:
    /// True: frame() is complete, until the next byte.
    bool take(std::uint8_t byte);
    /// The line has been silent: true as for take(), for a frame of unknown length.
    bool silence();
    /// A character was received with an error.
    void damaged() { is_deaf_ = true; }
    /// An incomplete frame was received.
    bool is_under_way() const { return is_deaf_ || (size_ != 0 && !is_whole_); }

    std::uint8_t unit() const { return bytes_[0]; }
    /// Function and data.
    std::span<const std::uint8_t> pdu() const { return std::span(bytes_).subspan(1, size_ - kAround); }

  private:
    static constexpr std::size_t kAround = 3;  ///< address and CRC

    std::size_t request_size() const;
    std::size_t answer_size() const;
    bool fits() const;

    std::array<std::uint8_t, kMostFrame> bytes_{};
    std::size_t size_ = 0;
    bool is_whole_ = false;
    bool is_deaf_ = false;
};

/// An answer to be sent.
class RtuFrame {
  public:
    RtuFrame() = default;
    RtuFrame(std::uint8_t unit, std::span<const std::uint8_t> pdu);
    std::span<const std::uint8_t> bytes() const { return std::span(bytes_).first(size_); }

  private:
    std::array<std::uint8_t, kMostFrame> bytes_{};
    std::size_t size_ = 0;
};

}  // namespace nplc::protocol::modbus
