#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "ports/serial.h"

namespace nplc::hal_linux {

/// RS-485: the driver enables the transmitter while sending.
struct Rs485 {
    bool rts_on_send = true;  ///< RTS is on while it sends; else while it does not
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

/// A serial line of 8 data bits, locked exclusively. With an unplugged adapter writes are discarded and
/// nothing is received, as with a broken wire, until `reopen` finds it again.
class Uart final : public ports::SerialPort {
  public:
    struct Opened {
        std::unique_ptr<Uart> uart;
        std::string error;  ///< one line, if there is no uart
    };
    static Opened open(const UartSettings& settings);
    /// A port that is missing until `reopen`.
    static std::unique_ptr<Uart> absent(const UartSettings& settings);
    ~Uart();
    Uart(const Uart&) = delete;
    Uart& operator=(const Uart&) = delete;

    std::size_t write(std::span<const std::uint8_t> bytes) override;
    std::size_t read(std::span<ports::ReceivedByte> out) override;
    bool transmitter_idle() override;

    /// To wait for bytes; -1 while the port is missing.
    int descriptor() const { return descriptor_; }
    bool gone() const { return descriptor_ < 0; }
    /// Empty if it is back, with another descriptor.
    std::string reopen();

  private:
    explicit Uart(const UartSettings& settings) : settings_(settings) {}
    void lose();
    std::size_t unmarked(std::span<const std::uint8_t> bytes, std::span<ports::ReceivedByte> out);

    /// Driver escape codes: a character with a framing error is preceded by FFh 00h, a data byte FFh is sent
    /// as FFh FFh.
    enum class Mark : std::uint8_t { none, begun, error };

    UartSettings settings_;
    int descriptor_ = -1;
    Mark mark_ = Mark::none;
};

}  // namespace nplc::hal_linux
