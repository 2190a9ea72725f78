#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "ports/serial.h"

namespace nplc::hal_linux {

/// The driver switches the transmitter on for the time of sending.
struct Rs485 {
    bool rts_on_send = true;  ///< RTS while it sends; otherwise while it does not
    std::uint32_t before_ms = 0;
    std::uint32_t after_ms = 0;
};

enum class Parity : std::uint8_t { none, even, odd };

struct UartSettings {
    std::string path;  ///< /dev/ttyAMA0, /dev/serial/by-id/...
    std::uint32_t baud = 19'200;
    std::optional<Rs485> rs485{};
    Parity parity = Parity::none;
    bool two_stop_bits = false;
};

/// A serial line of 8 data bits, held exclusively. An adapter that was pulled out swallows what is written
/// and is silent, like a line that was cut, until `reopen` finds it again.
class Uart final : public ports::SerialPort {
  public:
    struct Opened {
        std::unique_ptr<Uart> uart;
        std::string error;  ///< one line, without a uart
    };
    static Opened open(const UartSettings& settings);
    /// One that is gone until `reopen`.
    static std::unique_ptr<Uart> absent(const UartSettings& settings);
    ~Uart();
    Uart(const Uart&) = delete;
    Uart& operator=(const Uart&) = delete;

    std::size_t write(std::span<const std::uint8_t> bytes) override;
    std::size_t read(std::span<ports::ReceivedByte> out) override;
    bool transmitter_idle() override;

    /// To wait for bytes; -1 while it is gone.
    int descriptor() const { return descriptor_; }
    bool gone() const { return descriptor_ < 0; }
    /// Empty if it is back, with another descriptor.
    std::string reopen();

  private:
    explicit Uart(const UartSettings& settings) : settings_(settings) {}
    void lose();
    std::size_t unmarked(std::span<const std::uint8_t> bytes, std::span<ports::ReceivedByte> out);

    /// A character with a framing error comes as FFh 00h and itself, FFh as FFh FFh.
    enum class Mark : std::uint8_t { none, begun, error };

    UartSettings settings_;
    int descriptor_ = -1;
    Mark mark_ = Mark::none;
};

}  // namespace nplc::hal_linux
