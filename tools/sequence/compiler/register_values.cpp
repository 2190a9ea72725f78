#include "compiler/register_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "compiler/drive.h"
#include "language/names.h"
#include "registers/details.h"
#include "symbols/commands.h"
#include "symbols/motors.h"

namespace nplc::seqc {
namespace {

using registers::Format;
using registers::Register;

constexpr std::uint8_t kLastReachable = 127;
constexpr double kWorthAWarning = 0.01;
constexpr double kShownWhole = 100'000;

/// Large numbers as integers, truncated towards zero so that the shown limit is valid.
std::string limit_text(double value) {
    if (std::fabs(value) >= kShownWhole || value == std::trunc(value))
        return fmt::format("{:.0f}", std::trunc(value));
    return fmt::format("{:.6g}", value);
}

/// "it takes INIT_MODE, V_MODE and others, or a constant from above"
std::string some_of(std::span<const std::string_view> names) {
    constexpr std::size_t kMost = 6;
    const auto shown = names.first(std::min(names.size(), kMost));
    return fmt::format("it takes {}{}, or a constant from above", fmt::join(shown, ", "),
                       shown.size() < names.size() ? " and others of the register map" : "");
}

/// HOME1_MODE for HOME_MODE, which has two parts with this mode.
std::string help_of_parts(registers::Model model, const Register* reg, std::string_view text) {
    std::vector<std::string> ways;
    if (reg == nullptr) return {};
    for (const registers::Field& field : registers::fields_of(model, reg->number)) {
        for (const registers::NamedValue& value : field.values) {
            if (same_name(value.name, text)) ways.push_back(fmt::format("{} = {}", field.name, value.name));
        }
    }
    if (ways.empty()) return {};
    return fmt::format("say of which part of {} it is: {}", reg->name, fmt::join(ways, " or "));
}

/// P9 and the like: not explained by a misspelling.
bool is_set_register(std::string_view name) {
    return name.size() == 2 && std::string_view("PVATLZpvatlz").find(name[0]) != std::string_view::npos &&
           name[1] >= '0' && name[1] <= '9';
}

bool begins_with(std::string_view unit, std::string_view length) {
    return unit.size() >= length.size() && same_name(unit.substr(0, length.size()), length);
}

bool is_reachable(Report& report, const Register* reg, Span span, std::string_view shown) {
    if (reg->number <= kLastReachable) return true;
    report.add(
        "E041", span,
        fmt::format("{} is register {}, and a table reaches 1..{}", shown, reg->number, kLastReachable),
        "set it with a register tool and save it in the motor");
    return false;
}

/// Without blanks.
std::string spelled_unit(std::string_view written) {
    std::string unit;
    for (const char c : written) {
        if (c > ' ') unit += c;
    }
    return same_name(unit, "count") ? "counts" : unit;
}

/// A position, velocity or acceleration to which SCALE applies.
bool is_of_machine(const Register& reg) {
    const auto selection = selection_of(reg.number);
    using table::Group;
    return (selection &&
            (selection->group == Group::p || selection->group == Group::v || selection->group == Group::a)) ||
           reg.number == registers::P_SOLL || reg.number == registers::V_SOLL ||
           reg.number == registers::A_SOLL || reg.number == registers::P_IST;
}

/// Four digits: 0.1953, 46.89, 16950.
std::string short_text(double value) {
    const double size = std::fabs(value);
    if (size < 1000) return fmt::format("{:.4g}", value);
    const double tens = std::pow(10.0, std::floor(std::log10(size)) - 3);
    return fmt::format("{:.0f}", std::round(value / tens) * tens);
}

/// 15.000 rpm/s
bool meant_as_thousands(std::string_view written) {
    const std::size_t point = written.find('.');
    if (point == std::string_view::npos || point == 0 || written.front() == '0') return false;
    const std::size_t end = std::min(written.find_first_not_of("0123456789", point + 1), written.size());
    return end - point == 4;
}

}  // namespace

std::uint32_t bits_of(std::int32_t number, const Register& reg) {
    const auto bits = static_cast<std::uint32_t>(number);
    return registers::is_32_bit(reg.format) ? bits : bits & 0xFFFFU;
}

double number_of_bits(double bits, Format format) {
    if (registers::is_32_bit(format)) return static_cast<std::int32_t>(static_cast<std::uint32_t>(bits));
    if (format == Format::word || bits > 0xFFFF) return bits;
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
}

void RegisterValues::declare_variables(const ast::Program& program) {
    for (const ast::Variable& variable : program.motor_variables) {
        const registers::Register* target =
            variable.register_number ? numbered(*variable.register_number) : named(variable.address);
        if (target == nullptr) names_.add_faulty(variable.name.text);
        if (!names_.is_new(variable.name) || target == nullptr) continue;
        const std::string_view shown = variable.register_number ? target->name : variable.address.text;
        const auto earlier = std::find_if(names_.registers().begin(), names_.registers().end(),
                                          [&](const DeclaredName& v) { return v.reg == target; });
        if (earlier != names_.registers().end()) {
            report_
                .add("E022", variable.name.span, fmt::format("{} has a name already", shown),
                     fmt::format("use '{}', or another register", earlier->name))
                .notes.push_back({earlier->span, "declared here"});
            names_.add_faulty(variable.name.text);
            continue;
        }
        names_.registers().push_back({variable.name.text, variable.name.span, 0, target});
        MotorName& named = result_.symbols.motor_names.emplace_back();
        named = {std::string(variable.name.text), std::string(target->name), target->number, {}};
        if (!variable.value) continue;
        names_.constants().name_registers(true);
        const auto bits = written_bits(*variable.value, *target, shown);
        names_.constants().name_registers(false);
        if (bits) {
            declare_value_of(variable, *target, *bits);
            const Span first = variable.name.span;
            const Span last = variable.value->span;
            initial_.push_back({target, 0, *bits, {first.offset, last.offset + last.length - first.offset}});
            named.initial = static_cast<std::int64_t>(number_of_bits(*bits, target->format));
        } else {
            names_.add_faulty(variable.name.text);  // as a value: other ones may be worked out from it
        }
    }
}

/// Later values may use the register's actual value, in the unit of its own value.
void RegisterValues::declare_value_of(const ast::Variable& variable, const registers::Register& reg,
                                      std::uint32_t bits) {
    const auto written = names_.constants().worked_out(*variable.value, &reg, motor_.model());
    if (!written || written->is_raw) return;
    const auto per_unit =
        motor_.per_unit(reg, written->is_time ? std::string_view("ms") : written->unit.text);
    if (!per_unit) return;
    ast::Value real = *written;
    real.number = number_of_bits(bits, reg.format) / *per_unit;
    real.span = variable.value->span;
    names_.constants().declare_register(variable.name, real);
}

const Register* RegisterValues::find(std::string_view name) const {
    if (const DeclaredName* variable = find_name(names_.registers(), name)) return variable->reg;
    return registers::find(motor_.model(), name);
}

const Register* RegisterValues::named(const ast::Name& name) {
    if (const Register* found = find(name.text)) {
        motor_.require(name.span);
        return is_reachable(report_, found, name.span, name.text) ? found : nullptr;
    }
    if (!names_.is_faulty(name.text)) report_no_register(name);
    return nullptr;
}

const Register* RegisterValues::numbered(const ast::Value& number) {
    motor_.require(number.span);
    const bool whole =
        number.unit.text.empty() && !number.is_time && std::floor(number.number) == number.number;
    if (!whole || number.number < 1 || number.number > kLastReachable) {
        report_.add("E041", number.span, fmt::format("a table reaches registers 1..{}", kLastReachable),
                    "set others with a register tool and save them in the motor");
        return nullptr;
    }
    const auto wanted = static_cast<std::uint8_t>(number.number);
    if (const Register* found = registers::find(motor_.model(), wanted)) return found;
    const Register* before = registers::find(motor_.model(), static_cast<std::uint8_t>(wanted - 1));
    const bool second_word = before != nullptr && registers::is_32_bit(before->format);
    report_.add("E040", number.span, fmt::format("{} has no register {}", motor_.name(), wanted),
                second_word
                    ? fmt::format("it is the upper half of {}: write REG({})", before->name, before->number)
                    : "the register map is in the motor's manual");
    return nullptr;
}

bool RegisterValues::is_set_point(std::string_view name) const {
    return std::ranges::any_of(names_.set_points(),
                               [&](std::string_view point) { return same_name(point, name); });
}

void RegisterValues::report_no_register(const ast::Name& name) {
    const std::string message = fmt::format("'{}' is no register of {}", name.text, motor_.name());
    for (registers::Model other : {registers::Model::mac140, registers::Model::mac800}) {
        if (registers::find(other, name.text) == nullptr || !motor_.is_known()) continue;
        report_
            .add("E040", name.span, message,
                 fmt::format("it is one of {}; REG(number) writes a register by its number",
                             registers::name_of(other)))
            .notes.push_back({motor_.span(), "the motor is chosen here"});
        return;
    }
    std::vector<std::string_view> names = {"TIMER", "COUNTER"};
    for (const DeclaredName& variable : names_.registers()) names.push_back(variable.name);
    for (const Register& r : registers::map_of(motor_.model())) names.push_back(r.name);
    std::string help = is_set_register(name.text)
                           ? "there are P1..P8, V1..V8, A1..A4, T1..T4, L1..L4 and Z1..Z4"
                           : suggestion(name.text, names);
    if (const std::string_view word = numbered_timer(name.text); !word.empty())
        help =
            fmt::format("there is one {0}: {0} := value; presets it, anew for each step that needs it", word);
    if (names_.is_output(name.text))
        help =
            fmt::format("write OUT {0}; in the step where it is on, or SET {0}; until RESET {0};", name.text);
    if (names_.is_input(name.text)) help = "an input is wired: it cannot be written";
    if (mode_named(name.text))
        help = fmt::format("{0} is a command: select a register that holds the value, as in POSITION(P1)",
                           upper(name.text));
    if (is_set_point(name.text))
        help = fmt::format(
            "it is a set-point without a register: only SET_POINT {} AT P3 := .. can be selected", name.text);
    if (help.empty())
        help =
            "declare it under VAR_MOTOR, or use the manual's name or REG(number); an output is declared "
            "under "
            "VAR_OUTPUT, and OUT, SET or RESET switches it";
    report_.add("E040", name.span, message, help);
}

std::optional<ast::Value> RegisterValues::worked_out(const ast::Value& value, const Register* reg) {
    if (value.kind == ast::Value::Kind::literal && names_.constants().is_empty()) return value;
    auto result = names_.constants().worked_out(value, reg, motor_.model());
    if (!result && names_.constants().unknown() != nullptr &&
        !names_.is_faulty(names_.constants().unknown()->text))
        report_no_value(*names_.constants().unknown(), reg);
    for (const Span made_good : names_.constants().registers_met()) {
        for (Rounding& rounding : result_.roundings)
            rounding.is_made_good = rounding.is_made_good || rounding.span == made_good;
    }
    return result;
}

std::optional<std::uint32_t> RegisterValues::written_bits(const ast::Value& written, const Register& reg,
                                                          std::string_view shown_name) {
    if (!motor_.is_on_drive(reg, written.span)) return std::nullopt;
    const auto result = worked_out(written, &reg);
    if (!result) return std::nullopt;
    const std::size_t roundings = result_.roundings.size();
    const bool makes_good =
        written.kind != ast::Value::Kind::literal && !names_.constants().registers_met().empty();
    const ast::Value& value = *result;
    double number = value.number;
    std::string_view unit = value.unit.text;
    if (value.is_time) unit = "ms";
    auto per_unit = motor_.per_unit(reg, unit);
    if (!per_unit && motor_.scale_is_missing() && !is_known_unit(unit)) return std::nullopt;
    if (!per_unit) {
        Diagnostic& d = report_.add("E043", value.unit.text.empty() ? value.span : value.unit.span,
                                    fmt::format("{} cannot be given in '{}'", shown_name, unit),
                                    unit_help(reg, number, unit));
        note_value(d, value, shown_name);
        return std::nullopt;
    }
    if (value.is_raw) {
        number = number_of_bits(number, reg.format);
        per_unit = 1;
    }
    const double exact = number * *per_unit;
    const double raw = std::round(exact);
    if (!(raw >= static_cast<double>(reg.min) && raw <= static_cast<double>(reg.max))) {
        const std::string_view shown = value.is_raw ? std::string_view() : unit;
        const double one = value.is_raw ? 1 : *per_unit;
        Diagnostic& d = report_.add(
            "E042", value.span, fmt::format("{} does not fit {}", text(value.span), shown_name),
            fmt::format("it takes {} .. {}{}{}", limit_text(static_cast<double>(reg.min) / one),
                        limit_text(static_cast<double>(reg.max) / one), shown.empty() ? "" : " ", shown));
        note_value(d, value, shown_name);
        return std::nullopt;
    }
    if (unit.empty() && !value.is_raw && raw != 0) warn_without_unit(value, reg, shown_name, raw);
    if (reg.dangerous) {
        report_.add("W003", value.span,
                    fmt::format("a wrong value in {} can damage the motor ({})", shown_name, reg.section),
                    "do not write it unless the manufacturer gave you the value");
    }
    const auto all_bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(raw));
    const std::uint32_t bits = registers::is_32_bit(reg.format) ? all_bits : all_bits & 0xFFFFU;
    const bool vanishes = raw == 0 && exact != 0;  // reported with the text for any motor
    if (!vanishes && !motor_.is_for_drive({&reg, 0, bits, value.span})) return std::nullopt;
    const bool by_drive = motor_.drive() != nullptr && raw != 0 &&
                          motor_.drive()->family->value_of(*motor_.drive(), reg, bits).has_value();
    if (by_drive)
        note_drive_value(value, reg, shown_name, exact, *per_unit, bits);
    else if (!note_rounding(value, reg, shown_name, exact, raw, *per_unit))
        return std::nullopt;
    for (std::size_t i = roundings; i < result_.roundings.size(); ++i)
        result_.roundings[i].makes_good = makes_good;
    result_.symbols.units.try_emplace(reg.number, value.is_raw ? std::string() : spelled_unit(unit));
    return bits;
}

