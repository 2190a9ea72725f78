#include <fmt/format.h>

#include <algorithm>

#include "adapter.h"
#include "text/text.h"

/// Variables that the adapter shows and sets.
namespace nplc::dap {
namespace {

enum Scope : int { kSequence = 1, kInputs, kOutputs, kMotor };

constexpr unsigned kInputCount = 6;
constexpr unsigned kOutputCount = 4;
constexpr std::uint8_t kNoStep = 63;

const char* level_text(bool level) {
    return level ? "TRUE" : "FALSE";
}

bool level_in(const std::string& text) {
    for (const char* on : {"1", "true", "on"}) {
        if (spelling::is_same(text, on)) return true;
    }
    for (const char* off : {"0", "false", "off"}) {
        if (spelling::is_same(text, off)) return false;
    }
    throw Problem(fmt::format("'{}': write TRUE or FALSE, 1 or 0", text));
}

template <std::size_t N>
unsigned index_of(const std::array<std::string, N>& names, const std::string& name) {
    for (unsigned i = 0; i < N; ++i) {
        if (spelling::is_same(names[i], name)) return i;
    }
    throw Problem(fmt::format("there is no '{}' here", name));
}

}  // namespace

std::optional<std::uint8_t> Adapter::step_named(const std::string& name) const {
    const auto& steps = debuggee_->symbols().steps;
    for (std::uint8_t step = 0; step < steps.size(); ++step) {
        if (!name.empty() && spelling::is_same(steps[step], name)) return step;
    }
    return std::nullopt;
}

std::uint64_t Adapter::with_copies(std::uint8_t step) const {
    return seqc::with_copies(debuggee_->symbols(), step);
}

StepPlace Adapter::place_of_step(std::uint8_t step) const {
    return step < step_places_.size() ? step_places_[step] : StepPlace{};
}

Json Adapter::conditions_now(const Look& look) const {
    Json list = Json::array();
    if (look.step >= kNoStep) return list;
    const seqc::Seen seen{look.inputs, look.in_position, look.error, look.timer == 0, look.counter == 0};
    const seqc::Symbols& symbols = debuggee_->symbols();
    const std::uint8_t step = symbols.copy_of[look.step].value_or(look.step);
    for (const seqc::ConditionNow& condition : conditions_->of(symbols.steps[step], seen)) {
        Json parts = Json::array();
        for (const auto& part : condition.parts)
            parts.push_back({{"text", part.text}, {"holds", part.holds}});
        list.push_back({{"line", condition.line},
                        {"file", condition.file},
                        {"text", condition.text},
                        {"holds", condition.holds},
                        {"parts", std::move(parts)}});
    }
    return list;
}

Json Adapter::stack_trace() {
    const Look look = debuggee().look();
    const StepPlace place = place_of_step(look.step);
    const std::uint32_t line = place.line;
    const std::string& name = look.step < kNoStep ? debuggee().symbols().steps[look.step] : std::string();
    Json frame = {
        {"id", 1},
        {"name", fmt::format("{} at {}", name.empty() ? fmt::format("step {}", look.step) : name, look.time)},
        {"line", line == 0 ? 0 : static_cast<int>(line) - (1 - line_base_)},
        {"column", line == 0 ? 0 : line_base_}};
    if (line != 0) frame["source"] = {{"name", last_name(place.file)}, {"path", place.file}};
    return {{"stackFrames", {frame}}, {"totalFrames", 1}};
}

Json Adapter::scopes() {
    debuggee();
    Json list = Json::array();
    for (const auto& [name, number] : {std::pair{"Sequence", kSequence}, std::pair{"Inputs", kInputs},
                                       std::pair{"Outputs", kOutputs}, std::pair{"Motor", kMotor}})
        list.push_back(
            {{"name", name}, {"variablesReference", static_cast<int>(number)}, {"expensive", false}});
    return {{"scopes", list}};
}

std::vector<Variable> Adapter::variables_in(int scope) {
    if (scope == kMotor) return debuggee().registers();
    const Look look = debuggee().look();
    const seqc::Symbols& symbols = debuggee().symbols();
    std::vector<Variable> list;
    if (scope == kInputs) {
        for (unsigned i = 0; i < kInputCount; ++i)
            list.push_back({symbols.inputs[i],
                            level_text((look.inputs >> i & 1) != (seqc::is_inverted(symbols, i) ? 1 : 0)),
                            "BOOL", true});
    } else if (scope == kOutputs) {
        for (unsigned i = 0; i < kOutputCount; ++i)
            list.push_back({symbols.outputs[i], level_text((look.outputs >> i & 1) != 0), "BOOL", true});
    } else if (scope == kSequence) {
        list = {{"step", look.step < kNoStep ? symbols.steps[look.step] : "?", "", false},
                {"TIMER", fmt::format("{} ms", look.timer), "", false},
                {"COUNTER", std::to_string(look.counter), "", false},
                {"INPOS", level_text(look.in_position), "BOOL", false},
                {"ERROR", level_text(look.error), "BOOL", false},
                {"LINK", level_text(look.link), "BOOL", false},
                {"state", look.state, "", false},
                {"time", look.time, "", false},
                {"TIMER.Q", level_text(look.timer == 0), "BOOL", false},
                {"COUNTER.Q", level_text(look.counter == 0), "BOOL", false}};
    }
    return list;
}

Json Adapter::variables(const Json& arguments) {
    Json list = Json::array();
    for (const Variable& variable : variables_in(arguments.value("variablesReference", 0))) {
        Json json = {{"name", variable.name},
                     {"value", variable.value},
                     {"variablesReference", 0},
                     {"evaluateName", variable.name}};
        if (!variable.type.empty()) json["type"] = variable.type;
        if (!variable.can_be_set) json["presentationHint"] = {{"attributes", {"readOnly"}}};
        list.push_back(std::move(json));
    }
    return {{"variables", list}};
}

std::string Adapter::set(int scope, const std::string& name, const std::string& value) {
    const seqc::Symbols& symbols = debuggee().symbols();
    if (scope == kMotor) return debuggee().set_register(name, value);
    const bool level = scope == kInputs || scope == kOutputs ? level_in(value) : false;
    if (scope == kInputs) {
        const auto input = index_of(symbols.inputs, name);
        debuggee().set_input(input, level != seqc::is_inverted(symbols, input));
    } else if (scope == kOutputs) {
        debuggee().set_output(index_of(symbols.outputs, name), level);
    } else {
        throw Problem(fmt::format("{} is the sequence's own: set inputs or registers", name));
    }
    return level_text(level);
}

Json Adapter::set_variable(const Json& arguments) {
    const std::string value = set(arguments.value("variablesReference", 0), arguments.value("name", ""),
                                  arguments.value("value", ""));
    tell_remarks();
    tell_state();
    return {{"value", value}};
}

/// Evaluates a name; in the console also `Name := value`, `run` and `stop`.
Json Adapter::evaluate(const Json& arguments) {
    const std::string expression = arguments.value("expression", "");
    if (arguments.value("context", "") == "repl") {
        for (const bool run : {true, false}) {
            if (!spelling::is_same(spelling::trimmed(expression), run ? "run" : "stop")) continue;
            switch_machine(run);
            return {{"result", run ? "running" : "stopped"}, {"variablesReference", 0}};
        }
    }
    const std::size_t assignment = expression.find(":=");
    const std::string name(spelling::trimmed(expression.substr(0, assignment)));
    for (const int scope : {static_cast<int>(kSequence), static_cast<int>(kInputs),
                            static_cast<int>(kOutputs), static_cast<int>(kMotor)}) {
        for (const Variable& variable : variables_in(scope)) {
            if (!spelling::is_same(variable.name, name)) continue;
            if (assignment == std::string::npos)
                return {{"result", variable.value}, {"variablesReference", 0}};
            const std::string value(spelling::trimmed(expression.substr(assignment + 2)));
            return {{"result", set(scope, variable.name, value)}, {"variablesReference", 0}};
        }
    }
    throw Problem(fmt::format("'{}' is no input, output, register, TIMER, COUNTER, INPOS or ERROR", name));
}

}  // namespace nplc::dap
