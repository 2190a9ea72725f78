#include "plant_file/plant_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "toml_files/toml_file.h"

namespace nplc::plant_file {
namespace {

using toml_files::Value;
using Kind = Value::Kind;

constexpr double kFullUnits = 1023;
constexpr std::string_view kAnySmall = "MAC50-141";

constexpr std::array<Item, 6> kItems{{
    {"inertia", "kg m2", "motor and load", 1e-7, 1, &Plant::inertia},
    {"coulomb_friction", "N m", "friction that does not depend on the speed", 0, 100,
     &Plant::coulomb_friction},
    {"viscous_friction", "N m s/rad", "friction that grows with the speed", 0, 10, &Plant::viscous_friction},
    {"constant_load", "N m", "such as gravity, positive turns the shaft forward", -100, 100,
     &Plant::constant_load},
    {"dead_time", "s", "from the torque asked for (VF_OUT) to the shaft's", 0, 0.01, &Plant::dead_time},
    {"torque_constant", "", "times the motor's nominal one", 0.1, 10, &Plant::torque_constant},
}};

std::string known_keys() {
    std::string keys;
    for (const Item& item : kItems) keys += fmt::format("{}{}", keys.empty() ? "" : ", ", item.key);
    return keys;
}

/// A key may contain any characters.
std::string printable(std::string_view key) {
    std::string text(key.substr(0, 40));
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
    }
    return text;
}

class Reader {
  public:
    explicit Reader(const std::string& name) : name_(name) {}

    Reading read(std::string_view text) {
        const toml_files::File file = toml_files::read_toml(text);
        if (!file.error.empty()) {
            fail(file.line, file.error + "; mend it, or write it anew with `macreg fit`");
            return std::move(result_);
        }
        for (const auto& [key, value] : file.root.entries) entry(key, value);
        if (result_.error.empty() && !has_plant_)
            fail(1, "there is no [plant] in it; name a file that `macreg fit` has written");
        if (!result_.error.empty()) result_.plant = {};
        return std::move(result_);
    }

  private:
    void entry(std::string_view key, const Value& value) {
        if (key == "motor") return motor(value);
        if (key == "fit") return;  // information written by macreg fit
        if (key != "plant")
            return fail(value.line,
                        fmt::format("'{}' is not known here; write motor and [plant]", printable(key)));
        if (value.kind != Kind::table) return fail(value.line, "'plant' is a table; write [plant]");
        has_plant_ = true;
        for (const auto& [name, inner] : value.entries) item(name, inner);
    }

    void motor(const Value& value) {
        if (value.kind != Kind::text || (value.text != kAnySmall && !registers::model_of(value.text)))
            return fail(
                value.line,
                "motor: write \"MAC50\", \"MAC95\", \"MAC140\", \"MAC141\", \"MAC800\" or \"MAC50-141\"");
        result_.plant.motor = value.text;
        result_.plant.motor_line = value.line;
    }

    void item(std::string_view key, const Value& value) {
        const auto* item =
            std::find_if(kItems.begin(), kItems.end(), [&](const Item& known) { return known.key == key; });
        if (item == kItems.end())
            return fail(value.line, fmt::format("'{}' is no part of a plant; there are {}", printable(key),
                                                known_keys()));
        const std::string_view gap = item->unit.empty() ? "" : " ";
        if (value.kind != Kind::integer && value.kind != Kind::real)
            return fail(value.line, fmt::format("{} is a number{}{}; write such as {} = 0.01", key,
                                                item->unit.empty() ? "" : " in ", item->unit, key));
        if (!(value.real >= item->least && value.real <= item->most))
            return fail(value.line,
                        fmt::format("{} = {}{}{} is not within {} to {}; mend it, or leave it out", key,
                                    value.real, gap, item->unit, item->least, item->most));
        result_.plant.*(item->value) = value.real;
    }

    void fail(int line, const std::string& what) {
        if (result_.error.empty()) result_.error = fmt::format("{}:{}: {}", name_, std::max(line, 1), what);
    }

    const std::string& name_;
    Reading result_;
    bool has_plant_ = false;
};

}  // namespace

std::span<const Item> items() {
    return kItems;
}

Reading read_plant(std::string_view text, const std::string& name) {
    return Reader(name).read(text);
}

std::string mismatch(const Plant& plant, registers::Model model) {
    const std::string_view name = registers::name_of(model);
    if (plant.motor.empty() || plant.motor == name) return {};
    if (plant.motor == kAnySmall && model != registers::Model::mac800) return {};
    return fmt::format(
        "this plant is of a {} and the simulated motor is a {}; simulate that motor, or fit a recording of "
        "this one",
        plant.motor, name);
}

// 1.57 N m and 17.3E-6 kg m2 (001 §3.2.13); MAC800: host-sim/mac_motor/README.md. A current loop with both
// poles at 0.4 of its sample delays the torque by 0.122 samples of the outer loop.
Motor motor_of(registers::Model model) {
    const bool big = model == registers::Model::mac800;
    const registers::Scale scale = registers::scale_of(model);
    const double radians = 2 * std::numbers::pi / scale.counts_per_rev;
    const double sample = 1 / scale.samples_per_second;
    const double torque = big ? 6.8 : 1.57;
    const double acceleration = (big ? 2500 : 3500) / 16.0 * radians / (sample * sample);
    return {.full_torque = torque,
            .inertia = torque / acceleration,
            .radians = radians,
            .sample = sample,
            .current_delay = 0.122 * sample};
}

Load in_motor_terms(const Plant& plant, registers::Model model) {
    const Motor motor = motor_of(model);
    const double constant = plant.torque_constant.value_or(1);
    const double units = kFullUnits / motor.full_torque / constant;
    const auto scaled = [](const std::optional<double>& value, double by) {
        return value ? std::optional(*value * by) : std::nullopt;
    };
    return {.inertia = scaled(plant.inertia, 1 / motor.inertia / constant),
            .coulomb_friction = scaled(plant.coulomb_friction, units),
            .viscous_friction = scaled(plant.viscous_friction, units * motor.radians / motor.sample),
            .constant_load = scaled(plant.constant_load, units),
            .dead_time = scaled(plant.dead_time, 1 / motor.sample)};
}

}  // namespace nplc::plant_file
