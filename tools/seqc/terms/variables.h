#pragma once

#include <bitset>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "terms/cover.h"

namespace nplc::seqc {

/// The variables on which some sets of points depend. A set over them only has its points at the low numbers.
class Variables {
  public:
    explicit Variables(std::initializer_list<const Points*> sets);

    std::size_t count() const { return bits_.size(); }
    Points narrowed(const Points& set) const;
    Cube widened(Cube cube) const;

  private:
    std::uint8_t spread(std::size_t low) const;
    std::vector<std::uint8_t> bits_;
};

}  // namespace nplc::seqc
