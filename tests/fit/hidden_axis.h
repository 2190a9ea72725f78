#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "macreg/recording.h"
#include "registers/mac.h"

namespace nplc::macreg::hidden {

/// An axis as an experimenter has one: its values are known to the test alone. Torques in units of VF_OUT,
/// counts, samples. Integrated in 200 small steps a sample, with a controller of its own.
struct Axis {
    double inertia = 4.68;
    double coulomb = 20;
    double viscous = 0.05;
    double load = 0;
    double dead_time = 0.5;  ///< a multiple of 0.005
    double jitter = 0.3;     ///< counts, of the encoder
    double ripple = 0.7;     ///< of the torque, another in each sample
};

struct Step {
    std::size_t sample;
    double target;  ///< counts
    double speed;   ///< counts/sample
    double acceleration = 6;
};

class Bench {
  public:
    Bench(const Axis& axis, std::uint64_t seed) : axis_(axis), chance_(seed) {}

    /// `moves` one after the other; the samples from the first on.
    Recording record(const std::vector<Step>& moves, std::size_t samples = 895, bool with_velocity = false) {
        Recording out;
        out.model = "MAC140";
        out.address = 8;
        const registers::Model model = registers::Model::mac140;
        out.rate_hz = registers::scale_of(model).samples_per_second;
        out.start = "now";
        const registers::Register& p = *registers::find(model, "P_IST");
        const registers::Register& v = *registers::find(model, "V_IST");
        const registers::Register& t = *registers::find(model, "VF_OUT");
        out.columns = {column_of(p), column_of(t)};
        if (with_velocity) out.columns.push_back(column_of(v));
        for (std::size_t i = 0; i < samples; ++i) {
            for (const Step& move : moves)
                if (move.sample == i) goal_ = move;
            sample();
            out.time_s.push_back(static_cast<double>(i) / out.rate_hz);
            out.columns[0].values.push_back(shown_value(p, model, counts_));
            out.columns[1].values.push_back(shown_value(t, model, asked_));
            if (with_velocity) out.columns[2].values.push_back(shown_value(v, model, counts_ - before_));
        }
        return out;
    }

  private:
    static constexpr int kSmall = 200;

    void sample() {
        const double ripple = std::normal_distribution<double>(0, axis_.ripple)(chance_);
        for (int n = 0; n < kSmall; ++n) {
            line_.push_back(static_cast<double>(asked_));
            const auto late = static_cast<std::size_t>(std::lround(axis_.dead_time * kSmall));
            const double torque = line_.size() > late ? line_[line_.size() - 1 - late] : 0;
            push(torque + ripple + axis_.load);
        }
        if (line_.size() > 8 * kSmall) line_.erase(line_.begin(), line_.end() - 8 * kSmall);
        before_ = counts_;
        counts_ = static_cast<std::int64_t>(
            std::floor(position_ + std::normal_distribution<double>(0, axis_.jitter)(chance_)));
        control();
    }

    /// Friction as a bound: it takes what moves the shaft, up to its size.
    void push(double torque) {
        constexpr double kTime = 1.0 / kSmall;
        const double drag = axis_.viscous / axis_.inertia * kTime / 2;
        double next = velocity_ * (1 - drag) + torque / axis_.inertia * kTime;
        const double rub = axis_.coulomb / axis_.inertia * kTime;
        next = next > rub ? next - rub : next < -rub ? next + rub : 0;
        next /= 1 + drag;
        position_ += (velocity_ + next) / 2 * kTime;
        velocity_ = next;
    }

    void control() {
        const double way = goal_.target - profile_;
        const double stop = std::sqrt(2 * goal_.acceleration * std::abs(way));
        const double wanted = std::clamp(way, -std::min(goal_.speed, stop), std::min(goal_.speed, stop));
        profile_speed_ += std::clamp(wanted - profile_speed_, -goal_.acceleration, goal_.acceleration);
        profile_ += profile_speed_;
        const double speed = static_cast<double>(counts_ - before_);
        const double miss = profile_speed_ + 0.02 * (profile_ - static_cast<double>(counts_)) - speed;
        sum_ += miss;
        const double torque = axis_.inertia * (0.12 * miss + 0.004 * sum_);
        asked_ = std::lround(std::clamp(torque, -1023.0, 1023.0));
    }

    Axis axis_;
    std::mt19937_64 chance_;
    Step goal_{0, 0, 1};
    std::vector<double> line_;
    double position_ = 0.5;
    double velocity_ = 0;
    std::int64_t counts_ = 0;
    std::int64_t before_ = 0;
    std::int64_t asked_ = 0;
    double profile_ = 0;
    double profile_speed_ = 0;
    double sum_ = 0;
};

}  // namespace nplc::macreg::hidden
