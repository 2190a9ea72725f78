#include "metrics/exposition.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "causes/codes.h"
#include "faces/points.h"
#include "set_points/values.h"

namespace nplc::metrics {

namespace gw = registers::gateway;
using faces::AxisImage;
using faces::Quality;
using faces::Tally;

namespace {

enum class Type : std::uint8_t { gauge, counter };

/// A value of the model with its name by Prometheus's conventions.
struct Row {
    std::string_view point;
    std::string_view name;  ///< without the prefix nanoplc_
    Type type = Type::gauge;
    double factor = 1;      ///< to base units
    bool has_unit = false;  ///< the axis's unit, as a label
};

constexpr double kMilli = 1e-3;
constexpr double kMicro = 1e-6;
constexpr double kMillion = 1e6;
constexpr double kPercent = 1e-2;
constexpr Type C = Type::counter;
constexpr Type G = Type::gauge;

constexpr Row kRows[] = {
    {"ready", "ready"},
    {"running", "running"},
    {"held", "held"},
    {"waiting", "waiting"},
    {"stop_unconfirmed", "stop_unconfirmed"},
    {"stop_unconfirmed_time", "stop_unconfirmed_seconds", G, kMilli},
    {"safe", "safe"},
    {"error", "error"},
    {"in_position", "in_position"},
    {"link_up", "link_up"},
    {"forced", "forced"},
    {"has_table", "has_table"},
    {"enabled", "enabled"},
    {"settings_differ", "settings_differ"},
    {"run_state", "run_state"},
    {"step", "step"},
    {"counter", "counted"},
    {"timer", "timer_seconds", G, kMilli},
    {"inputs", "inputs"},
    {"outputs", "outputs"},
    {"safe_reason", "safe_reason"},
    {"uptime", "uptime_seconds", G, kMilli},
    {"scans", "scans_total", C},
    {"worst_scan_time", "worst_scan_seconds", G, kMicro},
    {"worst_poll_gap", "worst_poll_gap_seconds", G, kMicro},
    {"late_polls", "late_polls_total", C},
    {"link", "link_state"},
    {"link_losses", "link_losses_total", C},
    {"resent", "link_repeats_total", C},
    {"orders", "orders_total", C},
    {"discarded", "orders_discarded_total", C},
    {"accesses", "motor_accesses_total", C},
    {"access_fails", "motor_access_errors_total", C},
    {"user_messages", "user_messages_total", C},
    {"user_refused", "user_messages_refused_total", C},
    {"seat", "seat"},
    {"contact_age", "motor_contact_age_seconds"},
    {"position", "position", G, 1, true},
    {"velocity", "velocity_per_second", G, 1, true},
    {"error_word", "motor_error_word"},
    {"mode", "motor_mode"},
    {"torque", "motor_torque_ratio", G, kPercent},
    {"load", "motor_load_ratio", G, kPercent},
    {"follow_error", "follow_error", G, 1, true},
    {"target", "target", G, 1, true},
    {"temperature", "motor_temperature_celsius"},
};

struct OwnRow {
    std::string_view name;
    std::string_view type;
    std::string_view text;
};
constexpr OwnRow kInfo{"nanoplc_info", "gauge", "1; the version is its label"};
constexpr OwnRow kUp{"nanoplc_axis_up", "gauge", "1: the axis's loop is alive; 0: nothing is known of it"};
constexpr OwnRow kScanTime{"nanoplc_scan_seconds", "histogram",
                           "from the end of a scan to the end of the next one"};
constexpr OwnRow kEvents{"nanoplc_events_total", "counter",
                         "entries of the axis's log since the program began, by their event or cause"};
constexpr OwnRow kWhy{"nanoplc_why", "gauge",
                      "number of what keeps the motor from moving, or of `moves`; its name is its label"};
constexpr OwnRow kSetPoint{"nanoplc_set_point", "gauge",
                           "value of a set-point in force, in its own unit, which is a label"};
constexpr OwnRow kSetPointWanted{"nanoplc_set_point_wanted", "gauge",
                                 "the stored value; another one than in force until the sequence takes it"};
constexpr OwnRow kRecipe{"nanoplc_recipe", "gauge", "number of the recipe that was loaded last, 0: none"};
constexpr OwnRow kChanges{"nanoplc_set_point_changes_total", "counter", "values of set-points changed"};
constexpr OwnRow kCommands{"nanoplc_commands_total", "counter",
                           "commands of faces since the program began, by how they ended"};

struct Axis {
    const faces::AxisModel& model;
    AxisImage image;
    std::shared_ptr<const faces::SetPointBook> book;
    std::string label;  ///< axis="x"
};

/// Escapes backslash, quote and line feed as required by the format.
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '\n') {
            out += "\\n";
            continue;
        }
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

void put_head(std::string& out, const OwnRow& row) {
    fmt::format_to(std::back_inserter(out), "# HELP {} {}\n# TYPE {} {}\n", row.name, row.text, row.name,
                   row.type);
}

void put(std::string& out, std::string_view name, const std::string& labels, double value) {
    fmt::format_to(std::back_inserter(out), "{}{{{}}} {}\n", name, labels, value);
}

void put_rows(std::string& out, std::span<const Axis> axes, base::Instant now) {
    for (const Row& row : kRows) {
        const faces::Point* point = faces::find_point(row.point);
        if (point == nullptr) continue;
        const std::string name = fmt::format("nanoplc_{}", row.name);
        std::string lines;
        for (const Axis& axis : axes) {
            const auto value = point->take(axis.image, now, axis.model.scaling());
            if (value.quality != Quality::good) continue;
            std::string labels = axis.label;
            if (row.has_unit) labels += fmt::format(",unit=\"{}\"", escaped(axis.model.scaling().unit));
            put(lines, name, labels, value.value * row.factor);
        }
        if (lines.empty()) continue;
        const std::string text = point->text.empty() ? std::string(point->name) : escaped(point->text);
        put_head(out, {name, row.type == Type::counter ? "counter" : "gauge", text});
        out += lines;
    }
}

void put_scan_times(std::string& out, std::span<const Axis> axes) {
    put_head(out, kScanTime);
    for (const Axis& axis : axes) {
        const Tally& tally = axis.image.tally;
        std::uint64_t count = 0;
        for (std::size_t i = 0; i < tally.scans.size(); ++i) {
            count += tally.scans[i];
            const bool is_last = i == Tally::kBoundsMicroseconds.size();
            const std::string bound =
                is_last ? "+Inf" : fmt::format("{}", Tally::kBoundsMicroseconds[i] / kMillion);
            fmt::format_to(std::back_inserter(out), "{}_bucket{{{},le=\"{}\"}} {}\n", kScanTime.name,
                           axis.label, bound, count);
        }
        fmt::format_to(std::back_inserter(out), "{0}_sum{{{1}}} {2}\n{0}_count{{{1}}} {3}\n", kScanTime.name,
                       axis.label, static_cast<double>(tally.scan_microseconds) / kMillion, count);
    }
}

void put_events(std::string& out, std::span<const Axis> axes) {
    put_head(out, kEvents);
    for (const Axis& axis : axes) {
        for (std::size_t code = 0; code < Tally::kEvents; ++code) {
            const std::string_view name = gw::key_of_log_code(static_cast<std::uint8_t>(code));
            if (name.empty()) continue;
            put(out, kEvents.name, fmt::format("{},event=\"{}\"", axis.label, name),
                axis.image.tally.events[code]);
        }
    }
}

void put_why(std::string& out, std::span<const Axis> axes) {
    const bool is_known =
        std::any_of(axes.begin(), axes.end(), [](const Axis& axis) { return axis.image.why != 0; });
    if (!is_known) return;
    put_head(out, kWhy);
    for (const Axis& axis : axes) {
        const causes::Code* code = causes::find_code(axis.image.why);
        if (code != nullptr)
            put(out, kWhy.name, fmt::format("{},cause=\"{}\"", axis.label, code->name), code->number);
    }
}

using ValueOf = std::int32_t (*)(const AxisImage&, std::size_t);

void put_values(std::string& out, std::span<const Axis> axes, const OwnRow& row, ValueOf value_of) {
    put_head(out, row);
    for (const Axis& axis : axes) {
        for (std::size_t i = 0; i < axis.book->record.values.size(); ++i) {
            const set_points::SetPoint& point = axis.book->record.values[i];
            put(out, row.name,
                fmt::format("{},name=\"{}\",unit=\"{}\"", axis.label, escaped(point.name),
                            escaped(point.unit)),
                set_points::shown_value(point, value_of(axis.image, i)));
        }
    }
}

/// For axes whose table has set-points.
void put_set_points(std::string& out, std::span<const Axis> axes) {
    std::vector<Axis> some;
    std::copy_if(axes.begin(), axes.end(), std::back_inserter(some), [](const Axis& axis) {
        return axis.book->is_of(axis.image) && !axis.book->record.values.empty();
    });
    if (some.empty()) return;
    put_values(out, some, kSetPoint, faces::set_point_in_force);
    put_values(out, some, kSetPointWanted, faces::set_point_wanted);
    put_head(out, kRecipe);
    for (const Axis& axis : some) put(out, kRecipe.name, axis.label, faces::active_recipe(axis.image));
    put_head(out, kChanges);
    for (const Axis& axis : some) put(out, kChanges.name, axis.label, axis.image[gw::SET_POINT_CHANGES]);
}

void put_commands(std::string& out, std::span<const Axis> axes) {
    put_head(out, kCommands);
    for (const Axis& axis : axes) {
        put(out, kCommands.name, axis.label + ",result=\"done\"", axis.image.commands_done);
        put(out, kCommands.name, axis.label + ",result=\"refused\"", axis.image.commands_refused);
    }
}

}  // namespace

