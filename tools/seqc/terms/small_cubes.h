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

}  // namespace nplc::seqc
