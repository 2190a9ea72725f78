#include "symbols/motors.h"

#include <fmt/format.h>

#include <algorithm>

namespace nplc::seqc {
namespace {

std::vector<std::string_view> names_of(const registers::DriveFamily& family) {
    std::vector<std::string_view> names;
    for (const registers::DriveModel& model : family.models()) {
        if (std::find(names.begin(), names.end(), model.program_name) == names.end())
            names.push_back(model.program_name);
    }
    return names;
}

}  // namespace

std::optional<MotorChoice> motor_named(std::string_view name) {
    const registers::DriveModel* drive = registers::find_drive_of_program(name);
    if (drive == nullptr) return std::nullopt;
    return MotorChoice{drive->map, drive->family->is_translated() ? drive : nullptr};
}

std::vector<std::string_view> motor_names() {
    std::vector<std::string_view> all;
    for (const registers::DriveFamily* family : registers::families()) {
        const auto names = names_of(*family);
        all.insert(all.end(), names.begin(), names.end());
    }
    return all;
}

std::string motor_names_text() {
    std::string text = "the motors are ";
    for (const registers::DriveFamily* family : registers::families()) {
        const auto names = names_of(*family);
        if (family != registers::families().front()) text += fmt::format(", and {}'s ", family->name());
        text += fmt::format("{}", fmt::join(names.begin(), names.end() - 1, ", "));
        text += fmt::format("{}{}", names.size() > 1 ? " and " : "", names.back());
    }
    return text;
}

std::string_view motor_name(const Symbols& symbols) {
    return symbols.drive != nullptr ? symbols.drive->program_name : registers::name_of(symbols.motor);
}

}  // namespace nplc::seqc
