#pragma once

#include <vector>

#include "macreg/series.h"

namespace nplc::macreg {

/// What a fit looks for, in the registers' terms: torques as in VF_OUT, counts, samples of the outer loop.
struct Shaft {
    double inertia = 1;  ///< torque that a count/sample^2 takes
    double coulomb = 0;
    double viscous = 0;  ///< torque that a count/sample takes
    double load = 0;     ///< positive turns it forward
    double dead_time = 0;
};

/// Torque that goes round with the field, as currents that are measured with an offset make it (001
/// §3.2.140).
struct Ripple {
    double sine = 0;
    double cosine = 0;
};

struct Start {
    double position = 0;
    double velocity = 0;
    Ripple ripple{};  ///< from the first sample's place
};

/// What of each error of the foretold position is taken over into position and velocity: a shaft that the
/// model does not wholly foretell, for its torque is not quite the one asked for, is followed so.
struct Gains {
    double position = 0;
    double velocity = 0;  ///< a sample
};

/// Measured less foretold from the sample before, in each sample; 0 at rest, from where it begins anew.
std::vector<double> errors_of(const Shaft& shaft, const Start& start, const Gains& gains,
                              const Series& series);

/// Where the shaft is at the end of each sample if it is given the torques of `series`, and held where
/// it was at rest. From one change of the torque
/// to the next by the solution of its equation of motion; a shaft at rest stays there until friction is
/// overcome.
std::vector<double> positions_of(const Shaft& shaft, const Start& start, const Series& series);

}  // namespace nplc::macreg