std::string_view RegisterValues::kind_of(const ast::Value& value) const {
    constexpr std::pair<std::string_view, std::string_view> kKinds[] = {
        {"P1", "a position"}, {"V1", "a velocity"}, {"A1", "an acceleration"}};
    if (value.unit.text.empty()) return {};
    for (const auto& [name, kind] : kKinds) {
        const Register* reg = registers::find(motor_.model(), name);
        if (reg != nullptr && motor_.per_unit(*reg, value.unit.text)) return kind;
    }
    return {};
}

/// Reports a name where a value is required.
void RegisterValues::report_no_value(const ast::Name& name, const Register* reg) {
    const std::string_view text = name.text;
    if (report_.full_of_errors()) {  // not shown: a guess among many names would take long
        report_.add("E021", name.span, fmt::format("there is no constant '{}'", text));
        return;
    }
    std::vector<std::string_view> names = names_.constants().names();
    const std::size_t constants = names.size();
    if (reg != nullptr) {
        for (const registers::Field& field : registers::fields_of(motor_.model(), reg->number)) {
            if (field.width == 1 || field.values.empty()) names.push_back(field.name);
            for (const registers::NamedValue& one : field.values) names.push_back(one.name);
        }
    }
    if (is_set_point(text)) {
        report_.add(
            "E021", name.span, fmt::format("'{}' is a set-point, and a constant belongs here", text),
            "a set-point stands alone behind :=, without arithmetic; a time limit of the operator's is ENTRY "
            "TIMER := Limit; and TIMER.Q tested in the step, instead of WITHIN, FOR or BLINKING");
        return;
    }
    std::vector<std::string_view> meant = names;
    meant.insert(meant.end(), names_.set_points().begin(), names_.set_points().end());
    std::string help = suggestion(text, meant);
    if (find(text) != nullptr)
        help =
            "only constants can be written; a register's value is brought in by selecting it, as in "
            "POSITION(P1)";
    else if (steps_.has(text))
        help = fmt::format("a step is named with NEXT := {};", text);
    else if (names_.is_input(text) || names_.is_output(text))
        help = "a value is a number, a constant, or a mode or bit of the register";
    else if (const std::string parts = help_of_parts(motor_.model(), reg, text); !parts.empty())
        help = parts;
    else if (help.empty() && names.size() > constants)
        help = some_of(std::span(names).subspan(constants));
    else if (help.empty())
        help = fmt::format("declare it above: CONST {} := value;", text);
    report_.add("E021", name.span,
                reg != nullptr ? fmt::format("there is no constant '{}', and {} has no value of that name",
                                             text, reg->name)
                               : fmt::format("there is no constant '{}'", text),
                help);
}

