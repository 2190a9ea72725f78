#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal_linux/gpio.h"

/// What differs between the two generations of libgpiod: lines of one chip. Bits are in the order of the
/// lines.
namespace nplc::hal_linux {

constexpr std::size_t kMostLines = 8;     ///< of one request
constexpr std::size_t kEdgesAtOnce = 16;  ///< that the kernel keeps of a line

struct ChipLine {
    unsigned offset;
    bool active_low;
    GpioBias bias;
};

/// What the edges at one descriptor say of their lines.
struct Edges {
    unsigned lines = 0;   ///< those that had one
    unsigned levels = 0;  ///< of these lines, after their last
    bool all = false;     ///< no later one may be missing
};

class ChipRequest {
  public:
    virtual ~ChipRequest() = default;
    virtual std::optional<unsigned> levels() = 0;
    virtual bool set(unsigned levels) = 0;
    virtual std::vector<int> descriptors() const = 0;
    /// Takes what waits at one of descriptors(), which must be readable.
    virtual Edges take_edges(std::size_t descriptor) = 0;
};

struct ChipWanted {
    std::string chip;  ///< /dev/gpiochip0
    std::vector<ChipLine> lines;
    std::string consumer;
    std::optional<unsigned> outputs;  ///< their first levels; inputs with edges without
};

struct ChipRequested {
    std::unique_ptr<ChipRequest> request;
    int error;             ///< errno, without a request
    std::size_t line = 0;  ///< which one, where that is known
};
ChipRequested request_lines(const ChipWanted& wanted);

struct LineInfo {
    std::string name;
    bool used;
    std::string consumer;  ///< who uses it
};
/// Of the lines of a chip. None if it cannot be opened; `error` is errno.
std::vector<LineInfo> lines_of(const std::string& path, int& error);

}  // namespace nplc::hal_linux
