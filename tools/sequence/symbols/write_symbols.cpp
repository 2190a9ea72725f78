#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/crc32.h"
#include "seqc/symbol_file.h"
#include "sequencer/term.h"
#include "symbols/motors.h"
#include "symbols/set_points_json.h"
#include "symbols/symbol_file_format.h"

namespace nplc::seqc {
namespace {

using Json = nlohmann::ordered_json;

/// File names need not be UTF-8, which JSON requires.
std::string dumped(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// One line per member, and in lists of objects one line per object.
std::string laid_out(const Json& object) {
    std::string text;
    for (const auto& [key, value] : object.items()) {
        text += fmt::format("{}  {}: ", text.empty() ? "{\n" : ",\n", dumped(key));
        if (!value.is_array() || value.empty() || !value.front().is_object()) {
            text += dumped(value);
            continue;
        }
        std::string_view before = "[\n    ";
        for (const Json& element : value) {
            text += fmt::format("{}{}", before, dumped(element));
            before = ",\n    ";
        }
        text += "\n  ]";
    }
    return text + "\n}\n";
}

Position place(Span span, const Places& places) {
    return span.length == 0 ? Position{0, 0} : places.of(span.offset).at;
}

/// For a line in an included file.
void add_file(Json& entry, Span span, const Sources& sources) {
    const SourceFile& file = sources.file_at(span.offset);
    if (span.length > 0 && &file != &sources.program()) entry["file"] = file.name;
}

Json registers_of(const Symbols& symbols) {
    Json list = Json::array();
    for (const MotorName& named : symbols.motor_names) {
        Json entry = {{"name", named.name}, {"register", named.reg}, {"number", named.number}};
        if (named.initial) entry["initial"] = *named.initial;
        list.push_back(std::move(entry));
    }
    return list;
}

Json units_of(const Symbols& symbols) {
    Json list = Json::array();
    for (const auto& [number, unit] : symbols.units) list.push_back({{"number", number}, {"unit", unit}});
    return list;
}

Json steps_of(const Compilation& compilation, const Places& places, const Sources& sources) {
    Json list = Json::array();
    for (const StepOrigin& step : compilation.steps) {
        Json entry = {{"number", step.number},
                      {"name", compilation.symbols.steps[step.number]},
                      {"line", place(step.span, places).line},
                      {"outputs", step.outputs}};
        add_file(entry, step.span, sources);
        const std::string& why = compilation.symbols.made_for[step.number];
        if (!why.empty()) entry["made_for"] = why;
        if (const auto of = compilation.symbols.copy_of[step.number]) entry["copy_of"] = *of;
        if (((compilation.symbols.timer_is_limit >> step.number) & 1U) != 0) entry["timer_is_limit"] = true;
        list.push_back(std::move(entry));
    }
    return list;
}

Json groups_of(const Symbols& symbols) {
    Json list = Json::array();
    for (const StepGroup& group : symbols.groups) {
        Json steps = Json::array();
        for (unsigned step = 0; step < symbols.steps.size(); ++step) {
            if (((group.steps >> step) & 1U) != 0) steps.push_back(step);
        }
        list.push_back({{"name", group.name}, {"steps", std::move(steps)}});
    }
    return list;
}

Json terms_of(const Compilation& compilation, const Places& places, const Sources& sources) {
    Json list = Json::array();
    for (const TermOrigin& origin : compilation.origins) {
        const Position at = place(origin.span, places);
        Json entry = {{"line", at.line}, {"column", at.column}};
        add_file(entry, origin.span, sources);
        list.push_back(std::move(entry));
    }
    return list;
}

}  // namespace

std::string write_symbols(const Compilation& compilation, std::string_view source,
                          std::string_view file_name) {
    return write_symbols(compilation, Sources({std::string(file_name), std::string(source)}));
}

std::string write_symbols(const Compilation& compilation, const Sources& sources) {
    const Symbols& symbols = compilation.symbols;
    const Places places(sources);
    Json file = {{"format", kSymbolsFormat},
                 {"version", symbols.inverted_inputs != 0 ? kSymbolsVersion : kPlainSymbolsVersion},
                 {"program", symbols.program},
                 {"source", sources.program().name},
                 {"motor", motor_name(symbols)}};
    if (symbols.scale) {
        file["scale"] = {{"revolutions", symbols.scale->revolutions},
                         {"length", symbols.scale->length},
                         {"unit", symbols.scale->unit}};
    }
    file["table"] = {{"bytes", compilation.table.size()},
                     {"terms", compilation.table.size() / sequencer::kTermBytes},
                     {"crc32", fmt::format("{:08X}", base::crc32(compilation.table))}};
    file["steps"] = steps_of(compilation, places, sources);
    if (!symbols.groups.empty()) file["groups"] = groups_of(symbols);
    for (const NamedTime& time : symbols.times)
        file["times"].push_back({{"name", time.name}, {"ms", time.milliseconds}});
    file["inputs"] = symbols.inputs;
    for (std::size_t i = 0; i < symbols.inputs.size(); ++i) {
        if (is_inverted(symbols, i)) file["inverted_inputs"].push_back(i);
    }
    file["outputs"] = symbols.outputs;
    file["registers"] = registers_of(symbols);
    if (!symbols.units.empty()) file["units"] = units_of(symbols);
    if (!symbols.set_points.values.empty()) {
        file["set_points"] = json_of(symbols.set_points);
        file["takes_set_points"] = takes_of(symbols.set_points);
    }
    file["terms"] = terms_of(compilation, places, sources);
    return laid_out(file);
}

}  // namespace nplc::seqc
