#pragma once

#include <Eigen/Core>
#include <vector>

#include "macreg/series.h"
#include "shaft.h"

namespace nplc::macreg {

/// Unknowns: five of the shaft, two gains, then position, velocity and the ripple of each series; all of the
/// order of 1. Gains and plant are found together, so that what is left of the errors is noise alone: a
/// prediction error method with an observer in innovation form.
struct Problem {
    const std::vector<Series>& all;
    double fastest;  ///< counts/sample
    bool hold_plant = false;
    bool hold = false;  ///< dead time and gains as they are

    Eigen::Index unknowns() const { return 7 + 4 * static_cast<Eigen::Index>(all.size()); }
    Eigen::Index samples() const;
    Shaft shaft_of(const Eigen::VectorXd& x) const;
    Eigen::VectorXd of(const Shaft& shaft, const std::vector<Start>& starts) const;
    Gains gains_of(const Eigen::VectorXd& x) const;
    /// What is in units of the shaft's value one of the first five unknowns.
    double unit(Eigen::Index parameter, const Shaft& shaft) const;
    Start start_of(const Eigen::VectorXd& x, std::size_t series) const;
    std::vector<double> positions(const Eigen::VectorXd& x, std::size_t series) const;
    /// Measured less foretold, of all series in a row.
    Eigen::VectorXd errors(const Eigen::VectorXd& x) const;
};

/// Least squares of the errors, from several dead times on, each with the rest from sums of what was
/// measured. Empty if nothing fits.
Eigen::VectorXd solve(const Problem& problem);
/// Starts and ripples of a given shaft that the errors are least with. Empty if nothing fits.
Eigen::VectorXd adapt(const Problem& problem, const Shaft& shaft);
Eigen::MatrixXd jacobian(const Problem& problem, const Eigen::VectorXd& x);

}  // namespace nplc::macreg