std::string exposition(const faces::Axes& axes, const std::string& program, base::Instant now) {
    std::string out;
    put_head(out, kInfo);
    put(out, kInfo.name, fmt::format("version=\"{}\"", escaped(program)), 1);
    put_head(out, kUp);
    std::vector<Axis> known;
    for (faces::AxisModel* model : axes) {
        Axis axis{*model, model->image_with_why(now), model->set_points(),
                  fmt::format("axis=\"{}\"", escaped(model->name()))};
        const bool is_up = axis.image.number != 0 && now - axis.image.taken <= faces::AxisModel::kOld;
        put(out, kUp.name, axis.label, is_up ? 1 : 0);
        if (is_up) known.push_back(std::move(axis));
    }
    if (known.empty()) return out;
    put_rows(out, known, now);
    put_scan_times(out, known);
    put_events(out, known);
    put_why(out, known);
    put_set_points(out, known);
    put_commands(out, known);
    return out;
}

std::string metrics_as_markdown() {
    std::string text = "| metric | type | meaning |\n|---|---|---|\n";
    const auto line = [&text](std::string_view name, std::string_view type, std::string_view meaning) {
        text += fmt::format("| `{}` | {} | {} |\n", name, type, meaning);
    };
    for (const OwnRow& row : {kInfo, kUp}) line(row.name, row.type, row.text);
    for (const Row& row : kRows) {
        const faces::Point* point = faces::find_point(row.point);
        const std::string_view meaning = point->text.empty() ? point->name : point->text;
        line(fmt::format("nanoplc_{}", row.name), row.type == Type::counter ? "counter" : "gauge", meaning);
    }
    for (const OwnRow& row :
         {kScanTime, kEvents, kWhy, kSetPoint, kSetPointWanted, kRecipe, kChanges, kCommands})
        line(row.name, row.type, row.text);
    return text;
}

}  // namespace nplc::metrics
