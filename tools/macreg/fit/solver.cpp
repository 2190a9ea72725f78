#include "solver.h"

#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>
#include <utility>

namespace nplc::macreg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTorque = 10;  // scale of the torques among the unknowns
constexpr double kEarliest = -0.5;
constexpr double kLatest = 7;  // samples
constexpr Index kDeadTime = 4;
constexpr Index kGains = 5;
constexpr std::size_t kStarts = 7;

/// 0 to 1
double share(double x) {
    return 1 / (1 + std::exp(-std::clamp(x, -15.0, 15.0)));
}

double& at(VectorXd& x, std::size_t i) {
    return x(static_cast<Index>(i));
}
double at(const VectorXd& x, std::size_t i) {
    return x(static_cast<Index>(i));
}

/// Names required by Eigen's solver.
struct Functor {
    const Problem& problem;

    int inputs() const { return static_cast<int>(problem.unknowns()); }
    int values() const { return static_cast<int>(problem.samples()); }
    int operator()(const VectorXd& x, VectorXd& out) const {
        out = problem.errors(x);
        return 0;
    }
    int df(const VectorXd& x, MatrixXd& out) const {
        out = jacobian(problem, x);
        return 0;
    }
};

/// The mean torque in each sample if it comes `dead_time` samples late.
std::vector<double> shifted(const std::vector<double>& torque, double dead_time) {
    const double whole = std::floor(dead_time);
    const double part = dead_time - whole;
    const auto last = static_cast<std::ptrdiff_t>(torque.size()) - 1;
    const auto asked = [&](std::ptrdiff_t i) {
        return torque[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last))];
    };
    std::vector<double> mean(torque.size());
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        const std::ptrdiff_t from = i - 1 - static_cast<std::ptrdiff_t>(whole);
        mean[static_cast<std::size_t>(i)] = part * asked(from - 1) + (1 - part) * asked(from);
    }
    return mean;
}

/// Torque summed twice equals inertia times position, and so on: linear in all unknowns.
VectorXd guess_at(const Problem& problem, double dead_time) {
    const Index columns = 4 + 2 * static_cast<Index>(problem.all.size());
    MatrixXd a = MatrixXd::Zero(problem.samples(), columns);
    VectorXd b(problem.samples());
    Index row = 0;
    for (std::size_t s = 0; s < problem.all.size(); ++s) {
        const Series& series = problem.all[s];
        const std::vector<double> torque = shifted(series.torque, dead_time);
        const Index own = 4 + 2 * static_cast<Index>(s);
        double sum = 0, twice = 0, signs = 0, signs_twice = 0, way = 0, ones = 0, ones_twice = 0;
        for (std::size_t i = 0; i < series.size(); ++i, ++row) {
            if (i > 0 && series.at_rest[i] == 0) {
                // In its own sample a torque moves the shaft by half as much as in later ones.
                const double velocity = series.velocity(i);
                const double sign = velocity > 0.5 ? 1 : velocity < -0.5 ? -1 : 0;
                twice += sum + torque[i] / 2;
                sum += torque[i];
                signs_twice += signs + sign / 2;
                signs += sign;
                way += (series.counts[i] + series.counts[i - 1]) / 2;
                ones_twice += ones + 0.5;
                ones += 1;
            }
            b(row) = twice;
            a(row, 0) = series.counts[i];
            a(row, 1) = signs_twice;
            a(row, 2) = way;
            a(row, 3) = -ones_twice;
            a(row, own) = 1;
            a(row, own + 1) = ones;
        }
    }
    VectorXd scale = a.colwise().norm();
    for (Index i = 0; i < columns; ++i) scale(i) = scale(i) > 0 ? scale(i) : 1;
    Eigen::CompleteOrthogonalDecomposition<MatrixXd> qr;
    qr.setThreshold(1e-6);
    qr.compute(a * scale.cwiseInverse().asDiagonal());
    const VectorXd found = scale.cwiseInverse().asDiagonal() * qr.solve(b);
    const double inertia = std::max(found(0), 0.05);
    const Shaft shaft{.inertia = inertia,
                      .coulomb = std::max(found(1), 0.0),
                      .viscous = std::max(found(2), 0.0),
                      .load = found(3),
                      .dead_time = dead_time};
    std::vector<Start> starts;
    for (std::size_t s = 0; s < problem.all.size(); ++s)
        starts.push_back({-found(4 + 2 * static_cast<Index>(s)) / inertia,
                          -found(5 + 2 * static_cast<Index>(s)) / inertia});
    return problem.of(shaft, starts);
}

VectorXd solve_from(const Problem& problem, const VectorXd& x, int steps) {
    Functor functor{problem};
    VectorXd found = x;
    Eigen::LevenbergMarquardt<Functor> solver(functor);
    solver.parameters.maxfev = steps;
    solver.parameters.ftol = solver.parameters.xtol = 1e-10;
    solver.minimize(found);
    return found;
}

struct Tried {
    VectorXd x;
    double left = std::numeric_limits<double>::infinity();

