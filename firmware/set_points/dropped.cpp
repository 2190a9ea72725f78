#include "set_points/dropped.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "set_points/values.h"

namespace nplc::set_points {
namespace {

const SetPoint* find_hashed(const Record& record, std::uint32_t name_hash) {
    const auto found = std::find_if(record.values.begin(), record.values.end(),
                                    [&](const SetPoint& point) { return hash_of(point.name) == name_hash; });
    return found == record.values.end() ? nullptr : &*found;
}

/// As the gateway decides it; nothing: the value is kept.
std::optional<DropReason> reason_against(const SetPoint* now, std::uint8_t unit_code, std::int32_t value) {
    if (now == nullptr) return DropReason::gone;
    if (now->unit_code != unit_code) return DropReason::other_unit;
    if (value < now->lowest || value > now->highest) return DropReason::out_of_range;
    return std::nullopt;
}

std::optional<Dropped> loss_of(const SetPoint& before, std::int32_t value, const Record& record) {
    const SetPoint* now = find(record, before.name);
    Dropped loss{.name = before.name, .value = text_of(before, value)};
    if (const auto why = reason_against(now, before.unit_code, value)) {
        loss.why = *why;
        if (now == nullptr) return loss;
        loss.now = text_of(*now, now->initial);
        loss.takes = range_text(*now);
        return loss;
    }
    if (now->steps_per_unit == before.steps_per_unit && now->unit == before.unit) return std::nullopt;
    loss.why = DropReason::other_scale;
    loss.now = text_of(*now, value);
    return loss;
}

std::string reason_text(const Dropped& dropped) {
    switch (dropped.why) {
        case DropReason::gone:
            return "the table has no such set-point";
        case DropReason::other_unit:
            return "its unit is another one, it takes " + dropped.takes;
        case DropReason::out_of_range:
            return "it takes " + dropped.takes;
        case DropReason::not_for_motor:
            return "the motor does not take it";
        case DropReason::no_fit:
            return "what was kept has another name, unit or range";
        case DropReason::other_scale:
            return "its scale is another one";
    }
    return {};
}

std::string what_text(const Dropped& dropped) {
    if (dropped.name.empty()) return "a value";
    return dropped.value.empty() ? dropped.name : dropped.name + " " + dropped.value;
}

std::string end_text(const Dropped& dropped) {
    if (dropped.why == DropReason::other_scale) return fmt::format("stays and is {} now", dropped.now);
    if (dropped.why == DropReason::no_fit) return fmt::format("has its default {}", dropped.now);
    const std::string end = dropped.recipe.empty() ? "is dropped" : "is not loaded";
    return dropped.now.empty() ? end : fmt::format("{}, its default {} is in its place", end, dropped.now);
}

}  // namespace

std::vector<Dropped> dropped_by(const Kept& before, const Record& now) {
    std::vector<Dropped> all;
    bool is_set = false;
    const std::vector<SetPoint>& points = before.record.values;
    for (std::size_t i = 0; i < std::min(before.wanted.size(), points.size()); ++i) {
        is_set = is_set || before.wanted[i] != points[i].initial;
        if (const auto loss = loss_of(points[i], before.wanted[i], now)) all.push_back(*loss);
    }
    if (!is_set) all.clear();
    for (const Recipe& recipe : before.recipes) {
        for (const NewValue& value : recipe.values) {
            auto loss = loss_of(points[value.index], value.value, now);
            if (!loss) continue;
            loss->recipe = recipe.name;
            all.push_back(std::move(*loss));
        }
    }
    return all;
}

std::vector<Dropped> misfits_of(const Recipe& recipe, const Record& record) {
    std::vector<Dropped> all;
    for (const Misfit& misfit : recipe.misfits) {
        const SetPoint* now = find_hashed(record, misfit.name_hash);
        Dropped loss{.recipe = recipe.name, .why = DropReason::gone};
        if (const auto why = reason_against(now, misfit.unit_code, misfit.value)) loss.why = *why;
        if (now != nullptr) {
            loss.name = now->name;
            loss.takes = range_text(*now);
            loss.now = text_of(*now, now->initial);
            if (loss.why != DropReason::other_unit) loss.value = text_of(*now, misfit.value);
        }
        all.push_back(std::move(loss));
    }
    return all;
}

Dropped refused_by_motor(const SetPoint& point, std::int32_t value) {
    return {.name = point.name,
            .value = text_of(point, value),
            .why = DropReason::not_for_motor,
            .now = text_of(point, point.initial)};
}

Dropped without_fit(const SetPoint& point) {
    return {.name = point.name, .why = DropReason::no_fit, .now = text_of(point, point.initial)};
}

std::string text_of(const Dropped& dropped) {
    return fmt::format("{}{} {}: {}",
                       dropped.recipe.empty() ? "" : fmt::format("recipe '{}': ", dropped.recipe),
                       what_text(dropped), end_text(dropped), reason_text(dropped));
}

std::string_view key_of(DropReason why) {
    switch (why) {
        case DropReason::gone:
            return "gone";
        case DropReason::other_unit:
            return "other_unit";
        case DropReason::out_of_range:
            return "out_of_range";
        case DropReason::not_for_motor:
            return "not_for_motor";
        case DropReason::no_fit:
            return "no_fit";
        case DropReason::other_scale:
            return "other_scale";
    }
    return {};
}

}  // namespace nplc::set_points
