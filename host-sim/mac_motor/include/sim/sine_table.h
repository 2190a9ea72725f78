#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/phases.h"

namespace nplc::sim {

/// A turn of the field in the registers' 2048 steps. Computed when compiled, by additions and
/// multiplications: the same on every machine.
class SineTable {
  public:
    static constexpr std::int32_t kTurn = 2048;

    constexpr SineTable() {
        constexpr double kPi = 3.14159265358979323846;
        for (std::int32_t i = 0; i <= kQuarter; ++i) {
            const double angle = 2 * kPi * i / kTurn;
            double term = angle;
            double sum = angle;
            for (int n = 1; n <= 10; ++n) {
                term *= -angle * angle / ((2 * n) * (2 * n + 1));
                sum += term;
            }
            at(i) = at(2 * kQuarter - i) = sum;
            at(2 * kQuarter + i) = at(kTurn - i) = -sum;
        }
        at(0) = at(2 * kQuarter) = at(kTurn) = 0;
        for (std::int32_t i = 0; i <= kQuarter; ++i) at(kTurn + i) = at(i);
    }

    /// `amplitude` times the sines of `step`, 0 to 2047, and of 120 and 240 degrees more.
    Phases phases(std::int32_t step, double amplitude = 1) const {
        constexpr double kSine120 = 0.86602540378443864676;
        const double sine = values_[static_cast<std::size_t>(step)];
        const double half = sine * (0.5 * amplitude);
        const double third = values_[static_cast<std::size_t>(step + kQuarter)] * (kSine120 * amplitude);
        return {sine * amplitude, third - half, -third - half};
    }

  private:
    static constexpr std::int32_t kQuarter = kTurn / 4;

    constexpr double& at(std::int32_t step) { return values_[static_cast<std::size_t>(step)]; }

    std::array<double, kTurn + kQuarter + 1> values_{};
};

inline constexpr SineTable kSine{};

}  // namespace nplc::sim
