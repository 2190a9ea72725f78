#include "shaft.h"

#include <algorithm>
#include <cmath>

namespace nplc::macreg {
namespace {

class Motion {
  public:
    Motion(const Shaft& shaft, const Start& start)
        : shaft_(shaft), position_(start.position), velocity_(start.velocity) {}

    double position() const { return position_; }
    void rest() { velocity_ = 0; }
    void rest_at(double position) {
        position_ = position;
        velocity_ = 0;
    }
    void correct(double position, double velocity) {
        position_ += position;
        velocity_ += velocity;
    }

    /// `torque` for `time`.
    void go(double torque, double time) {
        const double pull = torque + shaft_.load;
        for (int turns = 0; time > 0 && turns < 3; ++turns) {
            if (velocity_ == 0 && std::abs(pull) <= shaft_.coulomb) return;
            const double sign = velocity_ != 0 ? (velocity_ > 0 ? 1 : -1) : (pull > 0 ? 1 : -1);
            const double start = (pull - sign * shaft_.coulomb - shaft_.viscous * velocity_) / shaft_.inertia;
            const double decay = shaft_.viscous / shaft_.inertia;
            const double rest = time_to_rest(start, decay, time);
            const bool stops = velocity_ != 0 && rest < time;
            move(start, decay, stops ? rest : time);
            if (!stops) return;
            velocity_ = 0;
            time -= rest;
        }
    }

  private:
    /// v + a (t - d t^2 / 2) = 0
    double time_to_rest(double start, double decay, double limit) const {
        if (start * velocity_ >= 0) return limit;
        const double plain = -velocity_ / start;
        return plain < limit ? std::min(plain * (1 + decay * plain / 2), limit) : limit;
    }
    void move(double start, double decay, double time) {
        const double x = decay * time;
        position_ += velocity_ * time + start * time * time / 2 * (1 - x / 3 + x * x / 12);
        velocity_ += start * time * (1 - x / 2 + x * x / 6);
    }

    const Shaft& shaft_;
    double position_;
    double velocity_;
};

/// Steps through the samples and calls `after` for each.
template <class After>
void follow(Motion& motion, const Shaft& shaft, const Ripple& ripple, const Series& series, After after) {
    const double whole = std::floor(shaft.dead_time);
    const double part = shaft.dead_time - whole;
    const auto late = static_cast<std::ptrdiff_t>(whole) + 1;  // requested at the end of a sample
    const auto last = static_cast<std::ptrdiff_t>(series.size()) - 1;
    const auto asked = [&](std::ptrdiff_t i) {
        return series.torque[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
    };
    after(0);
    for (std::ptrdiff_t i = 1; i <= last; ++i) {
        const auto sample = static_cast<std::size_t>(i);
        const double round = ripple.sine * series.sine[sample] + ripple.cosine * series.cosine[sample];
        motion.go(asked(i - late - 1) + round, part);
        motion.go(asked(i - late) + round, 1 - part);
        after(sample);
    }
}

}  // namespace

std::vector<double> positions_of(const Shaft& shaft, const Start& start, const Series& series) {
    Motion motion(shaft, start);
    std::vector<double> positions(series.size());
    follow(motion, shaft, start.ripple, series, [&](std::size_t i) {
        if (series.at_rest[i] != 0) motion.rest();
        positions[i] = motion.position();
    });
    return positions;
}

std::vector<double> errors_of(const Shaft& shaft, const Start& start, const Gains& gains,
                              const Series& series) {
    Motion motion(shaft, start);
    std::vector<double> errors(series.size());
    follow(motion, shaft, start.ripple, series, [&](std::size_t i) {
        if (series.at_rest[i] != 0) return motion.rest_at(series.counts[i]);
        errors[i] = series.counts[i] - motion.position();
        motion.correct(gains.position * errors[i], gains.velocity * errors[i]);
    });
    return errors;
}

}  // namespace nplc::macreg
