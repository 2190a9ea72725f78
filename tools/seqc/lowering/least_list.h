#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nplc::seqc {

/// Cases over at most five variables, a bit each.
using SmallSet = std::uint32_t;

/// All cubes over up to five variables. The last of these may be zeros of timer and counter: no term tests
/// that one has not come.
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

    /// Wide ones first.
    const std::vector<Entry>& list() const { return list_; }
    SmallSet all() const { return list_.front().cases; }
    /// The smallest cube that holds `cases`, of which there must be one.
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

/// Fewest cubes in a list of which the last that holds a case says whether it is in `set`; a case that none
/// holds is out. Exact up to a bound on the search. Empty if there is none of fewer than `fewer_than`.
std::vector<ListedCube> least_list(SmallSet set, const SmallCubes& cubes, std::size_t fewer_than);

/// Fewest cubes that hold each case of `set` once and no other. Exact. Empty if there are none of fewer than
/// `fewer_than`. `cubes` without zeros.
std::vector<const SmallCubes::Entry*> least_partition(SmallSet set, const SmallCubes& cubes,
                                                      std::size_t fewer_than);

}  // namespace nplc::seqc
