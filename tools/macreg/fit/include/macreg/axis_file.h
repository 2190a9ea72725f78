#pragma once

#include <string>
#include <vector>

#include "macreg/fit.h"
#include "macreg/recording.h"

namespace nplc::macreg {

/// A value of the plant in a user's units.
struct Shown {
    std::string key{};  ///< as in the file
    std::string unit{};
    double value = 0;
    double low = 0;
    double high = 0;
    bool told = false;
    std::string why{};  ///< if not
};
/// All of plant_file::items(), in that order.
std::vector<Shown> shown(const Fit& fit, const FoundPlant& found);

/// `macreg fit`'s file: determined values, and as comments those that could not be determined.
std::string axis_file(const Fit& fit, const FoundPlant& found, const std::vector<std::string>& recordings);

/// Measured and fitted, all recordings one after the other: velocities, torque, and the position error of the
/// fitted shaft.
Recording comparison(const Fit& fit, const std::vector<Series>& all, registers::Model model);

struct MoveNeed {
    double torque = 0;      ///< of 1023: the most that the move takes
    double limit = 1023;    ///< T_SOLL
    std::string without{};  ///< values that were not determined and are left out here
    double excess() const { return torque / limit - 1; }
};
/// Of a move with V_SOLL and A_SOLL in the registers' steps, in the direction that takes more.
MoveNeed need_of(const Fit& fit, double v_soll, double a_soll, double t_soll);

}  // namespace nplc::macreg
