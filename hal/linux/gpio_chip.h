#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal_linux/gpio.h"

/// The interface to both generations of libgpiod: lines of one chip. Bits are in the order of the lines.
namespace nplc::hal_linux {

constexpr std::size_t kMostLines = 8;     ///< per request
constexpr std::size_t kEdgesAtOnce = 16;  ///< buffered by the kernel per line

struct ChipLine {
    unsigned offset;
    bool active_low;
    GpioBias bias;
};

/// The pending edges at one descriptor.
struct Edges {
    unsigned lines = 0;   ///< lines with an edge
    unsigned levels = 0;  ///< level of these lines after their last edge
    bool all = false;     ///< no later edge can be missing
};

class ChipRequest {
  public:
    virtual ~ChipRequest() = default;
    virtual std::optional<unsigned> levels() = 0;
    virtual bool set(unsigned levels) = 0;
    virtual std::vector<int> descriptors() const = 0;
    /// Takes the pending edges at one of descriptors(), which must be readable.
    virtual Edges take_edges(std::size_t descriptor) = 0;
};

struct ChipWanted {
    std::string chip;  ///< /dev/gpiochip0
    std::vector<ChipLine> lines;
    std::string consumer;
    std::optional<unsigned> outputs;  ///< initial levels of outputs; empty for inputs with edges
};

struct ChipRequested {
    std::unique_ptr<ChipRequest> request;
    int error;             ///< errno, without a request
    std::size_t line = 0;  ///< the line with the error, if known
};
ChipRequested request_lines(const ChipWanted& wanted);

struct LineInfo {
    std::string name;
    bool used;
    std::string consumer;  ///< consumer of the line
};
/// The lines of a chip. Empty if it cannot be opened, with errno in `error`.
std::vector<LineInfo> lines_of(const std::string& path, int& error);

}  // namespace nplc::hal_linux
