#include "parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "registers/convert.h"
#include "registers/details.h"
#include "registers/midi.h"
#include "registers/scale.h"
#include "text/edit_distance.h"

namespace nplc::sim {
namespace {

constexpr std::string_view kActions =
    "an action: IN0 := 1, pulse IN0 50 ms, toggle IN0, cancel IN0, line ..., motor ..., gateway ..., set "
    "..., "
    "recipe ..., seed, log or end";

constexpr std::string_view kMotor =
    "motor error, motor load, motor brake, motor power, motor stop, motor sensor, motor analogue, motor "
    "pulses, motor steps, motor supply, motor logic, motor temperature, motor encoder, motor upper_stop, "
    "motor lower_stop, motor reference or motor security";

/// "5 rev" for a register of another unit.
std::string wrong_unit(std::string_view text, const registers::Register& reg) {
    const std::string_view unit =
        text.substr(std::min(text.find_first_not_of("+-.0123456789 "), text.size()));
    std::string units;
    for (const std::string_view one : registers::units_of(reg.unit))
        units += fmt::format("{}{}", units.empty() ? "" : ", ", one);
    if (units.empty()) return fmt::format("{} has no unit; write the number alone", reg.name);
    return fmt::format("\"{}\" is no unit of {}; write {}, or the number alone in its own steps", unit,
                       reg.name, units);
}

action::Breakpoints breakpoints(Reader& reader, ConditionParser& conditions) {
    action::Breakpoints where;
    if (reader.take("none")) return where;
    do {
        where.steps |= std::uint64_t{1} << static_cast<unsigned>(conditions.step_number());
    } while (reader.take("and"));
    return where;
}

Value signal_to_force(ConditionParser& conditions) {
    return conditions.signal("an input or output, such as gateway force IN0 := 1");
}

action::ForceSignals force_of(const Value& signal) {
    return {.outputs = signal.kind == Value::Kind::output,
            .mask = static_cast<std::uint8_t>(1U << signal.index)};
}

std::vector<action::ForceSignals> signals_to_release(Reader& reader, ConditionParser& conditions) {
    constexpr std::uint8_t kAll = 0xFF;
    if (reader.take("all"))
        return {{.outputs = false, .mask = kAll, .releases = true},
                {.outputs = true, .mask = kAll, .releases = true}};
    action::ForceSignals released = force_of(signal_to_force(conditions));
    released.releases = true;
    return {released};
}

}  // namespace

Actions ActionParser::actions() {
    Actions list;
    Time after{0};
    do {
        if (reader_.take("after")) after += reader_.duration("a time after after");
        action(list, after);
        if (reader_.is("for"))
            reader_.refuse_next(
                "for takes back an input, a force, line cut, motor power off and a MIDI module's inputs "
                "only; "
                "write what follows, such as motor load 500, after 200 ms motor load 0");
    } while (reader_.take(","));
    return list;
}

void ActionParser::action(Actions& list, Time after) {
    const bool is_motors = reader_.is("motor") || reader_.is("cancel") || reader_.is("log");
    if (conditions_.names().motor_alone && !is_motors)
        reader_.refuse_next("here is the motor alone; write what happens to it, such as motor load 500");
    if (reader_.is(":=", 1)) return set_input(list, after);
    if (reader_.take("pulse")) return pulse(list, after);
    if (reader_.take("toggle"))
        return add(list, after, action::ToggleInput{conditions_.input("an input to toggle").index});
    if (reader_.take("cancel")) return add(list, after, cancelled());
    if (reader_.take("line")) return line(list, after);
    if (reader_.take("motor")) return motor(list, after);
    if (reader_.take("gateway")) return gateway(list, after);
    if (reader_.is("set") && conditions_.names().set_points.values.empty() &&
        conditions_.knows(reader_.peek(1).text))
        reader_.refuse_next(
            fmt::format("an input is switched with := and the level; write {} := 1", reader_.peek(1).text));
    if (reader_.is("set")) return add(list, after, SetPointParser(reader_, conditions_, recipes_).set());
    if (reader_.is("recipe"))
        return add(list, after, SetPointParser(reader_, conditions_, recipes_).recipe());
    if (reader_.take("seed")) return seed(list, after);
    if (reader_.take("log")) return log(list, after);
    if (reader_.take("end")) return add(list, after, action::End{});
    set_input(list, after);
}

void ActionParser::set_input(Actions& list, Time after) {
    if (reader_.peek().kind == Token::Kind::word && !reader_.is(":=", 1)) check_known_word();
    const Terminal input = conditions_.input(kActions);
    reader_.want(":=", ":= and the level, such as IN0 := 1");
    const bool level = input.level(conditions_.level());
    add_for(list, after, action::SetInput{input.index, level}, action::SetInput{input.index, !level});
}

action::Cancel ActionParser::cancelled() {
    using What = action::Cancel::What;
    constexpr std::array<std::pair<std::string_view, What>, 6> kWords{{{"motor", What::motor},
                                                                       {"line", What::line},
                                                                       {"gateway", What::gateway},
                                                                       {"log", What::log},
                                                                       {"end", What::end},
                                                                       {"all", What::all}}};
    for (const auto& [word, what] : kWords) {
        if (reader_.take(word)) return {what};
    }
    return {What::input,
            conditions_.input("an input, motor, line, gateway, log, end or all after cancel").index};
}

/// A first word that is no signal is probably a misspelt statement.
void ActionParser::check_known_word() {
    if (conditions_.knows(reader_.peek().text)) return;
    struct Word {
        std::string_view word;
        std::string_view meant;
    };
    constexpr std::string_view kPulse = "pulse IN0 50 ms";
    constexpr std::string_view kTime = "at and the time from the start, such as at 2 s IN0 := 1";
    constexpr std::array<Word, 8> kWords{
        {{"wait", kTime},
         {"delay", kTime},
         {"sleep", kTime},
         {"if", "when and what happens, such as when OUT0 rises IN0 := 1"},
         {"press", kPulse},
         {"push", kPulse},
         {"check", "expect and what must hold, such as expect at 2 s OUT0"},
         {"assert", "expect and what must hold, such as expect at 2 s OUT0"}}};
    for (const auto& [word, meant] : kWords) {
        if (reader_.is(word))
            reader_.refuse_next(fmt::format("\"{}\" is not known here; write {}", word, meant));
    }
    reader_.refuse_next(
        fmt::format("\"{}\" is not known here; write at, every, when, once, expect, always, never, end or {}",
                    reader_.peek().text, kActions));
}

void ActionParser::pulse(Actions& list, Time after) {
    const Terminal input = conditions_.input("an input, such as pulse IN0 50 ms");
    reader_.take("for");
    const Time length = reader_.duration("how long, such as pulse IN0 50 ms");
    if (length <= Time{0})
        reader_.refuse_time("a pulse must be longer than 0; write such as pulse IN0 50 ms");
    add(list, after, action::SetInput{input.index, input.level(true)});
    add(list, after + length, action::SetInput{input.index, input.level(false)}, true);
}

void ActionParser::line(Actions& list, Time after) {
    if (reader_.take("cut")) return add_for(list, after, action::CutLine{true}, action::CutLine{false});
    if (reader_.take("restored")) return add(list, after, action::CutLine{false});
    action::SpoilLine spoil;
    line_direction(spoil);
    if (reader_.take("clean")) {
        spoil.drop = spoil.damage = spoil.framing = spoil.delay = 0;
        spoil.late = spoil.together = Time(0);
        return add(list, after, spoil);
    }
    if (!fault(spoil)) {
        reader_.fail(
            "line cut, line restored, line clean, or drop, damage, framing, delay and a share, such as line "
            "drop 1 %, or late, together and a time, such as line late 5 ms");
    }
    while (fault(spoil)) {
    }
    if (reader_.is("for"))
        reader_.refuse_next(
            "a bad line has no end of its own; write what ends it, such as after 1 s line clean");
    add(list, after, spoil);
}

void ActionParser::line_direction(action::SpoilLine& spoil) {
    constexpr std::string_view kUse = "line to motor, or line from motor";
    if (reader_.take("to")) {
        reader_.want("motor", kUse);
        spoil.from_motor = false;
    } else if (reader_.take("from")) {
        reader_.want("motor", kUse);
        spoil.to_motor = false;
    }
}

bool ActionParser::fault(action::SpoilLine& spoil) {
    constexpr std::string_view kShare = "a share, such as 1 %";
    if (reader_.take("drop")) {
        spoil.drop = reader_.percent(kShare);
    } else if (reader_.take("damage")) {
        spoil.damage = reader_.percent(kShare);
    } else if (reader_.take("framing")) {
        spoil.framing = reader_.percent(kShare);
    } else if (reader_.take("delay")) {
        spoil.delay = reader_.percent(kShare);
        if (reader_.take("up")) {
            reader_.want("to", "up to and a time, such as delay 1 % up to 5 ms");
            spoil.longest_delay = reader_.duration("a time, such as delay 1 % up to 5 ms");
        }
    } else if (reader_.take("late")) {
        spoil.late = reader_.duration("a time, such as late 16 ms");
    } else if (reader_.take("together")) {
        spoil.together = reader_.duration("a time, such as together 16 ms");
    } else {
        return false;
    }
    return true;
}

void ActionParser::gateway(Actions& list, Time after) {
    using What = action::Gateway;
    constexpr std::array<std::pair<std::string_view, What>, 7> kWords{{{"stop", What::stop},
                                                                       {"run", What::run},
                                                                       {"restart", What::restart},
                                                                       {"safe", What::safe},
                                                                       {"hold", What::hold},
                                                                       {"step", What::step},
                                                                       {"scan", What::scan}}};
    for (const auto& [word, what] : kWords) {
        if (reader_.take(word)) return add(list, after, what);
    }
    if (reader_.take("break")) return add(list, after, breakpoints(reader_, conditions_));
    if (reader_.take("force")) return force(list, after);
    if (reader_.take("release")) {
        for (const auto& released : signals_to_release(reader_, conditions_)) add(list, after, released);
        return;
    }
    reader_.fail(
        "gateway stop, gateway safe, gateway run, gateway hold, gateway step, gateway scan, gateway restart, "
        "gateway break, gateway force or gateway release");
}

void ActionParser::force(Actions& list, Time after) {
    const Value signal = signal_to_force(conditions_);
    action::ForceSignals forced = force_of(signal);
    action::ForceSignals released = forced;
    released.releases = true;
    reader_.want(":=", ":= and the level, such as gateway force IN0 := 1");
    if (conditions_.level() != signal.inverted) forced.levels = forced.mask;
    add_for(list, after, forced, released);
}

void ActionParser::seed(Actions& list, Time after) {
    const double number = reader_.number("a whole number, such as seed 7");
    if (number < 0 || number > UINT32_MAX ||
        number != static_cast<double>(static_cast<std::uint64_t>(number))) {
        reader_.refuse("a seed is a whole number 0 to 4294967295");
    }
    add(list, after, action::Seed{static_cast<std::uint64_t>(number)});
}

void ActionParser::log(Actions& list, Time after) {
    if (reader_.peek().kind != Token::Kind::text)
        reader_.fail("a text in quotes, such as log \"door opens\"");
    add(list, after, action::Log{std::string(reader_.next().text)});
}

void ActionParser::needs(DrivePart part) const {
    const std::string why = why_without(part, conditions_.names());
    if (!why.empty()) reader_.refuse(why);
}

void ActionParser::motor(Actions& list, Time after) {
    if (reader_.take("error")) return add(list, after, action::FailMotor{});
    if (reader_.take("load")) return add(list, after, motor_load());
    if (reader_.take("power")) return motor_power(list, after);
    if (reader_.take("stop")) return motor_stop(list, after);
    if (reader_.take("supply")) return add(list, after, motor_supply(false));
    if (drive_input(list, after) || motor_surroundings(list, after)) return;
    if (reader_.is(":=", 1))
        reader_.refuse_next(
            "a register is stored before the run begins; write such as motor HW_SETUP := NOFILT alone in a "
            "line");
    reader_.fail(kMotor);
}

/// Actions on parts that only some drives have.
bool ActionParser::motor_surroundings(Actions& list, Time after) {
    const auto take = [this](std::string_view word, DrivePart part) {
        if (!reader_.take(word)) return false;
        needs(part);
        return true;
    };
    if (take("brake", DrivePart::brake)) {
        add(list, after, motor_brake());
    } else if (take("sensor", DrivePart::analogue_input)) {
        add(list, after, motor_sensor());
    } else if (take("analogue", DrivePart::analogue_input)) {
        add(list, after, motor_analogue());
    } else if (take("pulses", DrivePart::pulse_input)) {
        add(list, after, motor_pulses(false));
    } else if (take("steps", DrivePart::pulse_input)) {
        add(list, after, motor_pulses(true));
    } else if (take("logic", DrivePart::logic_supply)) {
        add(list, after, motor_supply(true));
    } else if (take("temperature", DrivePart::temperature)) {
        add(list, after, motor_temperature());
    } else if (take("encoder", DrivePart::encoder)) {
        reader_.want("broken", "motor encoder broken");
        add(list, after, action::BreakEncoder{});
    } else {
        return false;
    }
    return true;
}

/// reference on, upper_stop on above 20 rev
bool ActionParser::drive_input(Actions& list, Time after) {
    using Input = action::DriveInput;
    constexpr std::array<std::pair<std::string_view, Input>, 4> kWords{{{"upper_stop", Input::upper_stop},
                                                                        {"lower_stop", Input::lower_stop},
                                                                        {"reference", Input::reference},
                                                                        {"security", Input::security}}};
    const auto found = std::find_if(kWords.begin(), kWords.end(),
                                    [this](const auto& known) { return reader_.take(known.first); });
    if (found == kWords.end()) return false;
    needs(DrivePart::inputs);
    const Input input = found->second;
    const bool active = conditions_.level();
    if (reader_.is("above") || reader_.is("below")) {
        const bool above = above_or_below("above or below");
        add(list, after, action::DriveSwitch{input, above == active, conditions_.place()});
    } else {
        add_for(list, after, action::SetDriveInput{input, active}, action::SetDriveInput{input, !active});
    }
    return true;
}

StoredRegister ActionParser::stored_parameter() {
    namespace midi = registers::midi;
    const Token name = reader_.next();
    std::string known;
    for (const midi::CommandRow& row : midi::commands()) {
        if (row.kind != midi::Kind::parameter || row.fields[0].bits == 0) continue;
        known += (known.empty() ? "" : ", ") + std::string(row.name);
        if (!same_name(row.name, name.text)) continue;
        reader_.want(":=", ":= and the value");
        const double value = reader_.number("a whole number");
        const auto data = value == static_cast<double>(static_cast<std::int32_t>(value))
                              ? midi::pack(row, static_cast<std::int32_t>(value))
                              : std::nullopt;
        if (data && midi::is_legal(row, *data)) return {row.number, *data};
        reader_.refuse(fmt::format("{} takes {} to {}", row.name, row.fields[0].min, row.fields[0].max) +
                       (row.number == midi::END_STOPS ? ": 0, 1, 8 or 9" : ""));
    }
    reader_.refuse(fmt::format("a MIDI drive has no parameter {}; write one of {}", name.text, known));
}

namespace {

std::string register_meant(registers::Model model, std::string_view name) {
    std::vector<std::string_view> known;
    for (const registers::Register& reg : registers::map_of(model)) known.push_back(reg.name);
    const std::string_view meant = spelling::nearest(name, known);
    return meant.empty() ? "registers are called as in the manual" : fmt::format("did you mean {}?", meant);
}

}  // namespace

StoredRegister ActionParser::stored_register() {
    if (conditions_.names().drive != nullptr) return stored_parameter();
    const registers::Model model = conditions_.names().motor;
    const Token name = reader_.next();
    const registers::Register* reg = registers::find(model, name.text);
    if (reg == nullptr)
        reader_.refuse(fmt::format("a {} has no register {}; {}", registers::name_of(model), name.text,
                                   register_meant(model, name.text)));
    if (reg->access != registers::Access::read_write)
        reader_.refuse(fmt::format("{} is what the motor itself counts or shows; its flash does not hold it",
                                   reg->name));
    reader_.want(":=", ":= and the value");
    if (reader_.at_end()) reader_.fail("a value such as 12, 16#1F, 5 rev or names of bits");
    return {reg->number, stored_value(*reg, model)};
}

std::uint32_t ActionParser::stored_value(const registers::Register& reg, registers::Model model) {
    if (reader_.peek().kind == Token::Kind::word) return stored_bits(reg, model);
    const std::size_t begin = reader_.mark();
    const std::string_view text = reader_.rest();
    const registers::Parsed value = registers::parse(text, reg, model);
    if (value.error == registers::TextError::none) return registers::bits_of(reg.format, value.raw);
    if (value.error == registers::TextError::wrong_unit)
        reader_.refuse_at(std::min(begin + 1, reader_.mark()), wrong_unit(text, reg));
    reader_.refuse_at(
        begin, fmt::format("{} takes {} to {}, in its own steps or with a unit as macreg takes it", reg.name,
                           reg.min, reg.max));
}

std::uint32_t ActionParser::stored_bits(const registers::Register& reg, registers::Model model) {
    std::uint32_t bits = 0;
    while (!reader_.at_end()) {
        const Token word = reader_.next();
        const registers::Field* field = registers::field_of(model, reg.number, word.text);
        if (field == nullptr || field->width != 1) {
            std::string known;
            for (const registers::Field& one : registers::fields_of(model, reg.number)) {
                if (one.width == 1) known += (known.empty() ? "" : ", ") + std::string(one.name);
            }
            reader_.refuse(known.empty()
                               ? fmt::format("{} has no named bits; write a number", reg.name)
                               : fmt::format("\"{}\" is no bit of {}; write some of {}, or a number",
                                             word.text, reg.name, known));
        }
        bits |= registers::mask_of(*field);
    }
    return bits;
}

int ActionParser::whole(std::string_view what, double least, double most, std::string_view mistake) {
    const double number = reader_.number(what);
    if (number < least || number > most || number != static_cast<double>(static_cast<int>(number))) {
        reader_.refuse(std::string(mistake));
    }
    return static_cast<int>(number);
}

action::LoadMotor ActionParser::motor_load() {
    return {whole("a torque, such as motor load 500", -10'000, 10'000,
                  "a load is a whole number -10000 to 10000, 1023 being the motor's full torque")};
}

action::MotorBrake ActionParser::motor_brake() {
    return {whole("a torque, such as motor brake 300", 0, 10'000,
                  "a brake is a whole number 0 to 10000, 1023 being the motor's full torque")};
}

void ActionParser::motor_power(Actions& list, Time after) {
    const bool off = reader_.take("off");
    if (!off) reader_.want("on", "motor power off, or motor power on");
    add_for(list, after, action::PowerMotor{!off}, action::PowerMotor{off});
}

bool ActionParser::above_or_below(std::string_view example) {
    if (reader_.take("below")) return false;
    reader_.want("above", example);
    return true;
}

void ActionParser::motor_stop(Actions& list, Time after) {
    if (reader_.take("none")) return add(list, after, action::FreeMotor{});
    action::StopMotor stop;
    stop.above =
        above_or_below("above or below and a place, such as motor stop below -2 rev, or motor stop none");
    stop.counts = conditions_.place();
    if (reader_.take("spring")) stop.torque_per_count = spring();
    add(list, after, stop);
}

double ActionParser::spring() {
    needs(DrivePart::spring);
    const double torque = reader_.number("a torque, such as spring 2000 per rev");
    if (torque < 1 || torque > 1e6)
        reader_.refuse("a spring is 1 to 1000000 per rev, 1023 being the motor's full torque");
    reader_.want("per", "per rev, such as spring 2000 per rev");
    return torque / conditions_.length();
}

action::MotorSensor ActionParser::motor_sensor() {
    constexpr std::string_view kExample =
        "motor sensor on below -1 rev, or motor sensor off above 500 counts";
    const bool off = reader_.take("off");
    if (!off) reader_.want("on", kExample);
    const bool above = above_or_below(kExample);
    return {.on_above = above != off, .counts = conditions_.place()};
}

action::MotorAnalogue ActionParser::motor_analogue() {
    const double volts = reader_.number("a voltage, such as motor analogue 7.5 V");
    reader_.want("V", "its unit, such as motor analogue 7.5 V");
    if (volts < -10 || volts > 10) reader_.refuse("the analogue input takes -10 V to 10 V");
    return {volts};
}

action::MotorPulses ActionParser::motor_pulses(bool with_direction) {
    const std::string example = with_direction ? "motor steps 5000 per s" : "motor pulses 5000 per s";
    const int rate =
        whole("a rate, such as " + example, -1e6, 1e6, "pulses are a whole number -1000000 to 1000000 per s");
    reader_.want("per", "per s, such as " + example);
    reader_.want("s", "per s, such as " + example);
    return {rate, with_direction};
}

action::MotorSupply ActionParser::motor_supply(bool logic) {
    const std::string example = logic ? "motor logic 15 V" : "motor supply 20 V";
    const double volts = reader_.number("a voltage, such as " + example);
    reader_.want("V", "its unit, such as " + example);
    if (volts < 0 || volts > 600) reader_.refuse("a supply is 0 V to 600 V");
    return {volts, logic};
}

action::MotorTemperature ActionParser::motor_temperature() {
    return {whole("degrees Celsius, such as motor temperature 90", -40, 200,
                  "a temperature is a whole number -40 to 200, in degrees Celsius")};
}

}  // namespace nplc::sim
