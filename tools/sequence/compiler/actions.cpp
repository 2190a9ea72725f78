#include "compiler/actions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "language/names.h"

namespace nplc::seqc {
namespace {

using ast::Statement;
using set_points::ValueKind;
using table::Group;
using table::Mode;

constexpr double kLongest = 65'535;

/// Order of selections: a move begins with its P, a speed with its V, so that each starts with the required
/// values.
int rank(Group group, Mode mode) {
    if (group == Group::p) return 2;
    if (group == Group::v && mode == Mode::velocity) return 0;
    return 1;
}

void conflict(Report& report, Span span, const char* what, Span entry) {
    report
        .add("E061", span, fmt::format("{} twice in the same scan", what),
             "only the last would count: keep one, here or in the ENTRY")
        .notes.push_back({entry, "the ENTRY of the step that is entered does it too"});
}

/// SET and RESET are idempotent.
bool is_switch(const Statement& statement) {
    return statement.kind == Statement::Kind::set_outputs || statement.kind == Statement::Kind::reset_outputs;
}

bool uses_counter(const Action& action) {
    return action.counter || action.counts();
}

/// 0, or what is rounded to it.
std::optional<std::uint16_t> report_no_time(Span span, Report& report, TimeFor use) {
    switch (use) {
        case TimeFor::preset:
            report.add("W007", span, "the timer cannot be set to 0: it becomes 1 ms", "write T#1ms");
            break;
        case TimeFor::limit:
            report.add("W007", span,
                       "a time limit of 0 is over as soon as the step is entered: it becomes 1 ms",
                       "write how long it may take, as in WITHIN T#3s");
            break;
        case TimeFor::lasting:
            report.add("W007", span, "a condition that lasts for 0 holds at once: this waits for 1 ms",
                       "leave FOR and its time out, or write how long it lasts, as in FOR 200 ms");
            break;
        case TimeFor::blinking:
            report.add("E062", span,
                       "BLINKING needs a time above 0: the output is on for it, and then off for it",
                       "write a time, as in BLINKING T#500ms; or leave BLINKING out: then it is on");
            return std::nullopt;
    }
    return std::uint16_t{1};
}

/// Of a unit that others write; 0: none.
double unit_in_ms(std::string_view unit) {
    constexpr std::pair<std::string_view, double> kUnits[] = {
        {"min", 60'000},  {"sec", 1000},     {"secs", 1000},     {"sek", 1000},
        {"second", 1000}, {"seconds", 1000}, {"sekunden", 1000}, {"msec", 1},
        {"msek", 1},      {"millis", 1},     {"milliseconds", 1}};
    for (const auto& [name, ms] : kUnits) {
        if (same_name(name, unit)) return ms;
    }
    return 0;
}

/// Of a number without a unit, which is most likely meant in milliseconds or, if it is small, in seconds.
std::string in_milliseconds(const ast::Value& value) {
    const bool is_plain = value.kind == ast::Value::Kind::literal && value.unit.text.empty() &&
                          !value.is_raw && value.number >= 1 && value.number <= kLongest &&
                          std::floor(value.number) == value.number;
    const auto fits = [](double ms) { return ms >= 1 && ms <= kLongest; };
    const double unit = unit_in_ms(value.unit.text);
    const double ms = value.number * unit;
    if (fits(ms))
        return unit == 1 ? fmt::format("write {:.9g} ms", ms) : fmt::format("write {:.9g} s", ms / 1000);
    if (ms > kLongest)
        return "write it in s, up to 65 s; for longer times let the counter count repetitions of a shorter "
               "one";
    if (same_name(value.unit.text, "us")) return "write 1 ms or more";
    if (same_name(value.unit.text, "Hz") && value.number > 0 && fits(500 / value.number))
        return fmt::format("write T#{:.0f}ms, half of the period", 500 / value.number);
    if (!is_plain) return "write it as T#500ms";
    const std::string seconds = value.number <= kLongest / 1000.0
                                    ? fmt::format(", or T#{}s if they are seconds", value.number)
                                    : std::string();
    return fmt::format("write T#{}ms if these are milliseconds{}", value.number, seconds);
}

}  // namespace

std::optional<std::uint16_t> milliseconds_of(const ast::Value& value, Report& report, TimeFor use) {
    double ms = value.number;
    const bool seconds = same_name(value.unit.text, "s");
    if (!value.is_time && !seconds && !same_name(value.unit.text, "ms")) {
        const bool minutes = same_name(value.unit.text, "min");
        const bool is_short = same_name(value.unit.text, "us");
        report.add("E043", value.span,
                   minutes    ? "times are in ms and s"
                   : is_short ? "the timer counts milliseconds"
                              : "the timer needs a time",
                   in_milliseconds(value));
        return std::nullopt;
    }
    if (seconds) ms *= 1000;
    const double rounded = std::round(ms);
    if (rounded < 0) {
        report.add("E062", value.span, "a time is not negative", "write a time from 1 ms to T#65s535ms");
        return std::nullopt;
    }
    if (!(rounded >= 0 && rounded <= kLongest)) {
        report.add("E062", value.span, "the timer holds at most T#65s535ms",
                   "for longer times let the counter count repetitions of a shorter one");
        return std::nullopt;
    }
    if (rounded == 0) {
        return report_no_time(value.span, report, use);
    }
    if (std::fabs(rounded - ms) > 0.01 * ms) {
        report.add("W002", value.span,
                   fmt::format("the timer counts whole milliseconds: this becomes {} ms", rounded),
                   fmt::format("write T#{}ms if that will do", rounded));
    }
    return static_cast<std::uint16_t>(rounded);
}

bool Action::same_effect(const Action& other) const {
    return next == other.next && timer == other.timer && counter == other.counter &&
           timer_point == other.timer_point && counter_point == other.counter_point &&
           clears_counter == other.clears_counter && counts_down == other.counts_down &&
           outputs == other.outputs && sets == other.sets && resets == other.resets &&
           std::equal(sends.begin(), sends.end(), other.sends.begin(), other.sends.end(),
                      [](const Send& a, const Send& b) { return a.same_effect(b); });
}

void add_switches(Action& action, const Action& more, const char* note, Report& report) {
    if (more.switches() && ((action.sets & more.resets) != 0 || (action.resets & more.sets) != 0)) {
        report
            .add("E061", action.output_span, "an output is set and reset in the same scan",
                 "keep one, here or in the ENTRY")
            .notes.push_back({more.output_span, note});
        return;
    }
    if (!action.switches()) action.output_span = more.output_span;
    action.sets |= more.sets;
    action.resets |= more.resets;
}

Action ActionBuilder::build(const std::vector<Statement>& statements) {
    for (const Statement& statement : statements) {
        add(statement);
        if (statement.kind != Statement::Kind::next) action_.statements.push_back(statement.span);
    }
    if (!statements.empty()) {
        const Span first = statements.front().span;
        const Span last = statements.back().span;
        action_.span = {first.offset, last.offset + last.length - first.offset};
    }
    return action_;
}

void ActionBuilder::add(const Statement& statement) {
    if (statement.every_scan && !marked_ && statement.kind != Statement::Kind::next && !is_switch(statement))
        marked_ = statement.every_scan_span;
    const std::size_t errors_before = scope_.report().error_count() + scope_.faulty_names_met();
    add_by_kind(statement);
    const bool sound = scope_.report().error_count() + scope_.faulty_names_met() == errors_before;
    const bool may_repeat = statement.kind == Statement::Kind::next || is_switch(statement);
    if (sound && !statement.every_scan && !unmarked_ && !may_repeat) unmarked_ = statement.span;
}

void ActionBuilder::add_by_kind(const Statement& statement) {
    switch (statement.kind) {
        case Statement::Kind::next:
            return add_next(statement);
        case Statement::Kind::command:
            return add_command(statement);
        case Statement::Kind::assign:
            return add_assignment(statement, scope_.reg(statement.name), statement.name.text);
        case Statement::Kind::assign_number:
            return add_assignment(statement, scope_.reg(*statement.register_number), {});
        case Statement::Kind::timer:
            return add_timer(statement);
        case Statement::Kind::counter:
            return add_counter(statement);
        case Statement::Kind::count_down:
            if (once(uses_counter(action_), statement, "the counter is changed", action_.counter_span))
                action_.counts_down = true;
            return;
        case Statement::Kind::clear_counter:
            if (once(uses_counter(action_), statement, "the counter is changed", action_.counter_span))
                action_.clears_counter = true;
            return;
        case Statement::Kind::set_outputs:
        case Statement::Kind::reset_outputs:
            return add_switch(statement);
        case Statement::Kind::call:
        case Statement::Kind::go_back:
            return;  // errors in the rest were reported
    }
}

void warn_named_twice(const std::vector<ast::Name>& outputs, Scope& scope) {
    std::array<const ast::Name*, 4> first{};
    for (const ast::Name& name : outputs) {
        const auto bit = scope.output(name);
        if (!bit) continue;
        if (first.at(*bit) != nullptr)
            scope.report()
                .add("W008", name.span, fmt::format("'{}' is named twice here", name.text), "name it once")
                .notes.push_back({first.at(*bit)->span, "the first time"});
        first.at(*bit) = &name;
    }
}

void ActionBuilder::add_switch(const Statement& statement) {
    if (statement.every_scan) {
        scope_.report().add("W006", statement.every_scan_span, "an output that is set stays on by itself",
                            "leave EVERY_SCAN out");
    }
    warn_named_twice(statement.arguments, scope_);
    for (const ast::Name& name : statement.arguments) {
        const auto bit = scope_.output(name);
        if (!bit) continue;
        Action one;
        (statement.kind == Statement::Kind::set_outputs ? one.sets : one.resets) =
            static_cast<std::uint8_t>(1U << *bit);
        one.output_span = statement.span;
        add_switches(action_, one, "the other one is here", scope_.report());
    }
}

bool ActionBuilder::once(bool already, const Statement& statement, const char* what, Span& place) {
    if (!already) {
        place = statement.span;
        return true;
    }
    scope_.report()
        .add("E061", statement.span, fmt::format("{} twice in the same branch", what),
             "only the last would count: keep one")
        .notes.push_back({place, "the first one is here"});
    return false;
}

void ActionBuilder::add_next(const Statement& statement) {
    if (statement.every_scan) {
        scope_.report().add("E064", statement.every_scan_span, "EVERY_SCAN does not go with NEXT",
                            "leave it out");
    }
    const bool to_power_up = same_name(statement.name.text, "POWER_UP");
    if (const ast::Step* zero = scope_.step_numbered(0); to_power_up && zero != nullptr) {
        scope_.report()
            .add("E096", statement.name.span,
                 fmt::format("there is no POWER_UP: '{}' is what power-up starts in", zero->name.text),
                 fmt::format("write NEXT := {};", zero->name.text))
            .notes.push_back({zero->name.span, "it has the number 0"});
    }
    const auto number = to_power_up ? std::optional<std::uint8_t>(0) : scope_.step(statement.name);
    if (!once(action_.next.has_value(), statement, "NEXT is set", action_.next_span)) return;
    // An unknown step was reported; 62 keeps it a branch that leaves its step.
    action_.next = number.value_or(sequencer::kNoSwitch);
}

void ActionBuilder::add_assignment(const Statement& statement, const registers::Register* reg,
                                   std::string_view shown) {
    if (reg == nullptr) return;
    if (scope_.is_set_point(statement.value)) {
        const std::uint8_t number = scope_.set_point_for(statement.value, ValueKind::motor_register, reg);
        if (number != 0)
            add_send({reg, 0, bits_of(scope_.set_point(number).initial, *reg), statement.span, number});
        return;
    }
    if (scope_.refuse_write(*reg, statement.span)) return;
    if (const auto bits = scope_.value(statement.value, *reg, shown.empty() ? reg->name : shown)) {
        add_send({reg, 0, *bits, statement.span});
    }
}

void ActionBuilder::add_send(const Statement& statement, std::uint8_t command) {
    const Send send{nullptr, command, 0, statement.span};
    if (scope_.is_for_drive(send)) add_send(send);
}

/// Each takes at least one term.
void ActionBuilder::add_send(const Send& send) {
    if (action_.sends.size() + 1 < kTermsEverywhere) {
        action_.sends.push_back(send);
    } else if (!scope_.report().has("E086")) {
        scope_.report().add("E086", send.span,
                            fmt::format("more than {} commands and values in one scan: a gateway need not "
                                        "hold more than {} terms",
                                        kTermsEverywhere - 1, kTermsEverywhere),
                            "send less, or spread it over several steps");
    }
}

void ActionBuilder::add_command(const Statement& statement) {
    if (const auto mode = mode_named(statement.name.text)) return add_selections(statement, *mode);
    if (same_name(statement.name.text, "USE_SET")) return add_use_set(statement);
    const NamedCommand* command = find_command(statement.name.text);
    if (command == nullptr) {
        std::string help = suggestion(statement.name.text, command_names());
        if (scope_.find_register(statement.name.text) != nullptr)
            help = "to write a register: Name := value;";
        if (scope_.is_input(statement.name.text)) help = "inputs are tested: IF Name THEN ... END_IF";
        if (scope_.is_output(statement.name.text))
            help = fmt::format("to switch an output: OUT {}; in the step", statement.name.text);
        if (scope_.is_step(statement.name.text))
            help = fmt::format("to go to the step: NEXT := {};", statement.name.text);
        if (help.empty())
            help =
                "motor commands are INIT(..), VELOCITY(..), POSITION(..), STOP, HOME, RESET_ERROR and "
                "others; "
                "`seqc explain E021` lists them";
        scope_.report().add("E021", statement.name.span,
                            fmt::format("there is no command '{}'", statement.name.text), help);
        return;
    }
    if (command->is_of_link) {
        scope_.report().add("E051", statement.span, fmt::format("a sequence cannot send {}", command->name),
                            std::string(kLinkRefusal));
        return;
    }
    if (statement.has_arguments) {
        scope_.report().add("E050", statement.span,
                            fmt::format("{} takes nothing in parentheses", command->name),
                            fmt::format("write {};", command->name));
        return;
    }
    add_send(statement, command->command);
}

void ActionBuilder::add_use_set(const Statement& statement) {
    const bool sound = statement.arguments.size() == 1 && statement.arguments[0].text.size() == 1 &&
                       statement.arguments[0].text[0] >= '1' && statement.arguments[0].text[0] <= '4';
    if (!sound) {
        scope_.report().add("E050", statement.span, "USE_SET takes the number of a register set, 1..4",
                            "write USE_SET(1);");
        return;
    }
    add_send(statement, table::use_set(static_cast<std::uint8_t>(statement.arguments[0].text[0] - '0')));
}

/// POSITION(Pitch), with CONST Pitch.
bool ActionBuilder::refuse_constant(const ast::Name& name, Mode mode) {
    const ast::Constant* constant = scope_.constant(name.text);
    if (constant == nullptr || scope_.report().has("E020")) return false;  // the name may also be a register
    const std::string_view command = mode == Mode::position   ? "POSITION"
                                     : mode == Mode::velocity ? "VELOCITY"
                                                              : "INIT";
    const std::string_view kind = scope_.kind_of(constant->value);
    const std::string_view wanted = mode == Mode::position   ? "a position"
                                    : mode == Mode::velocity ? "a velocity"
                                                             : kind;
    const char* place = kind == "a velocity" ? "V1" : kind == "an acceleration" ? "A1" : "P1";
    const bool fits = kind.empty() || kind == wanted;
    scope_.report()
        .add(
            "E050", name.span,
            fmt::format("{} selects a register, and '{}' is a constant{}{}", command, name.text,
                        kind.empty() ? "" : ", ", kind),
            fits
                ? fmt::format(
                      "give a register this value in VAR_MOTOR, as in Place AT {} := {}; and write {}(Place)",
                      place, name.text, command)
                : fmt::format("it needs {}: name a register of VAR_MOTOR that holds one", wanted))
        .notes.push_back({constant->name.span, "the constant is here"});
    return true;
}

void ActionBuilder::add_selections(const Statement& statement, Mode mode) {
    if (statement.arguments.empty()) {
        scope_.report().add("E050", statement.span,
                            fmt::format("{} needs the registers to select", upper(statement.name.text)),
                            fmt::format("name at least one, as in {}({}1)", upper(statement.name.text),
                                        mode == Mode::position ? 'P' : 'V'));
        return;
    }
    std::vector<Selection> selections;
    std::vector<Span> places;
    for (const ast::Name& argument : statement.arguments) {
        if (argument.text.front() >= '0' && argument.text.front() <= '9') {
            scope_.report().add("E050", argument.span,
                                fmt::format("{} takes a register, not a value", upper(statement.name.text)),
                                fmt::format("name a register with this value in VAR_MOTOR, as in Place AT P1 "
                                            ":= 80 mm; and write {}(Place)",
                                            upper(statement.name.text)));
            continue;
        }
        if (scope_.find_register(argument.text) == nullptr && refuse_constant(argument, mode)) continue;
        const registers::Register* reg = scope_.reg(argument);
        if (reg == nullptr) continue;
        const auto selection = selection_of(reg->number);
        if (!selection) {
            Diagnostic& d = scope_.report().add(
                "E050", argument.span, fmt::format("{} cannot be selected", argument.text),
                "registers to select are P1..P8, V1..V8, A1..A4, T1..T4, L1..L4 and Z1..Z4");
            scope_.note_declaration(d, argument.text);
            continue;
        }
        const auto earlier = std::find_if(selections.begin(), selections.end(),
                                          [&](const Selection& s) { return s.group == selection->group; });
        if (earlier != selections.end()) {
            scope_.report()
                .add("E050", argument.span, "two registers of the same kind cannot be selected at once",
                     "keep one of them")
                .notes.push_back({places[static_cast<std::size_t>(earlier - selections.begin())],
                                  "the first one is here"});
            continue;
        }
        selections.push_back(*selection);
        places.push_back(argument.span);
    }
    std::stable_sort(selections.begin(), selections.end(), [&](const Selection& a, const Selection& b) {
        return rank(a.group, mode) < rank(b.group, mode);
    });
    for (const Selection& selection : selections) add_send(statement, table::command_byte(mode, selection));
}

std::optional<std::uint16_t> timer_value(const ast::Value& value, Scope& scope, TimeFor use) {
    const auto worked_out = scope.worked_out(value);
    return worked_out ? milliseconds_of(*worked_out, scope.report(), use) : std::nullopt;
}

std::optional<std::uint16_t> ActionBuilder::preset_of(const Statement& statement, ValueKind kind,
                                                      std::uint8_t& number) {
    number = scope_.set_point_for(statement.value, kind, nullptr);
    if (number == 0) return std::nullopt;
    return static_cast<std::uint16_t>(scope_.set_point(number).initial);
}

void ActionBuilder::add_timer(const Statement& statement) {
    std::uint8_t number = 0;
    const std::optional<std::uint16_t> ms = scope_.is_set_point(statement.value)
                                                ? preset_of(statement, ValueKind::timer, number)
                                                : timer_value(statement.value, scope_);
    if (ms && once(action_.timer.has_value(), statement, "the timer is set", action_.timer_span)) {
        action_.timer = ms;
        action_.timer_point = number;
    }
}

void ActionBuilder::add_counter_of_set_point(const Statement& statement) {
    std::uint8_t number = 0;
    const auto count = preset_of(statement, ValueKind::counter, number);
    if (!count || !once(uses_counter(action_), statement, "the counter is changed", action_.counter_span))
        return;
    action_.counter = count;
    action_.counter_point = number;
}

void ActionBuilder::add_counter(const Statement& statement) {
    if (scope_.is_set_point(statement.value)) return add_counter_of_set_point(statement);
    const auto worked_out = scope_.worked_out(statement.value);
    if (!worked_out) return;
    const ast::Value& value = *worked_out;
    if (!value.unit.text.empty() || value.is_time) {
        scope_.report().add(
            "E063", value.span,
            value.is_time ? "a count is no time" : fmt::format("a count has no unit: '{}'", value.unit.text),
            "write the number alone, in CONST too");
        return;
    }
    const bool plain = std::floor(value.number) == value.number;
    if (!plain || !(value.number >= 0 && value.number <= kLongest)) {
        scope_.report().add("E063", value.span, "the counter holds whole numbers 0..65535",
                            value.number < 0 ? "it counts down to 0, where COUNTER.Q is true"
                                             : "for more, count in tens or hundreds");
        return;
    }
    if (!once(uses_counter(action_), statement, "the counter is changed", action_.counter_span)) return;
    if (value.number == 0) {
        action_.clears_counter = true;  // a preset of 0 has no effect (001 §6.1.7)
    } else {
        action_.counter = static_cast<std::uint16_t>(value.number);
    }
}

void append_entry(Action& action, const Action& entry, Report& report) {
    action.sends.insert(action.sends.end(), entry.sends.begin(), entry.sends.end());
    if (action.timer && entry.timer && entry.timer_by_step) {
        report
            .add("E073", action.timer_span, "the one timer is in use already in the step that is entered",
                 "leave this out, or let a step without WITHIN, FOR and BLINKING stand between")
            .notes.push_back({entry.timer_span, "it is used here"});
    } else if (action.timer && entry.timer) {
        conflict(report, action.timer_span, "the timer is set", entry.timer_span);
    }
    if (uses_counter(action) && uses_counter(entry))
        conflict(report, action.counter_span, "the counter is changed", entry.counter_span);
    if (entry.timer) {
        action.timer = entry.timer;
        action.timer_point = entry.timer_point;
        action.timer_span = entry.timer_span;
    }
    add_switches(action, entry, "the ENTRY of the step that is entered does the other", report);
    if (uses_counter(entry)) action.counter_span = entry.counter_span;
    if (entry.counter) {
        action.counter = entry.counter;
        action.counter_point = entry.counter_point;
    }
    action.clears_counter = action.clears_counter || entry.clears_counter;
    action.counts_down = action.counts_down || entry.counts_down;
}

}  // namespace nplc::seqc