    void take(const Problem& problem, VectorXd other) {
        if (!other.allFinite()) return;
        const double misfit = problem.errors(other).squaredNorm();
        if (!(misfit < left)) return;
        left = misfit;
        x = std::move(other);
    }
};

}  // namespace

Index Problem::samples() const {
    std::size_t sum = 0;
    for (const Series& series : all) sum += series.size();
    return static_cast<Index>(sum);
}

Shaft Problem::shaft_of(const VectorXd& x) const {
    return {.inertia = std::exp(std::clamp(x(0), -12.0, 12.0)),
            .coulomb = x(1) * kTorque,
            .viscous = x(2) * kTorque / fastest,
            .load = x(3) * kTorque,
            .dead_time = kEarliest + (kLatest - kEarliest) * share(x(kDeadTime))};
}

VectorXd Problem::of(const Shaft& shaft, const std::vector<Start>& starts) const {
    VectorXd x(unknowns());
    x(0) = std::log(shaft.inertia);
    x(1) = shaft.coulomb / kTorque;
    x(2) = shaft.viscous * fastest / kTorque;
    x(3) = shaft.load / kTorque;
    const double late = (shaft.dead_time - kEarliest) / (kLatest - kEarliest);
    x(kDeadTime) = std::log(late / (1 - late));
    x(kGains) = x(kGains + 1) = 0;
    for (std::size_t s = 0; s < starts.size(); ++s) {
        at(x, kStarts + 4 * s) = starts[s].position;
        at(x, kStarts + 4 * s + 1) = starts[s].velocity;
        at(x, kStarts + 4 * s + 2) = at(x, kStarts + 4 * s + 3) = 0;
    }
    return x;
}

double Problem::unit(Index parameter, const Shaft& shaft) const {
    switch (parameter) {
        case 0:
            return shaft.inertia;
        case 2:
            return kTorque / fastest;
        case kDeadTime: {
            const double late = (shaft.dead_time - kEarliest) / (kLatest - kEarliest);
            return (kLatest - kEarliest) * late * (1 - late);
        }
        default:
            return kTorque;
    }
}

Start Problem::start_of(const VectorXd& x, std::size_t series) const {
    const std::size_t own = kStarts + 4 * series;
    return {at(x, own), at(x, own + 1), {at(x, own + 2) * kTorque, at(x, own + 3) * kTorque}};
}

std::vector<double> Problem::positions(const VectorXd& x, std::size_t series) const {
    return positions_of(shaft_of(x), start_of(x, series), all[series]);
}

Gains Problem::gains_of(const VectorXd& x) const {
    return {share(x(kGains)), share(x(kGains + 1)) / 2};
}

VectorXd Problem::errors(const VectorXd& x) const {
    const Shaft shaft = shaft_of(x);
    VectorXd out(samples());
    Index row = 0;
    for (std::size_t s = 0; s < all.size(); ++s) {
        for (const double error : errors_of(shaft, start_of(x, s), gains_of(x), all[s])) out(row++) = error;
    }
    return out;
}

VectorXd solve(const Problem& problem) {
    constexpr std::array kDeadTimes{0.15, 0.6, 1.2, 2.0, 3.0, 4.5};
    // Small gains if the prediction fits, and larger ones
    constexpr std::array<std::pair<double, double>, 2> kGainsTried{{{-2, -5}, {0, -2}}};
    constexpr int kSteps = 60;
    Problem held = problem;
    held.hold = true;
    std::vector<Tried> all;
    for (const auto& [position, velocity] : kGainsTried) {
        Tried best;
        for (const double dead_time : kDeadTimes) {
            VectorXd x = guess_at(problem, dead_time);
            x(kGains) = position;
            x(kGains + 1) = velocity;
            best.take(problem, solve_from(held, x, kSteps));
        }
        if (best.x.size() != 0) all.push_back(std::move(best));
    }
    Tried best;
    for (const Tried& one : all) best.take(problem, solve_from(problem, one.x, kSteps));
    return best.x;
}

VectorXd adapt(const Problem& problem, const Shaft& shaft) {
    constexpr int kSteps = 30;
    Problem held = problem;
    held.hold_plant = true;
    std::vector<Start> starts;
    for (const Series& series : problem.all) starts.push_back({.velocity = series.velocity(1)});
    VectorXd x = problem.of(shaft, starts);
    x(kGains) = -3;
    x(kGains + 1) = -6;
    x = solve_from(held, x, kSteps);
    return x.allFinite() ? x : VectorXd();
}

MatrixXd jacobian(const Problem& problem, const VectorXd& x) {
    MatrixXd out(problem.samples(), problem.unknowns());
    for (Index i = 0; i < x.size(); ++i) {
        const bool held = i <= kGains + 1 && (problem.hold_plant || (problem.hold && i >= kDeadTime));
        if (held) {
            out.col(i).setZero();
            continue;
        }
        constexpr double kStep = 1e-5;
        VectorXd up = x, down = x;
        up(i) += kStep;
        down(i) -= kStep;
        out.col(i) = (problem.errors(up) - problem.errors(down)) / (2 * kStep);
    }
    return out;
}

}  // namespace nplc::macreg
