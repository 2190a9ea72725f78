#pragma once

#include <cstdint>

#include "hal_mcu/interrupt_ring.h"
#include "ports/serial.h"

namespace nplc::hal_mcu {

/// A serial line with interrupt-driven buffers; the chip's driver derives from it. Lost characters are
/// reported as one character with framing_error, so that no message is assembled across the gap.
class BufferedSerial : public ports::SerialPort {
  public:
    static constexpr std::size_t kCapacity = 64;  ///< characters, each way

    std::size_t write(std::span<const std::uint8_t> bytes) final;
    std::size_t read(std::span<ports::ReceivedByte> out) final;
    bool transmitter_idle() final { return to_send_.empty() && line_is_idle(); }

    bool has_received() const { return !received_.empty(); }
    ports::LineFaults faults() const final { return faults_; }

  protected:
    ~BufferedSerial() = default;

    /// To be called by the interrupt: a character was received, or one was lost before the next.
    void take_received(std::uint8_t value, bool framing_error);
    void note_overrun();
    std::optional<std::uint8_t> next_to_send() { return to_send_.pop(); }
    bool has_to_send() const { return !to_send_.empty(); }

  private:
    virtual void wake_transmitter() = 0;  ///< there are bytes to send
    virtual bool line_is_idle() = 0;

    struct Received {
        std::uint8_t value;
        bool fault;
    };
    bool gap_ = false;
    ports::LineFaults faults_;
    InterruptRing<std::uint8_t, kCapacity> to_send_;
    InterruptRing<Received, kCapacity> received_;
};

}  // namespace nplc::hal_mcu
