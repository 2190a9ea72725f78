#include "sim/motor_constants.h"

namespace nplc::sim {
namespace {

// 17.3E-6 kgm2 (001 §3.2.13) and a peak torque of 1.57 Nm give 869,000 rpm/s. 24 V peak a phase at 6000 rpm,
// so 1.57 Nm takes 27.4 A.
constexpr MotorConstants kSmall{
    .outer_period = 1.92e-3,
    .full_acceleration = 3500 / 16.0,
    .emf_inertia = 0.017,
    .counts_a_field = 2048,
    .full_current = 847,
    .resistance = 0.366,
    .decay = 0.9,
    .emf = 19.5,
    .volts_of_one = 24.0 / 1023,
    .amperes_of_one = 27.4 / 847,
    .nominal_volts = 48,
    .volts_register = 1 / 0.0537,
    .supply = {.source_volts = 48, .dump_volts = 52, .source_ohms = 0.2, .dump_ohms = 10, .farads = 2.2e-3},
    .dump_watts = 10,
    .dump_seconds = 10,
    .copper_seconds = 30,
    .warming = 0};

// 2,500 / 16 counts/sample^2 are 695,000 rpm/s. 162.5 V peak a phase at 4500 rpm,
// 52 counts of the inner loop; 6.8 Nm peak take 13.2 A.
constexpr MotorConstants kBig{
    .outer_period = 1.0 / 770,
    .full_acceleration = 2500 / 16.0,
    .emf_inertia = 0.0075,
    .counts_a_field = 2000,
    .full_current = 847,
    .resistance = 0.3,
    .decay = 0.95,
    .emf = 19.7,
    .volts_of_one = 162.5 / 1023,
    .amperes_of_one = 13.2 / 847,
    .nominal_volts = 325,
    .volts_register = 1 / 0.888798,
    .supply = {.source_volts = 325, .dump_volts = 400, .source_ohms = 1, .dump_ohms = 50, .farads = 470e-6},
    .dump_watts = 50,
    .dump_seconds = 20,
    .copper_seconds = 60,
    .warming = 60};

}  // namespace

const MotorConstants& constants_of(registers::Model model) {
    return model == registers::Model::mac800 ? kBig : kSmall;
}

}  // namespace nplc::sim
