#include "symbols/set_points_json.h"

namespace nplc::seqc {

using Json = nlohmann::ordered_json;
using set_points::ValueKind;

Json json_of(const set_points::Record& record) {
    Json list = Json::array();
    for (const set_points::SetPoint& point : record.values) {
        Json entry = {{"name", point.name}};
        if (point.kind == ValueKind::motor_register) {
            entry["register"] = point.reg;
            entry["longword"] = point.longword;
            entry["at_power_up"] = point.at_power_up;
        } else {
            entry["preset"] = point.kind == ValueKind::timer ? "timer" : "counter";
        }
        entry["unit"] = point.unit;
        entry["unit_code"] = point.unit_code;
        entry["steps_per_unit"] = point.steps_per_unit;
        if (point.step > 0) entry["step"] = point.step;
        if (point.grid_from) entry["grid_from"] = *point.grid_from;
        entry["initial"] = point.initial;
        entry["lowest"] = point.lowest;
        entry["highest"] = point.highest;
        entry["terms"] = point.places;
        list.push_back(std::move(entry));
    }
    return list;
}

Json takes_of(const set_points::Record& record) {
    Json list = Json::array();
    for (unsigned step = 0; step < 64; ++step) {
        if (((record.takes >> step) & 1U) != 0) list.push_back(step);
    }
    return list;
}

}  // namespace nplc::seqc
