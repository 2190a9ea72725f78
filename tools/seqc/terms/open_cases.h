#pragma once

#include <cstdint>
#include <vector>

#include "terms/half.h"
#include "terms/order_plan.h"

namespace nplc::seqc {

/// What is still open in a case, a bit for each next step, output byte, timer value and counter value.
using OpenBits = std::uint64_t;

inline bool at_most_one(OpenBits bits) {
    return (bits & (bits - 1)) == 0;
}

/// A term as the search places it, from the last term of the table to the first.
struct PlacedTerm {
    Region region;
    const OrderTerm* order = nullptr;  ///< in the plan; none: it sends nothing
    std::uint8_t next = 0;
    std::uint8_t output_byte = 0;
    Preset preset = Preset::none;
    std::uint16_t value = 0;
    bool names_next = true;
};

/// Which bit of OpenBits stands for what in one half.
class OpenLayout {
  public:
    explicit OpenLayout(const Half& half);

    bool fits() const { return fits_; }
    OpenBits wanted(std::size_t behaviour) const { return wanted_[behaviour]; }
    /// The part of `wanted` without which the case is wrong.
    OpenBits demanded(std::size_t behaviour) const { return demanded_[behaviour]; }

    OpenBits nexts = 0;
    OpenBits outputs = 0;
    OpenBits timers = 0;
    OpenBits counters = 0;
    OpenBits no_timer = 0;  ///< set in cases that want no timer preset, and never cleared
    OpenBits no_counter = 0;

  private:
    template <class T>
    OpenBits bit_for(std::vector<T>& seen, std::vector<OpenBits>& bits, T value, OpenBits& group);

    bool fits_ = true;
    unsigned used_ = 0;
    std::vector<OpenBits> wanted_;
    std::vector<OpenBits> demanded_;
};

}  // namespace nplc::seqc
