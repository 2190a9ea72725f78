#include "lsp/commands.h"

#include <array>

#include "report/graph/graph.h"
#include "report/graph/graph_layout.h"
#include "report/graph/graph_svg.h"

namespace nplc::seqc::lsp {
namespace {

const Compilation& sound(const View& view) {
    if (!view.program) throw ResponseError(kRequestFailed, "there is no program for this file");
    if (!view.program->compiled().ok)
        throw ResponseError(kRequestFailed, "the program has errors: there is no table yet");
    return view.program->compiled();
}

/// Source lines of the steps, included files too.
Json step_lines(const Workspace& workspace, const View& view, const Compilation& compiled) {
    Json steps = Json::array();
    for (const StepOrigin& step : compiled.steps) {
        const std::string& name = compiled.symbols.steps[step.number];
        if (step.span.length == 0) continue;
        const Json place = workspace.location_json(view, step.span);
        steps.push_back({{"name", name},
                         {"number", step.number},
                         {"uri", place["uri"]},
                         {"line", place["range"]["start"]["line"]}});
    }
    return steps;
}

}  // namespace

Json dot_of(Workspace& workspace, const Document& document) {
    const View view = workspace.view_of(document);
    const Compilation& compiled = sound(view);
    const std::string& program = compiled.symbols.program;
    const GraphSource source{&compiled.written, view.program->sources().text()};
    const GraphModel model = graph_model_of(compiled.table, &compiled.symbols, program, source);
    Json steps = Json::array();
    for (Json& step : step_lines(workspace, view, compiled)) {
        const auto number = step["number"].get<std::uint8_t>();
        if (step_as_written(compiled.symbols, number) == number) steps.push_back(std::move(step));
    }
    return {{"dot", graph_of(compiled.table, &compiled.symbols, program, source)},
            {"svg", svg_of(picture_of(model), program)},
            {"steps", std::move(steps)}};
}

Json description_of(Workspace& workspace, const Document& document) {
    const View view = workspace.view_of(document);
    const Compilation& compiled = sound(view);
    Json registers = Json::array();
    for (const MotorName& name : compiled.symbols.motor_names)
        registers.push_back({{"name", name.name}, {"register", name.reg}, {"number", name.number}});
    Json inverted = Json::array();
    for (std::size_t i = 0; i < compiled.symbols.inputs.size(); ++i) {
        if (is_inverted(compiled.symbols, i)) inverted.push_back(i);
    }
    return {{"program", compiled.symbols.program}, {"steps", step_lines(workspace, view, compiled)},
            {"inputs", compiled.symbols.inputs},   {"inverted_inputs", inverted},
            {"outputs", compiled.symbols.outputs}, {"registers", registers},
            {"terms", compiled.origins.size()}};
}

Json results_of(const VerifyOutcome& outcome) {
    constexpr std::array kLevels = {"error", "warning", "information", "hint"};
    Json results = Json::array();
    for (const Finding& finding : outcome.findings) {
        results.push_back({{"name", finding.name},
                           {"code", finding.code},
                           {"message", finding.message},
                           {"level", kLevels[static_cast<std::size_t>(finding.level)]},
                           {"counterexample", !finding.scenario.empty()}});
    }
    return {{"states", outcome.states}, {"complete", outcome.complete}, {"results", results}};
}

Json counterexample_of(const VerifyOutcome& outcome, const std::string& name) {
    for (const Finding& finding : outcome.findings) {
        if (!finding.scenario.empty() && (name.empty() || finding.name == name))
            return {{"name", finding.name}, {"scenario", finding.scenario}};
    }
    throw ResponseError(kRequestFailed, name.empty() ? "nothing is broken" : "'" + name + "' is not broken");
}

}  // namespace nplc::seqc::lsp
