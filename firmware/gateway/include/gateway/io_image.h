#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "gateway/debouncer.h"
#include "gateway/forced_io.h"
#include "ports/digital_io.h"

namespace nplc::gateway {

/// The board's inputs and outputs: debounced inputs, forced signals, outputs written only when they change.
class IoImage {
  public:
    IoImage(ports::DigitalInputs& inputs, ports::DigitalOutputs& outputs, base::Microseconds debounce)
        : inputs_(inputs), outputs_(outputs), debouncer_(debounce), quick_debouncer_(quick(debounce)) {}

    void set_debounce(base::Microseconds debounce) {
        debouncer_.set_steady(debounce);
        quick_debouncer_.set_steady(quick(debounce));
    }
    void read(base::Instant now) {
        const std::uint8_t levels = inputs_.read();
        debouncer_.update(levels, now);
        quick_debouncer_.update(levels, now);
    }
    std::uint8_t terminals() const { return debouncer_.levels(); }
    std::uint8_t inputs() const { return forces_.inputs().over(debouncer_.levels()); }
    /// Ignores forces; off within 9 ms whatever the debounce time.
    bool is_on(unsigned input) const {
        const unsigned both = unsigned{debouncer_.levels()} & quick_debouncer_.levels();
        return input < 6 && ((both >> input) & 1U) != 0;
    }
    base::Instant next_update() const {
        return std::min(debouncer_.next_update(), quick_debouncer_.next_update());
    }

    void write(std::uint8_t levels) {
        if (written_ == levels) return;
        outputs_.write(levels);
        written_ = levels;
    }
    std::uint8_t outputs() const { return written_.value_or(0); }

    ForcedIo& forces() { return forces_; }
    const ForcedIo& forces() const { return forces_; }

  private:
    static base::Microseconds quick(base::Microseconds debounce) {
        constexpr base::Microseconds kMost{9'000};
        return std::min(debounce, kMost);
    }

    ports::DigitalInputs& inputs_;
    ports::DigitalOutputs& outputs_;
    std::optional<std::uint8_t> written_;
    ForcedIo forces_;
    Debouncer debouncer_;
    Debouncer quick_debouncer_;  ///< for the loss of the enable input
};

}  // namespace nplc::gateway
