#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "compiler/drive.h"
#include "compiler/scope.h"
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

}  // namespace

double number_of_bits(double bits, Format format) {
    if (registers::is_32_bit(format)) return static_cast<std::int32_t>(static_cast<std::uint32_t>(bits));
    if (format == Format::word || bits > 0xFFFF) return bits;
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
}

std::string Scope::motor_name() const {
    return std::string(seqc::motor_name(result_.symbols));
}

bool Scope::is_for_drive(const Send& send) {
    if (drive_ == nullptr || refusal_of(*drive_, send).empty()) return true;
    report_refusal(
        send, send.reg != nullptr
                  ? fmt::format("a {} cannot take {} for {}", motor_name(), text(send.span), send.reg->name)
                  : fmt::format("a {} cannot execute {}", motor_name(), describe_command(send.command)));
    return false;
}

void Scope::report_refusal(const Send& send, std::string message) {
    report_.add("E044", send.span, std::move(message), std::string(refusal_of(*drive_, send)))
        .notes.push_back({motor_span_, "the drive is chosen here"});
}

/// Whether the drive has the register at all, for any value.
bool Scope::is_on_drive(const Register& reg, Span span) {
    if (drive_ == nullptr) return true;
    const Send zero{&reg, 0, 0, span};
    const Send one{&reg, 0, 1, span};
    const registers::Refusal why = refusal_of(*drive_, zero);
    if (why.empty() || why != refusal_of(*drive_, one)) return true;
    report_refusal(zero, fmt::format("a {} has no {}", motor_name(), reg.name));
    return false;
}

/// The converted value for the drive.
void Scope::note_drive_value(const ast::Value& value, const Register& reg, std::string_view shown_name,
                             double exact, double per_unit, std::uint32_t bits) {
    const auto drive = drive_->family->value_of(*drive_, reg, bits);
    if (!drive) return;
    const double error = exact == 0 ? 0 : (drive->raw - exact) / std::fabs(exact);
    const std::string_view unit = value.is_time ? std::string_view("ms") : value.unit.text;
    const std::string what =
        fmt::format("{} := {} is {}, on a {} {} ({:.6g}{}{}, {:+.3f} %)", shown_name, text(value.span),
                    static_cast<std::int64_t>(number_of_bits(bits, reg.format)), motor_name(),
                    text_of(*drive), drive->raw / per_unit, unit.empty() ? "" : " ", unit, error * 100);
    // The gateway adds distances up in counts and rounds each target for the drive by itself.
    result_.roundings.push_back(
        {value.span, what, exact - number_of_bits(bits, reg.format), per_unit, std::string(unit), exact < 0});
    if (std::fabs(error) <= kWorthAWarning) return;
    Diagnostic& d =
        report_.add("W002", value.span, fmt::format("the drive is too coarse for this value: {}", what),
                    "write what it will be, or live with the difference");
    note_value(d, value, shown_name);
}

void Scope::note_declaration(Diagnostic& diagnostic, std::string_view name) const {
    const Variable* variable = find(motor_variables_, name);
    if (variable == nullptr) return;
    diagnostic.notes.push_back(
        {variable->span, fmt::format("'{}' is {}, declared here", variable->name, variable->reg->name)});
}

/// Notes for a value's limits: the register behind a name, the length behind a unit.
void Scope::note_value(Diagnostic& diagnostic, const ast::Value& value, std::string_view shown) const {
    note_declaration(diagnostic, shown);
    if (const ast::Constant* constant = constants_.find(value.name.text))
        diagnostic.notes.push_back({constant->name.span, fmt::format("'{}' is {}", constant->name.text,
                                                                     text(constant->value.span))});
    if (!length_ || !begins_with(value.unit.text, length_->name)) return;
    diagnostic.notes.push_back({scale_span_, fmt::format("1 rev is {:.6g} {} by this SCALE",
                                                         length_->per_revolution, length_->name)});
}

std::string Scope::unit_help(const Register& reg, std::string_view unit) const {
    const std::vector<std::string> fitting = fitting_units(reg, length_);
    const std::string near = suggestion(unit, {fitting.begin(), fitting.end()});
    std::string units = fmt::format("use {}", units_for(reg, length_));
    if (unit == "ms" && reg.unit != registers::Unit::samples)
        units += "; the one timer is set with TIMER := T#500ms;";
    if (!near.empty()) return fmt::format("{} ({})", near, units);
    const bool could_scale = !length_ && !fitting.empty() && reg.unit != registers::Unit::torque &&
                             reg.unit != registers::Unit::samples && !is_known_unit(unit);
    return could_scale ? units + "; SCALE 1 rev = 5 mm; at the top adds a unit of your machine" : units;
}

void Scope::require_motor(Span span) {
    if (motor_known_) return;
    motor_known_ = true;
    report_.add("E031", span, "which motor is this register's?", "name it at the top: MOTOR MAC140;");
}