/// Notes for a value's limits: the register behind a name, the length behind a unit.
void RegisterValues::note_value(Diagnostic& diagnostic, const ast::Value& value,
                                std::string_view shown) const {
    names_.note_declaration(diagnostic, shown);
    if (const ast::Constant* constant = names_.constants().find(value.name.text))
        diagnostic.notes.push_back({constant->name.span, fmt::format("'{}' is {}", constant->name.text,
                                                                     text(constant->value.span))});
    if (!motor_.length() || !begins_with(value.unit.text, motor_.length()->name)) return;
    diagnostic.notes.push_back(
        {motor_.scale_span(), fmt::format("1 rev is {:.6g} {} by this SCALE", motor_.length()->per_revolution,
                                          motor_.length()->name)});
}

std::string RegisterValues::unit_help(const Register& reg, double number, std::string_view unit) const {
    const std::vector<std::string> fitting = fitting_units(reg, motor_.length());
    constexpr std::string_view kPerMinute[] = {"tr/min", "r/min", "upm", "U/min", "turns/min"};
    const auto is_unit = [&](std::string_view known) { return same_name(known, unit); };
    if (std::ranges::any_of(kPerMinute, is_unit) && std::ranges::find(fitting, "rpm") != fitting.end())
        return fmt::format("write {:.9g} rpm", number);
    std::vector<std::string> machine_first(fitting.rbegin(), fitting.rend());
    if (const auto same = converted(number, unit, machine_first))
        return fmt::format("write {:.9g} {} (use {})", same->number, same->unit,
                           units_for(reg, motor_.length()));
    const std::string near = suggestion(unit, {fitting.begin(), fitting.end()});
    std::string units = fmt::format("use {}", units_for(reg, motor_.length()));
    if (unit == "ms" && reg.unit != registers::Unit::samples)
        units += "; the one timer is set with TIMER := T#500ms;";
    if (!near.empty()) return fmt::format("{} ({})", near, units);
    const bool could_scale = !motor_.length() && !fitting.empty() && reg.unit != registers::Unit::torque &&
                             reg.unit != registers::Unit::samples && !is_known_unit(unit);
    return could_scale ? units + "; SCALE 1 rev = 5 mm; at the top adds a unit of your machine" : units;
}

