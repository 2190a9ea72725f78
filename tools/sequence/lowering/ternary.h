#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "lowering/cover.h"

namespace nplc::seqc {

/// A bit set of cases over at most five variables.
using SmallSet = std::uint32_t;

/// All cubes over some variables, smaller ones before the larger ones that contain them. The index is a
/// ternary number with one digit per variable: 0, 1, or 2 for don't care.
class Ternary {
  public:
    static constexpr std::size_t kMostVariables = kBits;
    static constexpr std::size_t kMostSorted = 7;
    static constexpr std::size_t kMostSmall = 5;  ///< variables, for `cases` and `around`

    /// The last `zeros` variables may be the zero flags of timer and counter: no term can test for "not
    /// zero", so `largest_first` and `around` have no cube in which one of them is 0.
    static const Ternary& of(std::size_t variables, std::size_t zeros = 0);

    std::size_t variables() const { return steps_.size(); }
    std::size_t size() const { return cubes_.size(); }
    const Product& operator[](std::size_t index) const { return cubes_[index]; }
    /// The cube of a single point, by the point's number.
    std::size_t point(std::size_t number) const { return points_[number]; }
    /// By number of variables required, then by which, then by their values. Empty over more than kMostSorted
    /// variables, which the conditions of terms do not have.
    const std::vector<std::uint16_t>& largest_first() const { return largest_first_; }

    SmallSet cases(std::size_t index) const { return cases_[index]; }
    /// The smallest cube that contains `cases`, which must not be empty.
    std::size_t around(SmallSet cases) const;

    /// Extends `by_cube` from the points to all cubes: each cube gets the union (|) of its points.
    template <class T>
    void unite(T* by_cube) const {
        for (const Block& block : blocks_) {
            T* both = by_cube + block.begin;
            const T* low = both - 2 * block.length;
            const T* high = both - block.length;
            for (std::size_t i = 0; i < block.length; ++i) both[i] = static_cast<T>(low[i] | high[i]);
        }
    }

    /// Removes from each cube's bits in `by_cube` those that `given` has for a cube larger by one variable.
    template <class T>
    void remove_wider(const T* given, T* by_cube) const {
        for (const std::size_t step : steps_) {
            for (std::size_t begin = 0; begin < cubes_.size(); begin += 3 * step) {
                for (std::size_t i = begin; i < begin + step; ++i) {
                    const auto kept = static_cast<T>(~given[i + 2 * step]);
                    by_cube[i] = static_cast<T>(by_cube[i] & kept);
                    by_cube[i + step] = static_cast<T>(by_cube[i + step] & kept);
                }
            }
        }
    }

    /// The half of the cube, in which `variable` is don't care, where it is `one`.
    std::size_t half(std::size_t index, std::size_t variable, bool one) const {
        return index - (one ? 1U : 2U) * steps_[variable];
    }

    Ternary(std::size_t variables, std::size_t zeros);

  private:
    void sort_by_size();

    struct Block {  // consecutive cubes with the same highest don't-care variable
        std::size_t begin;
        std::size_t length;
    };
    std::size_t inputs_;  // the variables that are not zero flags
    std::vector<Block> blocks_;
    std::vector<std::size_t> points_;
    std::vector<std::size_t> steps_;  // 3 to the power of the variable's number
    std::vector<Product> cubes_;
    std::vector<std::uint16_t> largest_first_;
    std::vector<SmallSet> cases_;
};

/// The variables on which some sets of points depend. A set over these variables uses the low point numbers
/// only.
template <std::size_t kSize>
class Variables {
  public:
    using Set = std::bitset<kSize>;
    explicit Variables(std::initializer_list<const Set*> sets);

    std::size_t count() const { return bits_.size(); }
    Set narrowed(const Set& set) const;
    Product widened(Product cube) const { return {spread(cube.value), spread(cube.care)}; }

  private:
    std::uint16_t spread(std::size_t low) const;
    std::vector<std::uint8_t> bits_;
};

}  // namespace nplc::seqc
