#pragma once

#include <cstdint>

namespace nplc::hal_mcu {

/// Cause of a crash, with the numbers of the event log (REGISTERS.md).
enum class EndCause : std::uint8_t {
    none = 0,
    watchdog = 1,
    hard_fault = 2,
    memory_fault = 3,
    bus_fault = 4,
    usage_fault = 5,
    stray_interrupt = 6,
    no_clock = 7,
    pure_call = 8,
    unrecorded = 9,  ///< reset while the firmware ran, without a record of the firmware
};

/// A record in memory that a reset does not clear, for the next start. After power-up the bytes are
/// undefined, so a check word covers them.
class CrashRecord {
  public:
    void set(EndCause cause, std::uint32_t code_address) {
        cause_ = static_cast<std::uint32_t>(cause);
        code_address_ = code_address;
        check_ = check();
    }
    bool valid() const { return check_ == check() && cause_ != 0; }
    EndCause cause() const { return valid() ? static_cast<EndCause>(cause_) : EndCause::none; }
    std::uint32_t code_address() const { return valid() ? code_address_ : 0; }
    void clear() { check_ = cause_ = 0; }

  private:
    std::uint32_t check() const { return (cause_ ^ (code_address_ << 3)) + 0x43525348U; }  // "CRSH"

    std::uint32_t cause_;
    std::uint32_t code_address_;
    std::uint32_t check_;
};

}  // namespace nplc::hal_mcu
