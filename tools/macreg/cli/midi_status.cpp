#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/findings.h"
#include "cli/midi.h"
#include "macreg/midi/why.h"

namespace nplc::macreg::cli {
namespace {

using midi::Readings;

std::string model_name(const midi::Scale& scale) {
    return scale.model ? std::string(midi::reg::facts_of(*scale.model).name) : "module";
}

void status(MidiSession& session) {
    const midi::Scale scale = session.module().scale();
    const std::int32_t before = session.master().position(session.address());
    const Readings now = session.module().read_all();
    const bool turns = now.position != before;
    std::string text = fmt::format("{} at address {}, release {}: {}", model_name(scale), session.address(),
                                   midi::release_text(now.release), turns ? "turns" : "stands");
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
                        {"release", midi::release_text(now.release)},
                        {"position", now.position},
                        {"turns", turns},
                        {"busy", now.busy()},
                        {"faults", midi::status_words(now.status & midi::reg::kTrips)},
                        {"parameters", list}});
}

void why(MidiSession& session) {
    FindingsReport report("parameters");
    try {
        session.master().expect_alone(session.address());
    } catch (const midi_client::SameAddress&) {
        report.add(midi::same_address(session.address(), session.link().is_can()), {}, Json::array());
        return session.tell(report.text(), report.document());
    }
    const midi::Condition condition = midi::read_condition(session.module());
    for (const midi::Finding& finding : midi::why(condition)) {
        std::string values;
        Json parameters = Json::array();
        for (const std::string_view name : finding.parameters) {
            const midi::Parameter& one = *midi::find_parameter(name);
            const std::int64_t raw = condition.now.raw(one);
            values += fmt::format("{}{} = {}", values.empty() ? "" : ", ", name,
                                  midi::value_text(one, raw, condition.scale));
            parameters.push_back(midi_document(one, raw, condition.scale));
        }
        report.add(finding, values, parameters);
    }
    session.tell(report.text(), report.document());
}

}  // namespace

void add_midi_status(arguments::App& app, MidiCommon& midi) {
    command_line::add_command(app, "status",
                              "Position, faults and warnings in words, all settings, temperature, supply")
        .callback([&midi] { midi_work(midi, status); });
    command_line::add_command(
        app, "why",
        "Why does it not move? Sentences with what makes it so and what mends it, the first "
        "thing to mend in front")
        .callback([&midi] { midi_work(midi, why); });
}

}  // namespace nplc::macreg::cli
