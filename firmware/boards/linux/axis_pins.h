#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config.h"
#include "hal_linux/event_loop.h"
#include "hal_linux/gpio.h"

namespace nplc::boards {

/// The GPIO lines of an axis.
class AxisPins {
  public:
    /// Opens the lines and keeps those whose chip is available. Outputs get the levels `safe` first, and
    /// those of set_safe() at the end. Returns one error line per missing one; then it may be retried.
    std::vector<std::string> open(const AxisConfig& config, std::uint8_t safe);
    hal_linux::GpioInputs& inputs() { return *inputs_; }
    hal_linux::GpioOutputs& outputs() { return *outputs_; }
    void set_safe(std::uint8_t levels);
    /// Async-signal-safe; no effect without outputs.
    void write(std::uint8_t levels);

    /// Edges wake the event loop with `mark` and the marks after it.
    void watch(hal_linux::EventLoop& loop, std::uint32_t mark);
    void note_edge(std::uint32_t descriptor) { edges_ |= 1U << descriptor; }
    bool has_edges() const { return edges_ != 0; }
    void read_inputs();

    /// True once when a chip is lost. Its descriptors, which then are readable all the time, are no longer
    /// watched.
    bool is_newly_lost(hal_linux::EventLoop& loop);

  private:
    hal_linux::GpioBits input_bits_;
    hal_linux::GpioBits output_bits_;
    bool has_inputs_ = false;
    bool has_outputs_ = false;
    std::optional<hal_linux::GpioInputs> inputs_;
    std::optional<hal_linux::GpioOutputs> outputs_;
    std::uint32_t edges_ = 0;  ///< pending edges, one bit per input descriptor, bit 0 is the first
    bool told_lost_ = false;
};

}  // namespace nplc::boards
