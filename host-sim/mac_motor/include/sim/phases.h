#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sim/bounds.h"

namespace nplc::sim {

inline constexpr std::size_t kPhases = 3;
/// Phases A, B and C.
template <class T>
using PerPhase = std::array<T, kPhases>;

/// A number of each phase, computed with as one. A and B share a register of the processor: the same results
/// as of three doubles, in fewer instructions.
class Phases {
  public:
    Phases() = default;
    Phases(double a, double b, double c) : ab_{a, b}, c_(c) {}
    explicit Phases(double all) : Phases(all, all, all) {}
    explicit Phases(const PerPhase<std::int32_t>& p)
        : Phases(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])) {}
    explicit Phases(const PerPhase<double>& p) : Phases(p[0], p[1], p[2]) {}

    double a() const { return ab_[0]; }
    double b() const { return ab_[1]; }
    double c() const { return c_; }
    double sum() const { return ab_[0] + ab_[1] + c_; }
    PerPhase<std::int32_t> integers() const { return {integer(ab_[0]), integer(ab_[1]), integer(c_)}; }

    /// As `nearest` of bounds.h.
    Phases nearest() const { return (*this + kNoFraction) - kNoFraction; }
    bool inside(double limit) const {
        const bool all = std::abs(a()) <= limit && std::abs(b()) <= limit && std::abs(c_) <= limit;
        return __builtin_expect_with_probability(all, 1, 0.999);
    }
    Phases clamped(double low, double high) const {
        const auto one = [&](double value) { return std::clamp(value, low, high); };
        return {one(a()), one(b()), one(c_)};
    }
    /// As `within` of bounds.h.
    Phases within(double limit) const { return inside(limit) ? *this : clamped(-limit, limit); }

    friend Phases operator+(Phases x, Phases y) { return {x.ab_ + y.ab_, x.c_ + y.c_}; }
    friend Phases operator-(Phases x, Phases y) { return {x.ab_ - y.ab_, x.c_ - y.c_}; }
    friend Phases operator*(Phases x, Phases y) { return {x.ab_ * y.ab_, x.c_ * y.c_}; }
    friend Phases operator+(Phases x, double y) { return {x.ab_ + y, x.c_ + y}; }
    friend Phases operator-(Phases x, double y) { return {x.ab_ - y, x.c_ - y}; }
    friend Phases operator*(Phases x, double y) { return {x.ab_ * y, x.c_ * y}; }

  private:
    using Pair [[gnu::vector_size(16)]] = double;

    Phases(Pair ab, double c) : ab_(ab), c_(c) {}
    static std::int32_t integer(double value) { return static_cast<std::int32_t>(value); }

    Pair ab_{};
    double c_ = 0;
};

}  // namespace nplc::sim
