#include "units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim/text.h"

namespace nplc::sim {
namespace {

constexpr double kFullTorque = 1023;
constexpr std::array<std::string_view, 16> kKnown{"counts", "rev", "rpm", "um", "mm", "cm",  "m", "inch",
                                                  "deg",    "rad", "us",  "ms", "s",  "min", "V", "Nm"};

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

std::string units_in_words(Value::Kind kind, const Names& names) {
    const std::vector<Unit> units = units_of(kind, names);
    std::string text;
    for (std::size_t i = 0; i < units.size(); ++i)
        text += (i == 0 ? "" : i + 1 == units.size() ? " or " : ", ") + units[i].name;
    return text;
}

bool looks_like_unit(std::string_view word, const Names& names) {
    const auto is_it = [word](std::string_view known) { return same_name(known, word); };
    return std::any_of(kKnown.begin(), kKnown.end(), is_it) || (names.machine && is_it(names.machine->name));
}

}  // namespace nplc::sim
