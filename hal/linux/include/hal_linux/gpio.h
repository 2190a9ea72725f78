#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ports/digital_io.h"

/// Inputs and outputs on lines of the kernel's GPIO chips, by libgpiod 1.6 or 2. A line is held from `take`
/// on, outputs with their first level from that moment. When a program ends in whatever way, the kernel takes
/// its lines back, and what level one then has is the driver's affair: some hold the last one, others make it
/// an input. So a line that moves something needs a resistor that pulls it to its safe level. A chip that has
/// no bias ignores a request for one without an error.
namespace nplc::hal_linux {

enum class GpioBias : std::uint8_t { as_is, off, pull_up, pull_down };

struct GpioLine {
    std::string where;        ///< gpiochip0:17, /dev/gpiochip0:17 or the kernel's name of the line: GPIO17
    bool active_low = false;  ///< 0 V is 1
    GpioBias bias = GpioBias::as_is;
};

struct FoundLine {
    std::string place{};    ///< /dev/gpiochip0:17, however the line was named
    std::string problem{};  ///< or why it is not to be found, one line
};
FoundLine find_line(const std::string& where);

class ChipRequest;

/// Lines of one or more chips, as bits.
class GpioBits {
  public:
    GpioBits();
    ~GpioBits();
    GpioBits(const GpioBits&) = delete;
    GpioBits& operator=(const GpioBits&) = delete;

    struct Wanted {
        std::span<const std::optional<GpioLine>> lines;  ///< at most 8; bit 0 first
        std::string consumer;                            ///< who has them, for `gpioinfo`
        std::optional<std::uint8_t> outputs{};           ///< the first levels of outputs; inputs without
    };
    /// Lets go what it held. Empty when all were had; else one line that says which was not, and why. Then
    /// none is held.
    std::string take(const Wanted& wanted);

    /// A bit whose line is not wanted is 0. Nothing if a chip is gone.
    std::optional<std::uint8_t> levels();
    bool set(std::uint8_t levels);

    /// Readable while an edge waits.
    std::vector<int> descriptors() const;
    /// Takes the edges that wait at one of them, counted from 0, which must be readable. Answers `before`
    /// with the levels that they led to; nothing if that cannot be told from them, and then `levels` tells.
    std::optional<std::uint8_t> take_edges(std::size_t descriptor, std::uint8_t before);

  private:
    struct Part;
    static Part& part_of(std::vector<Part>& parts, const std::string& chip, const std::string& consumer);
    std::vector<Part> parts_;
};

/// Inputs, as they were when they were looked at last. A chip that is gone reads 0, and `lost` from then on.
class GpioInputs final : public ports::DigitalInputs {
  public:
    explicit GpioInputs(GpioBits& bits) : bits_(bits) { look(); }
    /// At all lines.
    void look();
    /// At those whose edges wait at this descriptor of the bits, which must be readable.
    void look_at(std::size_t descriptor);
    std::uint8_t read() override { return levels_; }
    bool lost() const { return lost_; }

  private:
    GpioBits& bits_;
    std::uint8_t levels_ = 0;
    bool lost_ = false;
};

/// Outputs. The last levels are `safe` when it is destroyed.
class GpioOutputs final : public ports::DigitalOutputs {
  public:
    GpioOutputs(GpioBits& bits, std::uint8_t safe) : bits_(bits), safe_(safe) {}
    ~GpioOutputs() { write(safe_); }
    GpioOutputs(const GpioOutputs&) = delete;
    GpioOutputs& operator=(const GpioOutputs&) = delete;
    void set_safe(std::uint8_t levels) { safe_ = levels; }
    void write(std::uint8_t levels) override { lost_ = !bits_.set(levels) || lost_; }
    bool lost() const { return lost_; }

  private:
    GpioBits& bits_;
    std::uint8_t safe_;
    bool lost_ = false;
};

}  // namespace nplc::hal_linux
