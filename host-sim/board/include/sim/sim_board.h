#pragma once

#include <cstdint>
#include <optional>

#include "base/time.h"
#include "ports/digital_io.h"
#include "ports/watchdog.h"

namespace nplc::sim {

/// Six input terminals, four output terminals and a watchdog.
class SimBoard final : public ports::DigitalInputs, public ports::DigitalOutputs, public ports::Watchdog {
  public:
    explicit SimBoard(base::Microseconds watchdog_time) : watchdog_time_(watchdog_time) {}

    std::uint8_t read() override { return inputs_; }
    void write(std::uint8_t levels) override { outputs_ = levels & 0x0F; }
    void feed() override { fed_ = true; }

    void set_input(unsigned index, bool level);
    std::uint8_t inputs() const { return inputs_; }
    std::uint8_t outputs() const { return outputs_; }

    /// To be called after every poll of the firmware. True on a watchdog timeout: it was fed once and then
    /// not within its timeout. It then waits to be fed again.
    bool watchdog_bites(base::Instant now);
    std::uint32_t bites() const { return bites_; }

  private:
    base::Microseconds watchdog_time_;
    std::uint8_t inputs_ = 0;
    std::uint8_t outputs_ = 0;
    bool fed_ = false;
    std::optional<base::Instant> last_fed_;
    std::uint32_t bites_ = 0;
};

}  // namespace nplc::sim
