#include "motor_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <vector>

#include "drive_support.h"
#include "registers/family_list.h"

namespace nplc::boards {

#define NPLC_DECLARE(family) const DriveSupport& family##_support();
NPLC_FAMILIES(NPLC_DECLARE)
#undef NPLC_DECLARE

namespace {

struct MotorKind {
    std::string name;
    const registers::DriveModel* model;
};

std::string in_small_letters(std::string_view text) {
    std::string small(text);
    std::transform(small.begin(), small.end(), small.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return small;
}

/// "jvl", "mac23": a family that has only one value of setting motor_kind is named by the family.
std::vector<MotorKind> kinds() {
    std::vector<MotorKind> all;
    for (const registers::DriveFamily* family : registers::families()) {
        const bool is_one = family->models().front().motor_kind == family->models().back().motor_kind;
        if (is_one) {
            all.push_back({in_small_letters(family->name()), &family->models().front()});
            continue;
        }
        for (const registers::DriveModel& model : family->models())
            all.push_back({in_small_letters(model.name), &model});
    }
    return all;
}

/// "MIDI drive"
std::string in_words(const registers::DriveFamily& family) {
    return fmt::format("{} {}", family.name(), family.is_translated() ? "drive" : "motor");
}

/// `"mac23", "mac34-1" or "mac34-2"`
std::string kinds_of(const registers::DriveFamily& family) {
    std::vector<std::string> names;
    for (const MotorKind& kind : kinds()) {
        if (kind.model->family == &family) names.push_back('"' + kind.name + '"');
    }
    const std::string last = names.back();
    names.pop_back();
    return names.empty() ? last : fmt::format("{} or {}", fmt::join(names, ", "), last);
}

/// Keys of other families: valid keys, but not for this one.
void refuse_others(const registers::DriveFamily& chosen, Section& section) {
    const registers::DriveFamily& usual = *registers::families().front();
    for (const registers::DriveFamily* family : registers::families()) {
        if (family == &chosen) continue;
        const std::string why = &chosen == &usual
                                    ? fmt::format("is for a {}; write kind = {}, or leave it out",
                                                  in_words(*family), kinds_of(*family))
                                    : fmt::format("is for a {}, and this is a {}; leave it out",
                                                  in_words(*family), in_words(chosen));
        const auto own = support_of(chosen).keys();
        for (const char* key : support_of(*family).keys()) {
            const bool is_own =
                std::any_of(own.begin(), own.end(), [key](std::string_view mine) { return mine == key; });
            if (!is_own && section.any(key) != nullptr) section.complain(key, why);
        }
    }
}

}  // namespace

const DriveSupport& support_of(const registers::DriveFamily& family) {
    std::size_t index = 0;
    while (registers::families()[index] != &family) ++index;
#define NPLC_CALL(name) \
    if (index-- == 0) return name##_support();
    NPLC_FAMILIES(NPLC_CALL)
#undef NPLC_CALL
    std::abort();
}

std::string MotorConfig::line_in_words() const {
    if (!address.is_there()) return port.text;
    return fmt::format("address {} on {}", drive_address, is_on_can() ? can.text : port.text);
}

std::optional<hal_linux::Rs485> read_rs485(Section& section) {
    const auto mode = section.choice("rs485", {"off", "rts_on_send", "rts_after_send"});
    const auto before = section.number("rs485_before_ms", 0, 1000);
    const auto after = section.number("rs485_after_ms", 0, 1000);
    if (mode.value_or(0) != 0)
        return hal_linux::Rs485{.rts_on_send = mode == 1U,
                                .before_ms = static_cast<std::uint32_t>(before.value_or(0)),
                                .after_ms = static_cast<std::uint32_t>(after.value_or(0))};
    if (before || after)
        section.complain(before ? "rs485_before_ms" : "rs485_after_ms",
                         "has no meaning while rs485 is \"off\"; write \"rts_on_send\" or leave it out");
    return std::nullopt;
}

MotorConfig read_motor(Section& axis, int axis_line, Findings& findings) {
    Section section(axis.table("motor"), axis.path() + ".motor", findings);
    const std::vector<MotorKind> all = kinds();
    std::vector<std::string> names;
    names.reserve(all.size());
    for (const MotorKind& kind : all) names.push_back(kind.name);
    MotorConfig motor;
    if (const auto kind = section.choice("kind", names)) motor.model = all[*kind].model;
    refuse_others(*motor.model->family, section);
    support_of(motor).read(motor, section, axis_line);
    section.finish();
    return motor;
}

}  // namespace nplc::boards
