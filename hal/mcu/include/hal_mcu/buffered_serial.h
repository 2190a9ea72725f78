#pragma once

#include <cstdint>

#include "hal_mcu/interrupt_ring.h"
#include "ports/serial.h"

namespace nplc::hal_mcu {

/// A serial line whose interrupt moves the characters. The chip's part derives from it. A place where
/// characters were lost is handed on as a character with framing_error, so that no message is put together
/// across the gap.
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

    /// For the interrupt: a character has come, or one was lost before the next.
    void take_received(std::uint8_t value, bool framing_error);
    void note_overrun();
    std::optional<std::uint8_t> next_to_send() { return to_send_.pop(); }
    bool has_to_send() const { return !to_send_.empty(); }

  private:
    virtual void wake_transmitter() = 0;  ///< there is something to send
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
