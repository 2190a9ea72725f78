#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nplc::seqc {

/// A bit set of cases over at most five variables.
using SmallSet = std::uint32_t;

/// All cubes over up to five variables. The last ones may be the zero flags of timer and counter: no term can
/// test for "not zero".
class SmallCubes {
  public:
    static constexpr std::size_t kMostVariables = 5;
    struct Entry {
        SmallSet cases = 0;
        std::uint8_t value = 0;
        std::uint8_t care = 0;
        std::uint8_t wider_count = 0;
        std::array<std::uint8_t, kMostVariables> wider{};  ///< those with one variable less
    };

    static const SmallCubes& of(std::size_t variables, std::size_t zeros);

    /// Largest first.
    const std::vector<Entry>& list() const { return list_; }
    SmallSet all() const { return list_.front().cases; }
    /// The smallest cube that contains `cases`, which must not be empty.
    const Entry& around(SmallSet cases) const { return list_[index_around(cases)]; }
    std::size_t index_around(SmallSet cases) const;

    SmallCubes(std::size_t variables, std::size_t zeros);

  private:
    std::size_t variables_;
    std::size_t inputs_;
    std::vector<Entry> list_;
    std::array<std::uint8_t, std::size_t{1} << (2 * kMostVariables)> index_{};  // by value and care
};

struct ListedCube {
    const SmallCubes::Entry* cube = nullptr;
    bool in = false;
};

/// Minimum list of cubes in which the last one that contains a case decides whether it is in `set`; a case in
/// none is out. Exact up to a search limit. Empty if there is none of fewer than `fewer_than`.
std::vector<ListedCube> least_list(SmallSet set, const SmallCubes& cubes, std::size_t fewer_than);

/// Minimum partition of `set` into cubes. Exact. Empty if there is none of fewer than `fewer_than`. `cubes`
/// must be without zero flags.
std::vector<const SmallCubes::Entry*> least_partition(SmallSet set, const SmallCubes& cubes,
                                                      std::size_t fewer_than);

}  // namespace nplc::seqc
