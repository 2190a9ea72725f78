#include "macreg/fit.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "solver.h"

namespace nplc::macreg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// The quantile of 95 %, enlarged by a third for errors that the noise model does not include: steps of the
// encoder, rest beside motion.
constexpr double kQuantile = 2.6;
constexpr double kMoving = 0.05;  // of the fastest

/// What the recordings show of the shaft's motion.
struct Seen {
    double fastest = 0;  ///< counts/sample, from the smoothed velocity
    double forward = 0;  ///< shares of the samples
    double backward = 0;
    double change = 0;  ///< counts/sample, the most in one recording
    double slower = 0;  ///< of those that move, with less than 0.8 of the fastest
};

/// Smoothed, so that steps of the encoder are no speeds.
std::vector<double> velocities_of(const Series& series) {
    constexpr std::size_t kSpan = 8;
    std::vector<double> out;
    for (std::size_t i = kSpan; i < series.size(); ++i)
        out.push_back((series.counts[i] - series.counts[i - kSpan]) / kSpan);
    return out;
}

Seen look_at(const std::vector<Series>& all) {
    Seen seen;
    std::vector<double> velocities;
    for (const Series& series : all) {
        const std::vector<double> some = velocities_of(series);
        velocities.insert(velocities.end(), some.begin(), some.end());
        const auto [low, high] = std::minmax_element(some.begin(), some.end());
        seen.change = std::max(seen.change, *high - *low);
    }
    for (const double v : velocities) seen.fastest = std::max(seen.fastest, std::abs(v));
    double moving = 0, slower = 0;
    for (const double v : velocities) {
        if (std::abs(v) < kMoving * seen.fastest) continue;
        (v > 0 ? seen.forward : seen.backward) += 1;
        moving += 1;
        if (std::abs(v) < 0.8 * seen.fastest) slower += 1;
    }
    seen.forward /= static_cast<double>(velocities.size());
    seen.backward /= static_cast<double>(velocities.size());
    seen.slower = slower / std::max(moving, 1.0);
    return seen;
}

/// Variances of the unknowns: those of noise that is alike everywhere, or what the errors themselves show
/// where it is more (they are not alike at rest and in motion, and neighbours may have a part in common, such
/// as the same step of an encoder at rest). Directions that the errors do not feel have wide ones.
VectorXd variances_of(const MatrixXd& jacobian, const VectorXd& errors, double variance) {
    constexpr Index kNeighbours = 40;
    VectorXd scale = jacobian.colwise().norm();
    for (Index i = 0; i < scale.size(); ++i) scale(i) = std::max(scale(i), 1e-12);
    const MatrixXd scaled = jacobian * scale.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> of(scaled.transpose() * scaled);
    const VectorXd strength = of.eigenvalues().cwiseMax(1e-14);
    const MatrixXd inverse =
        of.eigenvectors() * strength.cwiseInverse().asDiagonal() * of.eigenvectors().transpose();
    const MatrixXd felt = errors.asDiagonal() * scaled;
    MatrixXd shown = felt.transpose() * felt;
    for (Index k = 1; k <= kNeighbours; ++k) {
        const double weight = 1 - static_cast<double>(k) / (kNeighbours + 1);
        const MatrixXd common = felt.bottomRows(felt.rows() - k).transpose() * felt.topRows(felt.rows() - k);
        shown += weight * (common + common.transpose());
    }
    const VectorXd alike = variance * inverse.diagonal();
    const VectorXd own = (inverse * shown * inverse).diagonal();
    return alike.cwiseMax(own).cwiseQuotient(scale.cwiseAbs2());
}

double velocity_r2(const Series& series, const std::vector<double>& positions) {
    double mean = 0, left = 0, all = 0;
    const double n = static_cast<double>(series.size() - 1);
    for (std::size_t i = 1; i < series.size(); ++i) mean += series.velocity(i) / n;
    for (std::size_t i = 1; i < series.size(); ++i) {
        const double miss = series.velocity(i) - (positions[i] - positions[i - 1]);
        left += miss * miss;
        all += (series.velocity(i) - mean) * (series.velocity(i) - mean);
    }
    return all > 0 ? 1 - left / all : 0;
}

constexpr const char* kThereAndBack =
    "the shaft turned one way only; record a move there and one back (--move P_SOLL=+20480, then --move "
    "P_SOLL=+-20480) and name both";

/// Why a value cannot be used, and what to record for it.
class Judge {
  public:
    Judge(const Seen& seen, const Fit& fit) : seen_(seen), fit_(fit) {}

    std::string why(Parameter parameter) const {
        const Estimate& e = fit_[parameter];
        const double half = (e.high - e.low) / 2;
        const bool one_way = std::min(seen_.forward, seen_.backward) < 0.02;
        const bool one_speed = seen_.slower < 0.08;
        switch (parameter) {
            case Parameter::inertia:
                if (half <= 0.25 * e.value && seen_.change > std::max(3.0, 0.1 * seen_.fastest)) return {};
                return "the speed hardly changed; record a move that accelerates from rest "
                       "(--move P_SOLL=+20480)";
            case Parameter::coulomb:
                if (one_way) return std::string("not to be told from constant_load: ") + kThereAndBack;
                if (one_speed) return fmt::format("not to be told from viscous_friction: {}", kTwoSpeeds);
                if (half <= small(e.value)) return {};
                return fmt::format(
                    "it is within {:.0f} of 1023; record longer and faster moves there and back", half);
            case Parameter::viscous:
                if (one_speed) return std::string(kTwoSpeeds);
                if (half * seen_.fastest <= small(e.value * seen_.fastest)) return {};
                return fmt::format(
                    "at the fastest it is within {:.0f} of 1023; record moves at two speeds that "
                    "differ more, some seconds each",
                    half * seen_.fastest);
            case Parameter::load:
                if (one_way) return std::string("not to be told from coulomb_friction: ") + kThereAndBack;
                if (half <= small(e.value)) return {};
                return fmt::format("it is within {:.0f} of 1023; record longer moves there and back", half);
            case Parameter::dead_time:
                if (half <= 0.3) return {};
                return "the torque hardly changed; record a move with a greater A_SOLL";
        }
        return {};
    }

