#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace nplc::seqc {

/// All cubes over some variables, narrow ones before the wider ones that hold them. The index is a number in
/// base three with a digit for each variable: 0, 1, or 2 for open.
class Ternary {
  public:
    static constexpr std::size_t kMostVariables = 7;
    struct Entry {
        std::uint8_t value = 0;
        std::uint8_t care = 0;
        bool is_point = false;
        std::uint16_t low = 0;  ///< halves of a cube that is no point
        std::uint16_t high = 0;
    };

    static const Ternary& of(std::size_t variables);

    std::size_t variables() const { return steps_.size(); }
    std::size_t size() const { return entries_.size(); }
    const Entry& operator[](std::size_t index) const { return entries_[index]; }
    /// The cube without its test of `variable`, which it has.
    std::size_t without(std::size_t index, std::size_t variable) const {
        const bool one = ((entries_[index].value >> variable) & 1U) != 0;
        return index + (one ? 1U : 2U) * steps_[variable];
    }

    /// The half of the cube, in which `variable` is open, where it is `one`.
    std::size_t half(std::size_t index, std::size_t variable, bool one) const {
        return index - (one ? 1U : 2U) * steps_[variable];
    }

    explicit Ternary(std::size_t variables);

  private:
    std::vector<std::size_t> steps_;  // 3 to the power of the variable's number
    std::vector<Entry> entries_;
};

}  // namespace nplc::seqc
