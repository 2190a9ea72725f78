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

struct ChipLine {
    unsigned offset;
    bool active_low;
    GpioBias bias;
};

class ChipRequest {
  public:
    virtual ~ChipRequest() = default;
    virtual std::optional<unsigned> levels() = 0;
    virtual bool set(unsigned levels) = 0;
    virtual std::vector<int> descriptors() const = 0;
    virtual void take_edges() = 0;
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

struct FoundLine {
    std::string chip;
    unsigned offset;
};
/// Of all chips the first that has a line of this name.
std::optional<FoundLine> find_line(const std::string& name);

/// 0 if there is no such chip; `error` is errno.
unsigned lines_of(const std::string& chip, int& error);

}  // namespace nplc::hal_linux