  private:
    static constexpr const char* kTwoSpeeds =
        "all of the motion was at one speed; record moves at a slow and at a fast V_SOLL";
    static double small(double value) { return std::max(0.3 * std::abs(value), 4.0); }

    const Seen& seen_;
    const Fit& fit_;
};

void take_estimates(Fit& result, const Problem& problem, const VectorXd& x) {
    const MatrixXd j = jacobian(problem, x);
    const VectorXd left = problem.errors(x);
    const double freedom = std::max(1.0, static_cast<double>(left.size() - problem.unknowns()));
    const VectorXd variances = variances_of(j, left, left.squaredNorm() / freedom);
    const Shaft shaft = problem.shaft_of(x);
    const std::array<double, kParameters> values{shaft.inertia, shaft.coulomb, shaft.viscous, shaft.load,
                                                 shaft.dead_time};
    for (std::size_t i = 0; i < kParameters; ++i) {
        const auto row = static_cast<Index>(i);
        const double half = kQuantile * std::sqrt(variances(row)) * problem.unit(row, shaft);
        result.estimates[i] = {.value = values[i], .low = values[i] - half, .high = values[i] + half};
    }
    for (const Parameter friction : {Parameter::coulomb, Parameter::viscous, Parameter::dead_time}) {
        Estimate& e = result.estimates[static_cast<std::size_t>(friction)];
        e.low = std::max(e.low, 0.0);
        e.high = std::max(e.high, 0.0);
        e.value = std::max(e.value, 0.0);
    }
    result.noise = std::sqrt(left.squaredNorm() / freedom);
}

}  // namespace

Fit fit(const std::vector<Series>& all, registers::Model) {
    Fit result;
    const Seen seen = look_at(all);
    const Problem problem{.all = all, .fastest = std::max(seen.fastest, 1.0)};
    const VectorXd x = solve(problem);
    if (x.size() == 0) {
        result.problem = "no plant explains these recordings; is something pressing or slipping?";
        return result;
    }
    take_estimates(result, problem, x);
    const Judge judge(seen, result);
    for (std::size_t i = 0; i < kParameters; ++i) {
        result.estimates[i].why = judge.why(static_cast<Parameter>(i));
        result.estimates[i].told = result.estimates[i].why.empty();
    }
    double samples = 0;
    for (std::size_t s = 0; s < all.size(); ++s) {
        result.positions.push_back(problem.positions(x, s));
        const double n = static_cast<double>(all[s].size());
        result.r2_velocity += n * velocity_r2(all[s], result.positions.back());
        samples += n;
    }
    result.r2_velocity /= samples;
    return result;
}

double r2_of(const Fit& fit, const Series& series) {
    const std::vector<Series> all{series};
    const Problem problem{.all = all, .fastest = 1};
    const VectorXd x = adapt(problem, {.inertia = fit[Parameter::inertia].value,
                                       .coulomb = fit[Parameter::coulomb].value,
                                       .viscous = fit[Parameter::viscous].value,
                                       .load = fit[Parameter::load].value,
                                       .dead_time = fit[Parameter::dead_time].value});
    return x.size() == 0 ? 0 : velocity_r2(series, problem.positions(x, 0));
}

FoundPlant found_plant(const Fit& fit, registers::Model model, const std::string& motor,
                       std::optional<double> known_inertia) {
    const plant_file::Motor facts = plant_file::motor_of(model);
    const double torque = facts.full_torque / 1023;
    const double per_second = facts.sample / facts.radians;
    // Torque 1 makes 1 count/sample^2 of inertia 1.
    const double inertia = torque * facts.sample * facts.sample / facts.radians;
    const std::array<double, kParameters> units{inertia, torque, torque * per_second, torque, facts.sample};
    const std::array<std::optional<double> plant_file::Plant::*, kParameters> keys{
        &plant_file::Plant::inertia, &plant_file::Plant::coulomb_friction,
        &plant_file::Plant::viscous_friction, &plant_file::Plant::constant_load,
        &plant_file::Plant::dead_time};
    FoundPlant found;
    found.plant.motor = motor;
    // Motion yields torques only relative to the motor's own: a known inertia gives their scale
    const Estimate& j = fit[Parameter::inertia];
    double constant = 1;
    if (known_inertia && j.told) {
        constant = *known_inertia / (j.value * inertia);
        found.plant.torque_constant = constant;
        found.low.torque_constant = *known_inertia / (j.high * inertia);
        found.high.torque_constant = *known_inertia / (j.low * inertia);
    }
    for (std::size_t i = 0; i < kParameters; ++i) {
        const Estimate& e = fit.estimates[i];
        if (!e.told) continue;
        const double unit = units[i] * (i + 1 < kParameters ? constant : 1);
        found.plant.*keys[i] = e.value * unit;
        found.low.*keys[i] = e.low * unit;
        found.high.*keys[i] = e.high * unit;
    }
    return found;
}

}  // namespace nplc::macreg
