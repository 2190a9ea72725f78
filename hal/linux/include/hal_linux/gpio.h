#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ports/digital_io.h"

/// Inputs and outputs on lines of the kernel's GPIO chips, by libgpiod 1.6 or 2. A line is held from `take`
/// on, outputs with their first level from that moment. When a program ends in any way, the kernel releases
/// its lines, and their level then depends on the driver: some hold the last one, others make the line an
/// input. So a line that moves something needs a resistor that pulls it to its safe level. A chip without
/// bias ignores a request for one without an error.
namespace nplc::hal_linux {

enum class GpioBias : std::uint8_t { as_is, off, pull_up, pull_down };

struct GpioLine {
    std::string where;        ///< gpiochip0:17, /dev/gpiochip0:17 or the kernel's name of the line: GPIO17
    bool active_low = false;  ///< 0 V is 1
    GpioBias bias = GpioBias::as_is;
};

struct FoundLine {
    std::string place{};    ///< /dev/gpiochip0:17, however the line was named
    std::string problem{};  ///< or why it was not found, one line
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
        std::string consumer;                            ///< user of the lines, for `gpioinfo`
        std::optional<std::uint8_t> outputs{};           ///< initial levels of outputs; empty for inputs
    };
    /// Releases the lines held before. Empty on success; else one line with the failed line and the reason,
    /// and no line is held.
    std::string take(const Wanted& wanted);

    /// Bits without a line are 0. Empty if a chip is lost.
    std::optional<std::uint8_t> levels();
    bool set(std::uint8_t levels);

    /// Readable while an edge is pending.
    std::vector<int> descriptors() const;
    /// Takes the pending edges at one of them, counted from 0, which must be readable. Returns `before` with
    /// the levels after the edges; empty if they do not determine the levels, which `levels` then reads.
    std::optional<std::uint8_t> take_edges(std::size_t descriptor, std::uint8_t before);

  private:
    struct Part;
    static Part& part_of(std::vector<Part>& parts, const std::string& chip, const std::string& consumer);
    std::vector<Part> parts_;
};

/// Inputs, as of the last look. A lost chip reads 0, with `lost` from then on.
class GpioInputs final : public ports::DigitalInputs {
  public:
    explicit GpioInputs(GpioBits& bits) : bits_(bits) { look(); }
    /// Reads all lines.
    void look();
    /// Reads the lines with pending edges at this descriptor, which must be readable.
    void look_at(std::size_t descriptor);
    std::uint8_t read() override { return levels_; }
    bool lost() const { return lost_; }

  private:
    GpioBits& bits_;
    std::uint8_t levels_ = 0;
    bool lost_ = false;
};

/// Outputs. The destructor sets the levels `safe`.
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
