#pragma once

#include <Eigen/Core>
#include <vector>

#include "macreg/series.h"
#include "shaft.h"

namespace nplc::macreg {

/// Unknowns: five of the shaft, two gains, then position, velocity and the ripple of each series; all scaled
/// to the order of 1. Gains and plant are fitted together, so that the remaining errors are noise alone: a
/// prediction error method with an observer in innovation form.
struct Problem {
    const std::vector<Series>& all;
    double fastest;  ///< counts/sample
    bool hold_plant = false;
    bool hold = false;  ///< dead time and gains are kept

    Eigen::Index unknowns() const { return 7 + 4 * static_cast<Eigen::Index>(all.size()); }
    Eigen::Index samples() const;
    Shaft shaft_of(const Eigen::VectorXd& x) const;
    Eigen::VectorXd of(const Shaft& shaft, const std::vector<Start>& starts) const;
    Gains gains_of(const Eigen::VectorXd& x) const;
    /// The unit of one of the first five unknowns, in the shaft's value.
    double unit(Eigen::Index parameter, const Shaft& shaft) const;
    Start start_of(const Eigen::VectorXd& x, std::size_t series) const;
    std::vector<double> positions(const Eigen::VectorXd& x, std::size_t series) const;
    /// Measured minus predicted, of all series one after the other.
    Eigen::VectorXd errors(const Eigen::VectorXd& x) const;
};

/// Least squares of the errors, started from several dead times; the other start values come from sums of the
/// measurements. Empty if nothing fits.
Eigen::VectorXd solve(const Problem& problem);
/// Start positions, velocities and ripples that minimise the errors of a given shaft. Empty if nothing fits.
Eigen::VectorXd adapt(const Problem& problem, const Shaft& shaft);
Eigen::MatrixXd jacobian(const Problem& problem, const Eigen::VectorXd& x);

}  // namespace nplc::macreg
