#include <fmt/format.h>

#include "cli/midi.h"
#include "cli/session.h"
#include "macreg/midi/values.h"
#include "macreg/midi/why.h"

namespace nplc::macreg::cli {

using midi::Parameter;
using midi::Readings;

namespace {

std::string model_name(const midi::Scale& scale) {
    return scale.model ? std::string(midi::reg::facts_of(*scale.model).name) : "module";
}

void status(MidiSession& session) {
    const midi::Scale scale = session.module().scale();
    const std::int32_t before = session.master().position(session.address());
    const Readings now = session.module().read_all();
    const bool turns = now.position() != before;
    std::string text =
        fmt::format("{} at address {}, release {}: {}", model_name(scale), session.address(),
                    midi::release_text(now.reply(midi::reg::GET_RELEASE)), turns ? "turns" : "stands");
    Json list = Json::array();
    for (const midi::Parameter& one : midi::parameters()) {
        if (!one.query || one.sort == midi::Sort::release) continue;
        const std::int64_t raw = now.raw(one);
        text += fmt::format("\n{:<12} {}", one.name, midi::value_text(one, raw, scale));
        list.push_back(midi_document(one, raw, scale));
    }
    if (!scale.model) remark(session.common(), "without --model there are no turns, volts and degrees");
    session.tell(text, {{"address", session.address()},
                        {"model", scale.model ? Json(model_name(scale)) : Json(nullptr)},
                        {"release", midi::release_text(now.reply(midi::reg::GET_RELEASE))},
                        {"position", now.position()},
                        {"turns", turns},
                        {"busy", now.busy()},
                        {"faults", midi::status_words(now.status() & midi::reg::kTrips)},
                        {"parameters", list}});
}

void why_module(MidiSession& session) {
    try {
        session.master().expect_alone(session.address());
    } catch (const midi_client::SameAddress&) {
        return tell_findings(session.common(),
                             {midi::same_address(session.address(), session.link().is_can())}, "parameters",
                             {});
    }
    const midi::Condition condition = midi::read_condition(session.module());
    tell_findings(session.common(), midi::why(condition), "parameters", [&](std::string_view name) {
        const Parameter& one = *midi::find_parameter(name);
        const std::int64_t raw = condition.now.raw(one);
        return ShownValue{midi::value_text(one, raw, condition.scale),
                          midi_document(one, raw, condition.scale)};
    });
}

const Parameter& named(const std::string& name) {
    const Parameter* found = midi::find_parameter(name);
    if (found == nullptr)
        throw UserError(fmt::format("'{}' is no parameter; `macreg midi list` shows them", name));
    return *found;
}

void list_parameters(const MidiCommon& midi) {
    std::string text;
    Json all = Json::array();
    for (const Parameter& one : midi::parameters()) {
        const std::string units = midi::units_text(one);
        const bool at_rest = one.command && !midi::row_of(one).while_moving;
        const std::string access = !one.command ? "read only"
                                   : at_rest    ? units + "; not while moving"
                                                : units;
        text += fmt::format("{}{:<12} {} [{}]", text.empty() ? "" : "\n", one.name, one.title, access);
        all.push_back({{"name", one.name},
                       {"title", one.title},
                       {"read", one.query.has_value()},
                       {"write", one.command.has_value()},
                       {"while_moving", !at_rest},
                       {"units", units}});
    }
    command_line::tell(midi.common, text, {{"parameters", all}});
}

std::vector<const Parameter*> readable(const std::vector<std::string>& names) {
    std::vector<const Parameter*> wanted;
    for (const std::string& name : names) {
        wanted.push_back(&named(name));
        if (!wanted.back()->query) throw UserError(fmt::format("{} cannot be read", wanted.back()->name));
    }
    return wanted;
}

void show(MidiSession& session, const std::vector<const Parameter*>& wanted) {
    const midi::Scale scale = session.module().scale();
    std::string text;
    Json all = Json::array();
    for (const Parameter* one : wanted) {
        const std::int64_t raw = session.module().read(*one);
        text += fmt::format("{}{} = {}   (raw {})", text.empty() ? "" : "\n", one->name,
                            midi::value_text(*one, raw, scale), raw);
        all.push_back(midi_document(*one, raw, scale));
    }
    session.tell(text, {{"parameters", all}});
}

void get_parameters(const MidiCommon& midi, const std::vector<std::string>& names) {
    const auto wanted = readable(names);
    MidiSession session(midi);
    show(session, wanted);
}

struct Assignment {
    const Parameter* parameter;
    std::string text;
};

/// NAME VALUE or NAME=VALUE; a unit may stand apart.
std::vector<Assignment> read_words(const std::vector<std::string>& words) {
    std::vector<Assignment> all;
    for (const std::string& word : words) {
        const std::size_t equals = word.find('=');
        const std::string name = word.substr(0, equals);
        if (const Parameter* parameter = midi::find_parameter(name); parameter != nullptr) {
            all.push_back({parameter, equals == std::string::npos ? "" : word.substr(equals + 1)});
        } else {
            if (all.empty() || equals != std::string::npos) named(name);
            all.back().text += word;
        }
    }
    for (const Assignment& one : all) {
        if (one.text.empty()) throw UserError(fmt::format("{}: a value is missing", one.parameter->name));
    }
    return all;
}

struct Checked {
    const Parameter* parameter;
    midi::TypedValue value;
};

std::vector<Checked> check(const std::vector<Assignment>& all, midi::Scale scale) {
    std::vector<Checked> checked;
    for (const Assignment& one : all) {
        midi::TypedValue value = midi::typed_value(*one.parameter, one.text, scale);
        if (!value.error.empty()) throw UserError(value.error);
        // An acceleration behind a new speed is one from that speed.
        if (one.parameter->sort == midi::Sort::period) scale.period = value.raw;
        checked.push_back({one.parameter, std::move(value)});
    }
    return checked;
}

void change(MidiSession& session, const std::vector<Checked>& all) {
    std::string text;
    Json done = Json::array();
    for (const auto& [parameter, value] : all) {
        if (!goes_on())
            throw command_line::Failure(command_line::kInterrupted, "interrupted", {{"written", done}});
        const midi::ChangeResult outcome = session.module().change(*parameter, value.raw);
        const midi::Scale scale = session.module().scale();
        const auto shown = [&](std::int64_t raw) { return midi::value_text(*parameter, raw, scale); };
        if (!outcome.taken)
            refuse(fmt::format("{}: {} was not taken, it is {}: {}", parameter->name, shown(value.raw),
                               shown(outcome.after.value_or(0)), outcome.why),
                   {{"parameter", parameter->name}, {"reason", outcome.why}, {"written", done}});
        if (!value.rounding.empty()) remark(session.common(), value.rounding);
        text +=
            fmt::format("{}{} = {} (raw {}{})", text.empty() ? "" : "\n", parameter->name, shown(value.raw),
                        value.raw, outcome.before ? "; was " + shown(*outcome.before) : "");
        Json document = midi_document(*parameter, value.raw, scale);
        if (outcome.before) document["before"] = *outcome.before;
        if (!value.rounding.empty()) document["rounding"] = value.rounding;
        done.push_back(std::move(document));
    }
    session.tell(text, {{"parameters", done}});
}

void set_parameters(const MidiCommon& midi, const std::vector<std::string>& words) {
    const auto all = read_words(words);
    for (const Assignment& one : all) {
        if (!one.parameter->command) throw UserError(fmt::format("{} is read only", one.parameter->name));
    }
    MidiSession session(midi);
    change(session, check(all, session.module().scale()));
}

struct Limits {
    std::string lower, upper;
    bool on = false;
    bool off = false;
};

void limits(const MidiCommon& midi, const Limits& options) {
    std::vector<Checked> all;
    if (!options.lower.empty() || !options.upper.empty()) {
        if (options.lower.empty() || options.upper.empty())
            throw UserError("limits: both are needed, LOWER UPPER");
        const std::int64_t lower =
            number_of(midi::typed_position(options.lower, midi_model(midi)), "lower limit: ");
        const std::int64_t upper =
            number_of(midi::typed_position(options.upper, midi_model(midi)), "upper limit: ");
        if (lower >= upper) throw UserError(fmt::format("limits: {} is not below {}", lower, upper));
        all = {{&named("LOWER_STOP"), {.raw = lower}}, {&named("UPPER_STOP"), {.raw = upper}}};
    }
    MidiSession session(midi);
    const Parameter& stops = named("END_STOPS");
    if (options.on || options.off) {
        const std::int64_t now = session.module().read(stops);
        all.push_back({&stops, {.raw = options.on ? (now | 8) : (now & ~std::int64_t{8})}});
    }
    if (!all.empty()) return change(session, all);
    show(session, readable({"LOWER_STOP", "UPPER_STOP", "END_STOPS"}));
}

}  // namespace

void add_midi_status(arguments::App& app, MidiCommon& midi) {
    add_command(app, midi, "status",
                "Position, faults and warnings in words, all settings, temperature, supply", status);
    add_command(app, midi, "why",
                "Why does it not move? Sentences with what makes it so and what mends it, the "
                "first thing to mend in front",
                why_module);
}

void add_midi_values(arguments::App& app, MidiCommon& midi) {
    add_command(app, midi, "list", "The parameters with their units. Needs no module", list_parameters);

    auto [get_command, names] = add_command(app, midi, "get", "Read parameters", get_parameters);
    get_command.add_option("parameters", names, "Names")->required();

    auto [set_command, words] =
        add_command(app, midi, "set",
                    "Change parameters and read them back: SPEED 300rpm, TORQUE 50%, RAMP 2rev/s2, "
                    "UPPER_STOP 10rev, or raw:N. All are checked before the first is written",
                    set_parameters);
    set_command.add_option("values", words, "NAME VALUE, or NAME=VALUE; several at once")->required();

    auto [limits_command, options] = add_command(
        app, midi, "limits", "The software end-stops: show them, set both, switch them on and off", limits);
    limits_command.add_option("lower", options.lower, "Lower one, in inc or rev");
    limits_command.add_option("upper", options.upper, "Upper one");
    limits_command.add_flag("--on", options.on, "Let them act; the hardware ones stay as they are");
    limits_command.add_flag("--off", options.off, "Let them not act")->excludes("--on");
}

}  // namespace nplc::macreg::cli
