#pragma once

#include <array>
#include <string>
#include <vector>

#include "macreg/series.h"
#include "plant_file/plant_file.h"

namespace nplc::macreg {

/// A value found, with its 95 % confidence interval.
struct Estimate {
    double value = 0;
    double low = 0;
    double high = 0;
    bool told = false;  ///< the interval is narrow enough to be useful
    std::string why{};  ///< if not: what the recordings lack and which move to record
};

enum class Parameter : std::uint8_t { inertia, coulomb, viscous, load, dead_time };
inline constexpr std::size_t kParameters = 5;

/// In the registers' terms: torques as in VF_OUT, counts, samples of the outer loop.
struct Fit {
    std::array<Estimate, kParameters> estimates{};
    double r2_velocity = 0;  ///< share of the velocity's variation that the fitted shaft explains
    double noise = 0;        ///< counts, of a sample
    std::vector<std::vector<double>> positions{};  ///< fitted, of each series
    std::string problem{};                         ///< one line; empty if there is a fit

    const Estimate& operator[](Parameter parameter) const {
        return estimates[static_cast<std::size_t>(parameter)];
    }
};

/// Of recordings of the same axis; at least one. `model`: whose.
Fit fit(const std::vector<Series>& all, registers::Model model);

/// How well a fit predicts the velocity of a recording from its torque: 1 is perfectly. Only the initial
/// state is fitted.
double r2_of(const Fit& fit, const Series& series);

/// In SI at the shaft, determined values only; with `known_inertia` (kg m2) the torque constant too.
struct FoundPlant {
    plant_file::Plant plant{};
    plant_file::Plant low{};
    plant_file::Plant high{};
};
FoundPlant found_plant(const Fit& fit, registers::Model model, const std::string& motor,
                       std::optional<double> known_inertia);

}  // namespace nplc::macreg