bool Scope::is_reachable(const Register* reg, Span span, std::string_view shown) {
    if (reg->number <= kLastReachable) return true;
    report_.add(
        "E041", span,
        fmt::format("{} is register {}, and a table reaches 1..{}", shown, reg->number, kLastReachable),
        "set it with a register tool and save it in the motor");
    return false;
}

const Register* Scope::find_register(std::string_view name) const {
    if (const Variable* variable = find(motor_variables_, name)) return variable->reg;
    return registers::find(model_, name);
}

const Register* Scope::reg(const ast::Name& name) {
    if (const Register* found = find_register(name.text)) {
        require_motor(name.span);
        return is_reachable(found, name.span, name.text) ? found : nullptr;
    }
    if (!is_faulty(name.text)) report_no_register(name);
    return nullptr;
}

void Scope::report_no_register(const ast::Name& name) {
    const std::string message = fmt::format("'{}' is no register of {}", name.text, motor_name());
    for (registers::Model other : {registers::Model::mac140, registers::Model::mac800}) {
        if (registers::find(other, name.text) == nullptr || !motor_known_) continue;
        report_
            .add("E040", name.span, message,
                 fmt::format("it is one of {}; REG(number) writes a register by its number",
                             registers::name_of(other)))
            .notes.push_back({motor_span_, "the motor is chosen here"});
        return;
    }
    std::vector<std::string_view> names = {"TIMER", "COUNTER"};
    for (const Variable& variable : motor_variables_) names.push_back(variable.name);
    for (const Register& r : registers::map_of(model_)) names.push_back(r.name);
    std::string help = is_set_register(name.text)
                           ? "there are P1..P8, V1..V8, A1..A4, T1..T4, L1..L4 and Z1..Z4"
                           : suggestion(name.text, names);
    if (const std::string_view word = numbered_timer(name.text); !word.empty())
        help =
            fmt::format("there is one {0}: {0} := value; presets it, anew for each step that needs it", word);
    if (is_output(name.text)) help = fmt::format("to switch an output: OUT {}; in the step", name.text);
    if (is_input(name.text)) help = "an input is wired: it cannot be written";
    if (mode_named(name.text))
        help = fmt::format("{0} is a command: select a register that holds the value, as in POSITION(P1)",
                           upper(name.text));
    if (help.empty())
        help =
            "declare it under VAR_MOTOR, or use the manual's name or REG(number); an output is declared "
            "under "
            "VAR_OUTPUT, and OUT, SET or RESET switches it";
    report_.add("E040", name.span, message, help);
}

const Register* Scope::reg(const ast::Value& number) {
    require_motor(number.span);
    const bool whole =
        number.unit.text.empty() && !number.is_time && std::floor(number.number) == number.number;
    if (!whole || number.number < 1 || number.number > kLastReachable) {
        report_.add("E041", number.span, fmt::format("a table reaches registers 1..{}", kLastReachable),
                    "set others with a register tool and save them in the motor");
        return nullptr;
    }
    const auto wanted = static_cast<std::uint8_t>(number.number);
    if (const Register* found = registers::find(model_, wanted)) return found;
    const Register* before = registers::find(model_, static_cast<std::uint8_t>(wanted - 1));
    const bool second_word = before != nullptr && registers::is_32_bit(before->format);
    report_.add("E040", number.span, fmt::format("{} has no register {}", motor_name(), wanted),
                second_word
                    ? fmt::format("it is the upper half of {}: write REG({})", before->name, before->number)
                    : "the register map is in the motor's manual");
    return nullptr;
}

std::optional<ast::Value> Scope::worked_out(const ast::Value& value, const Register* reg) {
    if (value.kind == ast::Value::Kind::literal && constants_.is_empty()) return value;
    auto result = constants_.worked_out(value, reg, model_);
    if (!result && constants_.unknown() != nullptr && !is_faulty(constants_.unknown()->text))
        report_no_value(*constants_.unknown(), reg);
    for (const Span made_good : constants_.registers_met()) {
        for (Rounding& rounding : result_.roundings)
            rounding.is_made_good = rounding.is_made_good || rounding.span == made_good;
    }
    return result;
}

std::string_view Scope::kind_of(const ast::Value& value) const {
    constexpr std::pair<std::string_view, std::string_view> kKinds[] = {
        {"P1", "a position"}, {"V1", "a velocity"}, {"A1", "an acceleration"}};
    if (value.unit.text.empty()) return {};
    for (const auto& [name, kind] : kKinds) {
        const Register* reg = registers::find(model_, name);
        if (reg != nullptr && raw_per_unit(*reg, model_, length_, value.unit.text)) return kind;
    }
    return {};
}

