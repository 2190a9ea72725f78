#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace nplc::hal_linux {

/// What a client says first tells a device's protocol from what a browser sends: the head of a request is
/// text from its first character on, and TLS begins with 16h. MacTalk has an inverse among its first five
/// bytes, FastMAC its toggle bit in the first, V24 STX; none of these is text.
class StreamOpening {
  public:
    /// To be asked for all bytes in their order until it says no.
    bool admits(std::span<const std::uint8_t> bytes) {
        for (const std::uint8_t byte : bytes) {
            if (decided_) return true;
            if (seen_ == 0 && byte == kTlsHandshake) return false;
            decided_ = byte < ' ' || byte > '~';
            if (!decided_ && ++seen_ == kMostText) return false;
        }
        return true;
    }

  private:
    static constexpr std::uint8_t kTlsHandshake = 0x16;
    static constexpr std::size_t kMostText = 5;

    std::size_t seen_ = 0;
    bool decided_ = false;
};

}  // namespace nplc::hal_linux