/// Warns: 80 may be counts or millimetres.
void RegisterValues::warn_without_unit(const ast::Value& value, const Register& reg,
                                       std::string_view shown_name, double raw) {
    if (!motor_.length() || !is_of_machine(reg) || !without_unit_.insert(std::string(shown_name)).second)
        return;
    const std::vector<std::string> units = fitting_units(reg, motor_.length());
    const std::string& machine = units.back();
    const auto per_unit = motor_.per_unit(reg, machine);
    if (!per_unit) return;
    const std::string in_steps =
        fmt::format("{:.0f} {}", raw, units.front() == "counts" ? "counts" : "steps");
    const std::string meant = fmt::format("{} {}", text(value.span), machine);
    const std::string equal = fmt::format("{} {}", short_text(raw / *per_unit), machine);
    Diagnostic& d = report_.add(
        "W039", value.span,
        fmt::format("a number without unit is the register's own: these {} are {}", in_steps, equal),
        units.front() == "counts"
            ? fmt::format("write {}, or {} where counts are meant", meant, in_steps)
            : fmt::format("write {}, or {} where the register's steps are meant", meant, equal));
    names_.note_declaration(d, shown_name);
}

/// False if the value is rounded to nothing: a motor without acceleration, for example, would never stop.
bool RegisterValues::note_rounding(const ast::Value& value, const Register& reg, std::string_view shown_name,
                                   double exact, double raw, double per_unit) {
    const double error = exact == 0 ? 0 : (raw - exact) / std::fabs(exact);
    if (std::fabs(error) < 1e-9) return true;
    const std::string_view unit = value.is_time ? std::string_view("ms") : value.unit.text;
    const std::string what = fmt::format("{} := {} is {} ({:.6g}{}{}, {:+.3f} %)", shown_name,
                                         text(value.span), static_cast<std::int64_t>(raw), raw / per_unit,
                                         unit.empty() ? "" : " ", unit, error * 100);
    const std::string step =
        fmt::format("one step of {} is {:.4g}{}{}", shown_name, 1 / per_unit, unit.empty() ? "" : " ", unit);
    if (raw == 0) {
        Diagnostic& d = report_.add(
            "E042", value.span,
            fmt::format("{} is too small for {}: it would become 0", text(value.span), shown_name),
            meant_as_thousands(text(value.span))
                ? "a point is a decimal point here: write thousands without one"
                : step + (motor_.takes_zero(reg) ? "; write at least that, or 0 if 0 is meant"
                                                 : "; write at least that"));
        note_value(d, value, shown_name);
        return false;
    }
    result_.roundings.push_back({value.span, what, exact - raw, per_unit, std::string(unit), exact < 0});
    if (std::fabs(error) > kWorthAWarning && !report_.has("W039", value.span)) {
        Diagnostic& d = report_.add("W002", value.span,
                                    fmt::format("the register is too coarse for this value: {}", what),
                                    meant_as_thousands(text(value.span))
                                        ? "a point is a decimal point here: write thousands without one"
                                        : step + "; write a multiple of it, or accept the difference");
        note_value(d, value, shown_name);
    }
    return true;
}

