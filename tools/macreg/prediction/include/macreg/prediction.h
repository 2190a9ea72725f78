#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "plant_file/plant_file.h"

/// Predicts with the virtual motor how the motor will move with a plant, before anything is written.
namespace nplc::macreg {

struct Response {
    double kvout = 1;
    std::int64_t gain = 0;  ///< raw, of the speed regulator's filter: KVFX4, on MAC800 KVFX6
    std::vector<double> time_s{};
    std::vector<double> position{};  ///< counts, a value a sample
    std::vector<double> torque{};    ///< VF_OUT
    double overshoot = 0;            ///< counts beyond the target
    double settled_s = 0;            ///< until it stays within 3 counts; 0: it does not settle
    double peak_torque = 0;          ///< of 1023
};

struct Tuning {
    Response now{};   ///< KVOUT 1 and the factory's filter
    Response then{};  ///< as recommended
    double turn = 0;  ///< counts of the move
    double a_soll = 0;
    double v_soll = 0;
    std::string remark{};  ///< what is outside the manual's range, or does not settle
};

/// KVOUT is the inertia of motor and load divided by the motor's own (001 §3.2.13), 1.0 to 10.0; the filter
/// keeps the factory's values unless a smaller gain predicts less overshoot. `plant` needs an inertia.
Tuning tuning_for(const plant_file::Plant& plant, registers::Model model);

}  // namespace nplc::macreg
