#pragma once

#include <string>
#include <string_view>

#include "sim/scenario.h"

namespace nplc::sim {

inline Names program_names() {
    Names names;
    names.inputs = {"Start", "Guard", "", "", "", ""};
    names.outputs = {"Grip", "", "", "Lamp"};
    names.machine = {"mm", 5};
    names.steps = {{0, "POWER_UP"}, {1, "Idle"}, {2, "Travel"}};
    names.groups = {{"Working", {1, 2}}};
    names.times = {{"Pause", 250}};
    return names;
}

inline ParsedScenario parse(const std::string& text, std::string_view motor = "MAC140") {
    Names names = program_names();
    const registers::DriveModel* model = registers::find_drive(motor);
    names.motor = model->map;
    if (model->family->is_translated()) names.drive = model;
    return parse_scenario(text, "x.scn", names);
}

/// `line:column: message` of each.
inline std::string all_mistakes(const std::string& text, const Names& names) {
    std::string all;
    for (const Mistake& found : parse_scenario(text, "x.scn", names).mistakes)
        all += found.place() + ": " + found.message + "\n";
    return all;
}

inline Names names_with_set_points() {
    Names names = program_names();
    set_points::SetPoint length;
    length.name = "Length";
    length.unit = "mm";
    length.steps_per_unit = 819.2;
    length.step = 0.1;
    length.initial = 8192;
    length.lowest = 8192;
    length.highest = 163'840;
    set_points::SetPoint dwell = length;
    dwell.name = "Dwell";
    dwell.kind = set_points::ValueKind::timer;
    dwell.unit = "s";
    dwell.steps_per_unit = 1000;
    dwell.lowest = dwell.initial = 100;
    dwell.highest = 5000;
    set_points::SetPoint pieces = length;
    pieces.name = "Pieces";
    pieces.kind = set_points::ValueKind::counter;
    pieces.unit = "";
    pieces.steps_per_unit = 1;
    pieces.step = 0;
    pieces.lowest = pieces.initial = 1;
    pieces.highest = 500;
    names.set_points = {{length, dwell, pieces}, 1};
    return names;
}

}  // namespace nplc::sim
