#include "compiler/set_point_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "compiler/actions.h"
#include "compiler/drive.h"
#include "language/names.h"
#include "set_points/values.h"

namespace nplc::seqc {
namespace {

using registers::Register;
using set_points::ValueKind;

constexpr std::size_t kLongestName = 32;
constexpr double kLongestPreset = 65'535;

std::string use_text(ValueKind kind, const Register* reg) {
    if (kind == ValueKind::timer) return "the timer";
    if (kind == ValueKind::counter) return "the counter";
    return std::string(reg->name);
}

bool is_whole(double value) {
    return std::floor(value) == value;
}

/// `low`: the lower end in the set-point's unit, as written.
void lay_grid(set_points::SetPoint& point, double low) {
    constexpr double kRounding = 1e-9;
    if (std::fabs(set_points::shown_value(point, point.lowest) - low) > kRounding * std::fabs(low))
        point.grid_from = low;
}

/// Else an operator who has changed it could not set it again.
bool is_default_on_grid(Report& report, const DeclaredSetPoint& declared) {
    const set_points::SetPoint& point = declared.point;
    if (set_points::is_on_grid(point, point.initial)) return true;
    const std::string unit = point.unit.empty() ? "" : " " + point.unit;
    report
        .add("E047", declared.written->value.span,
             fmt::format("the default of '{}' is no whole number of STEPs above the lower end of its RANGE",
                         point.name),
             fmt::format("write {}{}: an operator who changed it could not set it again",
                         set_points::grid_beside(point, point.initial), unit))
        .notes.push_back({declared.written->step->span, "the STEP is here"});
    return false;
}

}  // namespace

void SetPointTable::declare(const ast::Program& program) {
    for (const ast::SetPoint& written : program.set_points) {
        const std::string_view name = written.name.text;
        const auto twin =
            std::find_if(set_points_.begin(), set_points_.end(),
                         [&](const DeclaredSetPoint& d) { return same_name(d.written->name.text, name); });
        if (twin != set_points_.end()) {
            report_
                .add("E020", written.name.span, fmt::format("set-point '{}' stands twice", name),
                     "give one of them another name")
                .notes.push_back({twin->written->name.span, "the first one is here"});
            continue;
        }
        if (!names_.is_new(written.name)) continue;
        DeclaredSetPoint& declared = set_points_.emplace_back();
        declared.written = &written;
        declared.point.name = name;
        names_.set_points().push_back(name);
        if (name.size() > kLongestName) {
            report_.add("E027", written.name.span, "the name of a set-point has at most 32 characters",
                        "the gateway keeps it with the table: choose a shorter one");
            declared.is_sound = false;
        }
        const bool has_place = written.register_number || !written.address.text.empty();
        if (has_place) declare_at(declared, static_cast<std::uint8_t>(set_points_.size()));
    }
    if (set_points_.size() <= registers::set_points::kMost) return;
    report_.add("E027", set_points_[registers::set_points::kMost].written->name.span,
                fmt::format("a gateway holds {} set-points of a table", registers::set_points::kMost),
                "make constants of those that no operator changes");
}

/// POWER_UP writes it, like a value of VAR_MOTOR.
void SetPointTable::declare_at(DeclaredSetPoint& declared, std::uint8_t number) {
    const ast::SetPoint& written = *declared.written;
    const Register* target =
        written.register_number ? values_.numbered(*written.register_number) : values_.named(written.address);
    declared.is_decided = true;
    declared.is_sound = target != nullptr && declared.is_sound;
    if (target == nullptr) {
        names_.add_faulty(written.name.text);
        return;
    }
    const auto earlier = std::find_if(names_.registers().begin(), names_.registers().end(),
                                      [&](const DeclaredName& v) { return v.reg == target; });
    if (earlier != names_.registers().end()) {
        report_
            .add("E022", written.name.span,
                 fmt::format("{} has a name already",
                             written.register_number ? target->name : written.address.text),
                 fmt::format("use '{}', or another register", earlier->name))
            .notes.push_back({earlier->span, "declared here"});
        names_.add_faulty(written.name.text);
        declared.is_sound = false;
        return;
    }
    names_.registers().push_back({written.name.text, written.name.span, 0, target});
    result_.symbols.motor_names.push_back(
        {std::string(written.name.text), std::string(target->name), target->number, {}});
    declared.is_decided = false;
    declared.point.at_power_up = true;
    if (!decide(declared, ValueKind::motor_register, target)) return;
    const Span first = written.name.span;
    const Span last = written.value.span;
    result_.symbols.motor_names.back().initial = declared.point.initial;
    values_.add_initial({target,
                         0,
                         bits_of(declared.point.initial, *target),
                         {first.offset, last.offset + last.length - first.offset},
                         number});
}

bool SetPointTable::names_one(const ast::Value& value) const {
    return value.kind == ast::Value::Kind::name &&
           std::any_of(set_points_.begin(), set_points_.end(), [&](const DeclaredSetPoint& d) {
               return same_name(d.written->name.text, value.name.text);
           });
}

std::uint8_t SetPointTable::number_for(const ast::Value& value, ValueKind kind, const Register* reg) {
    const auto found = std::find_if(set_points_.begin(), set_points_.end(), [&](const DeclaredSetPoint& d) {
        return same_name(d.written->name.text, value.name.text);
    });
    if (found == set_points_.end()) return 0;
    if (!found->is_sound) {
        names_.meet_faulty();
        return 0;
    }
    if (!found->is_decided) {
        if (!decide(*found, kind, reg)) return 0;
    } else if (found->point.kind != kind || found->reg != reg) {
        report_
            .add("E026", value.span,
                 fmt::format("'{}' is for {}, not for {}", found->point.name,
                             use_text(found->point.kind, found->reg), use_text(kind, reg)),
                 "a set-point is one value for one thing: declare another one")
            .notes.push_back({found->written->name.span, "declared here"});
        return 0;
    }
    return static_cast<std::uint8_t>(found - set_points_.begin() + 1);
}

bool SetPointTable::refuse_write(const Register& reg, Span span) {
    const auto found = std::find_if(set_points_.begin(), set_points_.end(), [&](const DeclaredSetPoint& d) {
        return d.point.at_power_up && d.reg == &reg;
    });
    if (found == set_points_.end()) return false;
    report_
        .add("E046", span,
             fmt::format("{} has the value of the set-point '{}', which the operator sets", reg.name,
                         found->point.name),
             "write another register, or make a value of VAR_MOTOR of it")
        .notes.push_back({found->written->name.span, "declared here"});
    return true;
}

/// Its values as literals; a missing unit is that of the others.
std::optional<ast::SetPoint> SetPointTable::worked_out(const ast::SetPoint& written, const Register* reg) {
    ast::SetPoint result = written;
    for (ast::Value* value : {&result.value, &result.low, &result.high}) {
        const auto literal = values_.worked_out(*value, reg);
        if (!literal) return std::nullopt;
        *value = *literal;
    }
    if (result.step) {
        const auto literal = values_.worked_out(*result.step, reg);
        if (!literal) return std::nullopt;
        result.step = *literal;
    }
    const auto complete = [](ast::Value& value, const ast::Value& other) {
        if (!value.unit.text.empty() || value.is_time || value.is_raw) return;
        value.unit = other.is_time ? ast::Name{"ms", other.span} : other.unit;
    };
    complete(result.low, result.high);
    complete(result.low, result.value);
    complete(result.high, result.value);
    complete(result.value, result.high);
    if (result.step) complete(*result.step, result.value);
    return result;
}

bool SetPointTable::decide(DeclaredSetPoint& declared, ValueKind kind, const Register* reg) {
    declared.is_decided = true;
    declared.point.kind = kind;
    declared.reg = reg;
    const std::size_t before = report_.error_count();
    const bool valued =
        kind == ValueKind::motor_register ? decide_register(declared, *reg) : decide_preset(declared);
    declared.is_sound = valued && is_sound_range(declared) && report_.error_count() == before;
    return declared.is_sound;
}

bool SetPointTable::decide_register(DeclaredSetPoint& declared, const Register& reg) {
    const auto literal = worked_out(*declared.written, &reg);
    if (!literal) return false;
    const ast::SetPoint& written = *literal;
    if (reg.number == registers::MODE_REG) {
        report_.add("E046", written.name.span,
                    "MODE_REG cannot be a set-point: a write to it starts the motor",
                    "select the mode in a step, with INIT, VELOCITY or POSITION");
        return false;
    }
    const std::string_view shown = written.name.text;
    const auto initial = values_.written_bits(written.value, reg, shown);
    const auto low = values_.written_bits(written.low, reg, shown);
    const auto high = values_.written_bits(written.high, reg, shown);
    if (!initial || !low || !high) return false;
    set_points::SetPoint& point = declared.point;
    const auto number = [&](std::uint32_t bits) {
        return static_cast<std::int32_t>(number_of_bits(bits, reg.format));
    };
    if (!is_for_drive_within(written, reg, number(*low), number(*high))) return false;
    point.reg = reg.number;
    point.longword = registers::is_32_bit(reg.format);
    point.unit_code = static_cast<std::uint8_t>(reg.unit);
    point.unit = written.value.is_time ? std::string_view("ms") : written.value.unit.text;
    point.initial = number(*initial);
    point.lowest = number(*low);
    point.highest = number(*high);
    point.steps_per_unit = written.value.is_raw ? 1 : motor_.per_unit(reg, point.unit).value_or(1);
    if (!written.step) return true;
    const auto step = motor_.per_unit(reg, written.step->unit.text);
    const bool same_unit = same_name(written.step->unit.text, point.unit) || written.step->is_raw;
    point.step = written.step->number * (same_unit ? 1 : step.value_or(0) / point.steps_per_unit);
    const auto per_unit = motor_.per_unit(reg, written.low.unit.text);
    const bool is_own = same_name(written.low.unit.text, point.unit) || written.low.is_raw || !per_unit;
    lay_grid(point, written.low.number * (is_own ? 1 : *per_unit / point.steps_per_unit));
    return true;
}

/// For the timer or the counter; 0 has no effect (001 §6.1.7).
bool SetPointTable::decide_preset(DeclaredSetPoint& declared) {
    const auto literal = worked_out(*declared.written, nullptr);
    if (!literal) return false;
    const ast::SetPoint& written = *literal;
    set_points::SetPoint& point = declared.point;
    const bool timer = point.kind == ValueKind::timer;
    const auto preset = [&](const ast::Value& value) -> std::optional<std::int32_t> {
        if (value.number <= 0) {
            report_.add("E047", value.span,
                        timer ? "a time begins at 1 ms: 0 does not set the timer"
                              : "a count begins at 1: 0 does not set the counter",
                        timer ? "write RANGE 1 ms .. and a branch of its own for no time at all"
                              : "write RANGE 1 .. and a branch of its own for none at all");
            return std::nullopt;
        }
        if (timer) return milliseconds_of(value, report_);
        if (value.unit.text.empty() && !value.is_time && is_whole(value.number) &&
            value.number <= kLongestPreset)
            return static_cast<std::int32_t>(value.number);
        const bool has_unit = value.is_time || !value.unit.text.empty();
        report_.add(
            "E063", value.span,
            has_unit ? fmt::format("'{}' is used for the counter, and {}", written.name.text,
                                   value.is_time ? std::string("a count is no time")
                                                 : fmt::format("a count has no unit: '{}'", value.unit.text))
                     : "the counter holds whole numbers 0..65535",
            has_unit ? "write the number alone, or use the set-point for the timer"
                     : "for more, count in tens or hundreds");
        return std::nullopt;
    };
    const auto initial = preset(written.value);
    const auto low = initial ? preset(written.low) : initial;
    const auto high = low ? preset(written.high) : low;
    if (!high) return false;
    point.unit_code = timer ? registers::set_points::kMilliseconds : registers::set_points::kCount;
    point.unit = timer ? (written.value.is_time ? "ms" : std::string(written.value.unit.text)) : "";
    point.initial = *initial;
    point.lowest = *low;
    point.highest = *high;
    point.steps_per_unit = same_name(point.unit, "s") ? 1000 : 1;
    if (!written.step) return true;
    const bool seconds = same_name(written.step->unit.text, "s");
    const bool same_unit = same_name(written.step->unit.text, point.unit);
    point.step = written.step->number * (same_unit ? 1 : (seconds ? 1000 : 1) / point.steps_per_unit);
    lay_grid(point, point.lowest / point.steps_per_unit);
    return true;
}

/// A drive that supports both ends may not support values near 0 between them: a speed too low for it.
bool SetPointTable::is_for_drive_within(const ast::SetPoint& written, const Register& reg, std::int32_t low,
                                        std::int32_t high) {
    if (motor_.drive() == nullptr) return true;
    for (const std::int32_t value : {-1, 0, 1}) {
        const Send send{&reg, 0, bits_of(value, reg), written.low.span};
        if (value <= low || value >= high || refusal_of(*motor_.drive(), send).empty()) continue;
        motor_.report_refusal(send, fmt::format("a {} cannot take all values of {}, those next to 0",
                                                motor_.name(), written.name.text));
        return false;
    }
    return true;
}

bool SetPointTable::is_sound_range(DeclaredSetPoint& declared) {
    const ast::SetPoint& written = *declared.written;
    const set_points::SetPoint& point = declared.point;
    if (point.lowest > point.highest) {
        report_.add("E047", written.high.span,
                    fmt::format("the range of '{}' ends before it begins", point.name),
                    fmt::format("write the lower end first: RANGE {} .. {}", text(written.high.span),
                                text(written.low.span)));
        return false;
    }
    if (point.initial < point.lowest || point.initial > point.highest) {
        report_
            .add("E047", written.value.span, fmt::format("'{}' begins outside of its range", point.name),
                 "the value behind := must lie in the RANGE")
            .notes.push_back({written.low.span, "the range begins here"});
        return false;
    }
    if (!written.step) return true;
    const double raw = point.step * point.steps_per_unit;
    if (raw >= 0.5 && raw <= point.highest - point.lowest) return is_default_on_grid(report_, declared);
    report_.add("E047", written.step->span,
                raw > 0 ? fmt::format("the STEP of '{}' does not fit its range", point.name)
                        : std::string("a STEP is above 0, in a unit of the value"),
                "leave STEP out: then every value of the range is allowed");
    return false;
}

}  // namespace nplc::seqc
