#pragma once

#include <vector>

#include "macreg/series.h"

namespace nplc::macreg {

/// The parameters of a fit, in the registers' units: torques as in VF_OUT, counts, samples of the outer loop.
struct Shaft {
    double inertia = 1;  ///< torque per count/sample^2
    double coulomb = 0;
    double viscous = 0;  ///< torque per count/sample
    double load = 0;     ///< a positive load turns the shaft forward
    double dead_time = 0;
};

/// Torque that varies with the field's angle, as offsets of the current measurement cause it (001 §3.2.140).
struct Ripple {
    double sine = 0;
    double cosine = 0;
};

struct Start {
    double position = 0;
    double velocity = 0;
    Ripple ripple{};  ///< relative to the first sample's position
};

/// Observer gains: the share of each prediction error that corrects position and velocity, since the real
/// torque is not exactly the requested one and the model alone would drift.
struct Gains {
    double position = 0;
    double velocity = 0;  ///< a sample
};

/// Measured minus predicted from the sample before, in each sample; 0 at rest, where the observer is reset.
std::vector<double> errors_of(const Shaft& shaft, const Start& start, const Gains& gains,
                              const Series& series);

/// The shaft's position at the end of each sample when it is driven by the torques of `series`, and held
/// where it was at rest. Solves the equation of motion from one change of torque to the next; a shaft at rest
/// stays there until static friction is overcome.
std::vector<double> positions_of(const Shaft& shaft, const Start& start, const Series& series);

}  // namespace nplc::macreg
