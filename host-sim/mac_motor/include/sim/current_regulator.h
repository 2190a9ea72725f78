#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sim/bounds.h"
#include "sim/motor_memory.h"

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

/// The motor's inner loop (001 §4.3): commutation, and per phase filter IB on the measured current, filter IF
/// on the error, with the motor's registers as coefficients. In the registers' units: currents 1023 at the
/// end of the measuring range, voltages 1023 at the whole supply, angles 2048 a turn of the field.
class CurrentRegulator {
  public:
    struct Settings {
        Phases kifx2, kifx1, kify1, kify0, kib1, kib0;  ///< each the same three times
        double amplitude = 0;
        std::int64_t phase_comp_256 = 0;
        Phases gain{1, 1, 1};  ///< KIA, KIB, KIC
        Phases offset;
        bool third_is_rest = false;  ///< MAC800 measures two currents
    };
    static constexpr std::int32_t kRange = 1023;
    static constexpr std::int32_t kTurn = SineTable::kTurn;

    void use(const Settings& settings) { s_ = settings; }
    void reset();

    /// Currents as the converters give them, whole, without offset.
    void measure(Phases converted) {
        const Phases scaled = (converted + s_.offset) * s_.gain;
        const bool inside = scaled.inside(kRange - 1);
        measured_ = (inside ? scaled : scaled.clamped(-kRange, kRange)).nearest();
        if (s_.third_is_rest) {
            const double rest = within(-measured_.a() - measured_.b(), kRange);
            measured_ = {measured_.a(), measured_.b(), rest};
        } else if (inside) {
            return;
        }
        at_the_end_ |= !measured_.inside(kRange - 1);
    }
    /// A field of `torque` (with its sign) across the rotor at `eldeg`, which goes on by `v_eldeg` a sample.
    void commutate(std::int32_t torque, std::int32_t eldeg, std::int32_t v_eldeg) {
        const std::int64_t ahead = (v_eldeg * s_.phase_comp_256 + 128) >> 8;  // 001 §3.2.126
        const auto lead = static_cast<std::int32_t>(std::clamp(ahead, -kLargest, kLargest));
        const std::int32_t half_turn = torque < 0 ? kTurn / 2 : 0;
        aim(torque < 0 ? -torque : torque, eldeg + lead + half_turn);
    }
    /// A field of `i_nom` at `angle`.
    void aim(std::int32_t i_nom, std::int32_t angle) {
        i_nom_ = i_nom;
        phi_ = angle & (kTurn - 1);
        const double amplitude = i_nom * s_.amplitude;
        wanted_ = kSine.phases(phi_, amplitude);
        if (std::abs(amplitude) > kLargest) wanted_ = wanted_.within(kLargest);
        wanted_ = wanted_.nearest();
    }
    /// Regulates what was measured to what was asked for; the answer is in `voltage`.
    void regulate() {
        const Phases error = wanted_ - (measured_ * s_.kib1 + measured_before_ * s_.kib0);
        const Phases kept = error_before_ * s_.kifx1 + output_ * s_.kify1 + output_before_ * s_.kify0;
        const Phases output = (error * s_.kifx2 + kept).within(kRange);  // so that it cannot wind up
        measured_before_ = measured_;
        error_before_ = error;
        output_before_ = output_;
        output_ = output;
        voltage_ = output.nearest();
    }
    /// No regulation: these voltages, and filters that have forgotten.
    void apply(const PerPhase<std::int32_t>& voltage);

    Phases wanted() const { return wanted_; }      ///< IA_SOLL ..., whole
    Phases measured() const { return measured_; }  ///< IA_IST ...
    Phases voltage() const { return voltage_; }    ///< UA_VAL ...
    std::int32_t i_nom() const { return i_nom_; }
    std::int32_t phi_soll() const { return phi_; }
    /// A current was at the end of its measuring range since this was cleared.
    bool at_the_end() const { return at_the_end_; }
    void clear_at_the_end() { at_the_end_ = false; }

  private:
    static constexpr std::int64_t kLargest = 32767;

    Settings s_;
    Phases wanted_;
    Phases measured_;
    Phases voltage_;
    Phases measured_before_;
    Phases error_before_;
    Phases output_;
    Phases output_before_;
    std::int32_t i_nom_ = 0;
    std::int32_t phi_ = 0;
    bool at_the_end_ = false;
};

/// The loop as the registers have it.
CurrentRegulator::Settings current_settings(const MotorMemory& memory);

}  // namespace nplc::sim
