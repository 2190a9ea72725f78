#include "units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "sim/text.h"
#include "text/edit_distance.h"

namespace nplc::sim {
namespace {

constexpr double kFullTorque = 1023;
constexpr std::array<std::string_view, 16> kKnown{"counts", "rev", "rpm", "um", "mm", "cm",  "m", "inch",
                                                  "deg",    "rad", "us",  "ms", "s",  "min", "V", "Nm"};

/// Words of statements, which may follow a number.
constexpr auto kWords = std::to_array<std::string_view>(
    {"above",   "after",   "always",      "analogue", "and",   "appears", "at",     "back",     "below",
     "brake",   "by",      "cancel",      "changes",  "clean", "cut",     "damage", "delay",    "disappears",
     "drop",    "encoder", "end",         "error",    "every", "expect",  "falls",  "false",    "follows",
     "for",     "framing", "from",        "gateway",  "in",    "late",    "least",  "line",     "load",
     "log",     "logic",   "most",        "motor",    "never", "none",    "not",    "off",      "on",
     "once",    "or",      "ordered",     "per",      "plant", "power",   "pulse",  "pulses",   "recipe",
     "restart", "rises",   "run",         "save",     "seed",  "sensor",  "set",    "spring",   "steps",
     "stop",    "supply",  "temperature", "time",     "times", "to",      "toggle", "together", "true",
     "until",   "when",    "within"});

bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
    return std::any_of(words.begin(), words.end(),
                       [word](std::string_view one) { return same_name(one, word); });
}

/// Metres or seconds; 0: neither.
struct Size {
    double value = 0;
    bool is_time = false;
};
Size size_of(std::string_view unit) {
    constexpr std::array<std::pair<std::string_view, Size>, 9> kSizes{{{"um", {1e-6}},
                                                                       {"mm", {1e-3}},
                                                                       {"cm", {1e-2}},
                                                                       {"m", {1}},
                                                                       {"inch", {0.0254}},
                                                                       {"us", {1e-6, true}},
                                                                       {"ms", {1e-3, true}},
                                                                       {"s", {1, true}},
                                                                       {"min", {60, true}}}};
    for (const auto& [name, size] : kSizes) {
        if (same_name(name, unit)) return size;
    }
    return {};
}

/// `cm/s` in `mm/s`: 10; 0 if one cannot be the other.
double factor_between(std::string_view from, std::string_view to) {
    const std::size_t slash = std::min(from.find('/'), from.size());
    const std::size_t other = std::min(to.find('/'), to.size());
    const Size size = size_of(from.substr(0, slash));
    const Size wanted = size_of(to.substr(0, other));
    const bool is_same = size.is_time == wanted.is_time && same_name(from.substr(slash), to.substr(other));
    return is_same && wanted.value > 0 ? size.value / wanted.value : 0;
}

bool has_unit(const std::vector<Unit>& units, std::string_view unit) {
    return std::any_of(units.begin(), units.end(),
                       [&](const Unit& one) { return same_name(one.name, unit); });
}

/// The program's name goes before the word.
bool is_taken(std::string_view word, const Names& names) {
    return std::any_of(names.set_points.values.begin(), names.set_points.values.end(),
                       [&](const set_points::SetPoint& point) { return same_name(point.name, word); });
}

std::string value_with(std::string_view unit, const Names& names) {
    for (const Value::Kind kind : {Value::Kind::p_ist, Value::Kind::v_ist, Value::Kind::torque}) {
        const std::string name = Value{.kind = kind}.name(names);
        if (has_unit(units_of(kind, names), unit) && !is_taken(name, names)) return name;
    }
    return {};
}

std::string set_point_with(std::string_view unit, const Names& names) {
    for (const set_points::SetPoint& point : names.set_points.values) {
        if (has_unit(units_of(point), unit)) return point.name;
    }
    return {};
}

}  // namespace

std::vector<Unit> units_of(Value::Kind kind, const Names& names) {
    const registers::Scale scale = registers::scale_of(names.motor);
    const double rev = scale.counts_per_rev;
    switch (kind) {
        case Value::Kind::p_ist:
        case Value::Kind::shaft: {
            std::vector<Unit> units{{"counts", 1}, {"rev", rev}};
            if (names.machine) units.push_back({names.machine->name, rev / names.machine->per_rev});
            return units;
        }
        case Value::Kind::v_ist: {
            const double rev_per_s = rev / scale.samples_per_second;
            std::vector<Unit> units{{"counts", 1}, {"rpm", rev_per_s / 60}, {"rev/s", rev_per_s}};
            if (names.machine) {
                units.push_back({names.machine->name + "/s", rev_per_s / names.machine->per_rev});
                units.push_back({names.machine->name + "/min", rev_per_s / names.machine->per_rev / 60});
            }
            return units;
        }
        case Value::Kind::torque:
            return {{"%", kFullTorque / 100}};
        default:
            return {};
    }
}

std::vector<Unit> units_of(const set_points::SetPoint& point) {
    if (point.kind == set_points::ValueKind::timer) return {{"ms", 1}, {"s", 1000}};
    if (point.unit.empty()) return {};
    return {{point.unit, point.steps_per_unit}};
}

std::string units_in_words(Value::Kind kind, const Names& names) {
    const std::vector<Unit> units = units_of(kind, names);
    std::string text;
    for (std::size_t i = 0; i < units.size(); ++i)
        text += (i == 0 ? "" : i + 1 == units.size() ? " or " : ", ") + units[i].name;
    return text;
}

bool is_meant_as_unit(std::string_view word, const Names& names) {
    if (is_one_of(word, kKnown) || (names.machine && same_name(names.machine->name, word))) return true;
    std::vector<std::string_view> candidates(kKnown.begin(), kKnown.end());
    candidates.insert(candidates.end(), kWords.begin(), kWords.end());
    const std::string_view meant = spelling::nearest(word, candidates);  // of equal ones the unit
    return !is_one_of(meant, kWords);
}

std::string unit_hint(double number, std::string_view unit, const std::vector<Unit>& fitting, const Value& of,
                      const Names& names) {
    for (const Unit& one : fitting) {
        if (const double factor = factor_between(unit, one.name); factor > 0)
            return fmt::format(" ({:.6g} {} are {:.6g} {})", number, unit, number * factor, one.name);
    }
    const bool is_point = of.kind == Value::Kind::set_point;
    std::string other = is_point ? set_point_with(unit, names) : value_with(unit, names);
    if (other.empty()) other = is_point ? value_with(unit, names) : set_point_with(unit, names);
    return other.empty() ? "" : fmt::format(" ({} has {})", other, unit);
}

}  // namespace nplc::sim
