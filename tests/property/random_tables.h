#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace nplc::property {

/// std::mt19937_64 with plain modulo: the same numbers on every machine.
class Dice {
  public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    unsigned below(unsigned limit) { return static_cast<unsigned>(engine_() % limit); }
    std::uint8_t byte() { return static_cast<std::uint8_t>(engine_()); }
    bool one_in(unsigned n) { return below(n) == 0; }

  private:
    std::mt19937_64 engine_;
};

enum class Shape {
    uniform,    ///< any bytes a table may have, all 63 steps
    dense,      ///< few steps, few compared bits: nearly every scan does something
    scattered,  ///< dense, the terms of a step far apart, mixed with those of steps never reached
    many_true,  ///< nearly all terms of a step true at once
    arbitrary,  ///< any bytes at all, most of them no table
};

std::vector<std::uint8_t> random_table(Shape shape, Dice& dice);

}  // namespace nplc::property
