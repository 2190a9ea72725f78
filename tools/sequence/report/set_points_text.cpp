#include "report/set_points_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "set_points/values.h"

namespace nplc::seqc {
namespace {

using set_points::SetPoint;
using set_points::ValueKind;

std::string target_text(const SetPoint& point, const Symbols& symbols) {
    if (point.kind == ValueKind::timer) return "TIMER";
    if (point.kind == ValueKind::counter) return "COUNTER";
    const registers::Register* reg = registers::find(symbols.motor, point.reg);
    const std::string name = reg != nullptr ? std::string(reg->name) : fmt::format("REG({})", point.reg);
    return point.at_power_up ? name + ", written by POWER_UP" : name;
}

std::string takers_text(const Symbols& symbols) {
    std::string list;
    for (std::size_t step = 0; step < symbols.steps.size(); ++step) {
        if (((symbols.set_points.takes >> step) & 1U) == 0) continue;
        list += (list.empty() ? "" : ", ") + symbols.steps[step];
    }
    return list.empty() ? "no step: while stopped" : list;
}

}  // namespace

std::string text_of(const SetPoint& point) {
    return fmt::format("{}, {}", set_points::text_of(point, point.initial), set_points::range_text(point));
}

std::string set_points_text(const Symbols& symbols) {
    if (symbols.set_points.values.empty()) return {};
    std::string text = "\nset-points, taken in " + takers_text(symbols) + ":\n";
    for (const SetPoint& point : symbols.set_points.values) {
        text += fmt::format("  {}: {}; {}; in term{} {}\n", point.name, text_of(point),
                            target_text(point, symbols), point.places.size() == 1 ? "" : "s",
                            fmt::join(point.places, ", "));
    }
    return text;
}

std::vector<SetPointChange> set_point_changes(const Symbols* before, const Symbols* now) {
    static const Symbols kNone{};
    const set_points::Record& old = (before != nullptr ? *before : kNone).set_points;
    const set_points::Record& young = (now != nullptr ? *now : kNone).set_points;
    std::vector<SetPointChange> changes;
    if (before == nullptr || now == nullptr) return changes;
    for (const SetPoint& point : old.values) {
        const SetPoint* same = set_points::find(young, point.name);
        const std::string text = same != nullptr ? text_of(*same) : std::string();
        if (text != text_of(point)) changes.push_back({point.name, text_of(point), text});
    }
    for (const SetPoint& point : young.values) {
        if (set_points::find(old, point.name) == nullptr) changes.push_back({point.name, {}, text_of(point)});
    }
    return changes;
}

}  // namespace nplc::seqc
