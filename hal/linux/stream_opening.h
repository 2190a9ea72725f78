#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace nplc::hal_linux {

/// Detects a browser by the first bytes of a stream: the head of an HTTP request (a method, a space, and the
/// `/` or `*` that its target begins with), or a record of a TLS handshake (16h, 03h, 00h to 04h). No message
/// of a device's protocol begins so, however many of its start bytes precede it: in MacTalk an inverse
/// follows each byte, and 16h is not a start byte.
class StreamOpening {
  public:
    /// To be called with all bytes in order until it returns false.
    bool admits(std::span<const std::uint8_t> bytes) {
        for (const std::uint8_t byte : bytes) {
            if (decided_) return true;
            if (!admits(byte)) return false;
        }
        return true;
    }

  private:
    enum class Part : std::uint8_t { first, method, target, tls_major, tls_minor };

    bool admits(std::uint8_t byte) {
        switch (part_) {
            case Part::first:
                part_ = byte == kTlsHandshake ? Part::tls_major : Part::method;
                if (byte != kTlsHandshake) decided_ = !is_of_method(byte);
                return true;
            case Part::method:
                if (byte == ' ')
                    part_ = Part::target;
                else
                    decided_ = !is_of_method(byte);
                return true;
            case Part::target:
                decided_ = byte != '/' && byte != '*';
                return decided_;
            case Part::tls_major:
                decided_ = byte != kTlsMajor;
                part_ = Part::tls_minor;
                return true;
            case Part::tls_minor:
                decided_ = byte > kTlsMostMinor;
                return decided_;
        }
        return true;
    }
    static bool is_of_method(std::uint8_t byte) {
        return (byte >= 'A' && byte <= 'Z') || (byte >= 'a' && byte <= 'z') || (byte >= '0' && byte <= '9') ||
               byte == '-' || byte == '_' || byte == '.';
    }

    static constexpr std::uint8_t kTlsHandshake = 0x16;
    static constexpr std::uint8_t kTlsMajor = 0x03;
    static constexpr std::uint8_t kTlsMostMinor = 0x04;

    Part part_ = Part::first;
    bool decided_ = false;
};

}  // namespace nplc::hal_linux