/// Reports a name where a value is required.
void Scope::report_no_value(const ast::Name& name, const Register* reg) {
    const std::string_view text = name.text;
    std::vector<std::string_view> names = constants_.names();
    const std::size_t constants = names.size();
    if (reg != nullptr) {
        for (const registers::Field& field : registers::fields_of(model_, reg->number)) {
            if (field.width == 1 || field.values.empty()) names.push_back(field.name);
            for (const registers::NamedValue& one : field.values) names.push_back(one.name);
        }
    }
    if (std::any_of(set_points_.begin(), set_points_.end(), [&](const DeclaredSetPoint& declared) {
            return same_name(declared.written->name.text, text);
        })) {
        report_.add(
            "E021", name.span, fmt::format("'{}' is a set-point, and a constant belongs here", text),
            "a set-point is for := alone; a time limit of the operator's is ENTRY TIMER := Limit; and "
            "TIMER.Q tested in the step, instead of WITHIN, FOR or BLINKING");
        return;
    }
    std::vector<std::string_view> meant = names;
    for (const DeclaredSetPoint& declared : set_points_) meant.push_back(declared.written->name.text);
    std::string help = suggestion(text, meant);
    if (find_register(text) != nullptr)
        help =
            "only constants can be written; a register's value is brought in by selecting it, as in "
            "POSITION(P1)";
    else if (is_step(text))
        help = fmt::format("a step is named with NEXT := {};", text);
    else if (is_input(text) || is_output(text))
        help = "a value is a number, a constant, or a mode or bit of the register";
    else if (const std::string parts = help_of_parts(model_, reg, text); !parts.empty())
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

namespace {

/// Without blanks.
std::string spelled_unit(std::string_view written) {
    std::string unit;
    for (const char c : written) {
        if (c > ' ') unit += c;
    }
    return same_name(unit, "count") ? "counts" : unit;
}

}  // namespace

std::optional<std::uint32_t> Scope::value(const ast::Value& written, const Register& reg,
                                          std::string_view shown_name) {
    if (!is_on_drive(reg, written.span)) return std::nullopt;
    const auto result = worked_out(written, &reg);
    if (!result) return std::nullopt;
    const std::size_t roundings = result_.roundings.size();
    const bool makes_good = written.kind != ast::Value::Kind::literal && !constants_.registers_met().empty();
    const ast::Value& value = *result;
    double number = value.number;
    std::string_view unit = value.unit.text;
    if (value.is_time) unit = "ms";
    auto per_unit = raw_per_unit(reg, model_, length_, unit);
    if (!per_unit && scale_missing_ && !is_known_unit(unit)) return std::nullopt;
    if (!per_unit) {
        Diagnostic& d =
            report_.add("E043", value.unit.text.empty() ? value.span : value.unit.span,
                        fmt::format("{} cannot be given in '{}'", shown_name, unit), unit_help(reg, unit));
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
                    "leave it alone unless its maker told you the value");
    }
    const auto all_bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(raw));
    const std::uint32_t bits = registers::is_32_bit(reg.format) ? all_bits : all_bits & 0xFFFFU;
    const bool vanishes = raw == 0 && exact != 0;  // reported with the text for any motor
    if (!vanishes && !is_for_drive({&reg, 0, bits, value.span})) return std::nullopt;
    const bool by_drive =
        drive_ != nullptr && raw != 0 && drive_->family->value_of(*drive_, reg, bits).has_value();
    if (by_drive)
        note_drive_value(value, reg, shown_name, exact, *per_unit, bits);
    else if (!note_rounding(value, reg, shown_name, exact, raw, *per_unit))
        return std::nullopt;
    for (std::size_t i = roundings; i < result_.roundings.size(); ++i)
        result_.roundings[i].makes_good = makes_good;
    result_.symbols.units.try_emplace(reg.number, value.is_raw ? std::string() : spelled_unit(unit));
    return bits;
}

namespace {

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

}  // namespace

/// Warns: 80 may be counts or millimetres.
void Scope::warn_without_unit(const ast::Value& value, const Register& reg, std::string_view shown_name,
                              double raw) {
    if (!length_ || !is_of_machine(reg) || !without_unit_.insert(std::string(shown_name)).second) return;
    const std::vector<std::string> units = fitting_units(reg, length_);
    const std::string& machine = units.back();
    const auto per_unit = raw_per_unit(reg, model_, length_, machine);
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
    note_declaration(d, shown_name);
}

namespace {

/// 15.000 rpm/s
bool meant_as_thousands(std::string_view written) {
    const std::size_t point = written.find('.');
    if (point == std::string_view::npos || point == 0 || written.front() == '0') return false;
    const std::size_t end = std::min(written.find_first_not_of("0123456789", point + 1), written.size());
    return end - point == 4;
}

}  // namespace

bool Scope::takes_zero(const Register& reg) const {
    return drive_ == nullptr || refusal_of(*drive_, {&reg, 0, 0, {}}).empty();
}

/// False if the value is rounded to nothing: a motor without acceleration, for example, would never stop.
bool Scope::note_rounding(const ast::Value& value, const Register& reg, std::string_view shown_name,
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
                : step + (takes_zero(reg) ? "; write at least that, or 0 if you mean 0"
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
                                        : step + "; write a multiple of it, or live with the difference");
        note_value(d, value, shown_name);
    }
    return true;
}

}  // namespace nplc::seqc
