#include "macreg/axis_file.h"

#include <fmt/format.h>

#include <cmath>

namespace nplc::macreg {
namespace {

constexpr double kStepsInACount = 16;  // of V_SOLL and A_SOLL, per count

constexpr const char* kNoConstant =
    "motion tells torques as parts of the motor's own only; give an inertia that you know, such as --inertia "
    "1.73e-5 "
    "for a bare motor";

/// In the order of plant_file::items().
constexpr std::array<Parameter, kParameters> kOrder{
    Parameter::inertia, Parameter::coulomb, Parameter::viscous, Parameter::load, Parameter::dead_time};

}  // namespace

std::vector<Shown> shown(const Fit& fit, const FoundPlant& found) {
    std::vector<Shown> all;
    for (const plant_file::Item& item : plant_file::items()) {
        Shown one{.key = std::string(item.key), .unit = std::string(item.unit)};
        if (const auto& value = found.plant.*(item.value)) {
            one.told = true;
            one.value = *value;
            one.low = (found.low.*(item.value)).value_or(*value);
            one.high = (found.high.*(item.value)).value_or(*value);
        } else {
            one.why = all.size() < kParameters ? fit[kOrder[all.size()]].why : kNoConstant;
        }
        all.push_back(std::move(one));
    }
    return all;
}

std::string axis_file(const Fit& fit, const FoundPlant& found, const std::vector<std::string>& recordings) {
    std::string out = fmt::format(
        "# The plant of an axis, found by macreg fit; intervals are of 95 %.\nmotor = \"{}\"\n\n[plant]\n",
        found.plant.motor);
    for (const Shown& one : shown(fit, found)) {
        if (one.told)
            out += fmt::format("{} = {:.6g}  # {}{}{:.4g} to {:.4g}\n", one.key, one.value, one.unit,
                               one.unit.empty() ? "" : ", ", one.low, one.high);
        else
            out += fmt::format("# {} is not told: {}\n", one.key, one.why);
    }
    out += fmt::format("\n[fit]\nr2_velocity = {:.6f}\nrecordings = [", fit.r2_velocity);
    for (const std::string& name : recordings) {
        std::string safe;
        for (const char c : name)
            safe += c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20 ? '_' : c;
        out += fmt::format("{}\"{}\"", &name == &recordings.front() ? "" : ", ", safe);
    }
    return out + "]\n";
}

Recording comparison(const Fit& fit, const std::vector<Series>& all, registers::Model model) {
    const registers::Scale scale = registers::scale_of(model);
    const double rpm = 60 * scale.samples_per_second / scale.counts_per_rev;
    Recording out;
    out.rate_hz = scale.samples_per_second;
    out.columns = {{"measured", "rpm", {}},
                   {"fitted", "rpm", {}},
                   {"VF_OUT", "of 1023", {}},
                   {"strays by", "counts", {}}};
    for (std::size_t s = 0; s < all.size(); ++s) {
        for (std::size_t i = 1; i < all[s].size(); ++i) {
            out.time_s.push_back(static_cast<double>(out.time_s.size()) / out.rate_hz);
            out.columns[0].values.push_back(all[s].velocity(i) * rpm);
            out.columns[1].values.push_back((fit.positions[s][i] - fit.positions[s][i - 1]) * rpm);
            out.columns[2].values.push_back(all[s].torque[i]);
            out.columns[3].values.push_back(all[s].counts[i] - all[s].counts[0] -
                                            (fit.positions[s][i] - fit.positions[s][0]));
        }
    }
    return out;
}

MoveNeed need_of(const Fit& fit, double v_soll, double a_soll, double t_soll) {
    MoveNeed need{.limit = t_soll};
    const auto add = [&](Parameter parameter, const char* name, double times) {
        const Estimate& e = fit[parameter];
        if (e.told)
            need.torque += std::abs(e.value) * times;
        else
            need.without += fmt::format("{}{}", need.without.empty() ? "" : ", ", name);
    };
    add(Parameter::inertia, "inertia", a_soll / kStepsInACount);
    add(Parameter::coulomb, "coulomb_friction", 1);
    add(Parameter::viscous, "viscous_friction", v_soll / kStepsInACount);
    add(Parameter::load, "constant_load", 1);
    return need;
}

}  // namespace nplc::macreg