/// The converted value for the drive.
void RegisterValues::note_drive_value(const ast::Value& value, const Register& reg,
                                      std::string_view shown_name, double exact, double per_unit,
                                      std::uint32_t bits) {
    const auto drive = motor_.drive()->family->value_of(*motor_.drive(), reg, bits);
    if (!drive) return;
    const double error = exact == 0 ? 0 : (drive->raw - exact) / std::fabs(exact);
    const std::string_view unit = value.is_time ? std::string_view("ms") : value.unit.text;
    const std::string what =
        fmt::format("{} := {} is {}, on a {} {} ({:.6g}{}{}, {:+.3f} %)", shown_name, text(value.span),
                    static_cast<std::int64_t>(number_of_bits(bits, reg.format)), motor_.name(),
                    text_of(*drive), drive->raw / per_unit, unit.empty() ? "" : " ", unit, error * 100);
    // The gateway adds distances up in counts and rounds each target for the drive by itself.
    result_.roundings.push_back(
        {value.span, what, exact - number_of_bits(bits, reg.format), per_unit, std::string(unit), exact < 0});
    if (std::fabs(error) <= kWorthAWarning) return;
    Diagnostic& d =
        report_.add("W002", value.span, fmt::format("the drive is too coarse for this value: {}", what),
                    "write the rounded value, or accept the difference");
    note_value(d, value, shown_name);
}

}  // namespace nplc::seqc
