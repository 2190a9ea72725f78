#include "adapter.h"

#include <fmt/format.h>

#include <algorithm>

#include "text/text.h"

namespace nplc::dap {
namespace {

constexpr int kThread = 1;
constexpr unsigned kSteps = 63;

std::string text_in(const Json& object, const char* name) {
    const Json value = object.is_object() ? object.value(name, Json()) : Json();
    return value.is_string() ? value.get<std::string>() : "";
}

bool flag_in(const Json& object, const char* name) {
    const Json value = object.is_object() ? object.value(name, Json()) : Json();
    return value.is_boolean() && value.get<bool>();
}

double number_in(const Json& object, const char* name, double otherwise) {
    const Json value = object.is_object() ? object.value(name, Json()) : Json();
    return value.is_number() ? value.get<double>() : otherwise;
}

const char* reason_text(StopReason reason) {
    switch (reason) {
        case StopReason::breakpoint:
            return "breakpoint";
        case StopReason::step:
            return "step";
        case StopReason::pause:
            return "pause";
        default:
            return "exception";
    }
}

}  // namespace

Debuggee& Adapter::debuggee() {
    if (!debuggee_) throw Problem("launch or attach comes first");
    return *debuggee_;
}

void Adapter::event(const std::string& name, Json body) {
    send_({{"seq", ++sequence_}, {"type", "event"}, {"event", name}, {"body", std::move(body)}});
}

void Adapter::output(const std::string& text, const char* category) {
    if (!text.empty()) event("output", {{"category", category}, {"output", text + "\n"}});
}

void Adapter::receive(const Json& message) {
    if (text_in(message, "type") != "request") return;
    const std::string command = text_in(message, "command");
    Json response = {{"seq", 0},
                     {"type", "response"},
                     {"request_seq", message.value("seq", 0)},
                     {"command", command},
                     {"success", true}};
    try {
        Json body = answer(command, message.value("arguments", Json::object()));
        if (!body.is_null()) response["body"] = std::move(body);
    } catch (const Problem& problem) {
        response["success"] = false;
        response["message"] = problem.what();
        response["body"] = {{"error", {{"id", 1}, {"format", problem.what()}, {"showUser", true}}}};
    } catch (const Json::exception& problem) {
        response["success"] = false;
        response["message"] = problem.what();
    }
    response["seq"] = ++sequence_;
    const bool worked = response["success"].get<bool>();
    send_(std::move(response));
    if (!worked) return;
    if (command == "launch" || command == "attach") event("initialized");
    const bool goes =
        command == "continue" || command == "next" || command == "stepIn" || command == "stepOut";
    if (command == "configurationDone" && !running_) stopped({StopReason::pause, "entry"});
    if (goes) tell_state();
    if (command == "pause" && !running_) stopped({StopReason::pause, "pause"});
    if (command == "disconnect" || command == "terminate") event("terminated");
}

Json Adapter::answer(const std::string& command, const Json& arguments) {
    if (command == "initialize") {
        line_base_ = arguments.value("linesStartAt1", true) ? 1 : 0;
        return initialize();
    }
    if (command == "launch") return launch(arguments);
    if (command == "attach") return attach_to(arguments);
    if (command == "setBreakpoints") return set_breakpoints(arguments);
    if (command == "setFunctionBreakpoints") return set_function_breakpoints(arguments);
    if (command == "setExceptionBreakpoints") return set_exception_breakpoints(arguments);
    if (command == "configurationDone") return configuration_done();
    if (command == "threads") return {{"threads", {{{"id", kThread}, {"name", "sequence"}}}}};
    if (command == "stackTrace") return stack_trace();
    if (command == "scopes") return scopes();
    if (command == "variables") return variables(arguments);
    if (command == "setVariable") return set_variable(arguments);
    if (command == "evaluate") return evaluate(arguments);
    if (command == "continue") return go(Order::go_on);
    if (command == "next" || command == "stepOut") return go(Order::next_step);
    if (command == "stepIn") return go(Order::next_scan);
    if (command == "pause") return pause();
    if (command == "disconnect" || command == "terminate") return disconnect();
    if (command == "seqc/run" || command == "seqc/stop") return switch_machine(command == "seqc/run");
    throw Problem(fmt::format("there is no '{}' here", command));
}

Json Adapter::initialize() {
    return {{"supportsConfigurationDoneRequest", true},
            {"supportsFunctionBreakpoints", true},
            {"supportsSetVariable", true},
            {"supportsEvaluateForHovers", true},
            {"supportsTerminateRequest", true},
            {"exceptionBreakpointFilters",
             {{{"filter", "error"}, {"label", "ERROR comes"}, {"default", false}},
              {{"filter", "expectation"},
               {"label", "an expectation of the scenario fails"},
               {"default", true}}}}};
}

Json Adapter::launch(const Json& arguments) {
    Rehearse options;
    options.program = text_in(arguments, "program");
    options.scenario = text_in(arguments, "scenario");
    options.motor = text_in(arguments, "motor");
    options.realtime = flag_in(arguments, "realtime");
    options.seconds = number_in(arguments, "seconds", 0);
    if (options.program.empty()) throw Problem("launch needs \"program\", a .seq file");
    realtime_ = options.realtime;
    begin(rehearse(options), arguments);
    debuggee_->stop_on_failure(true);
    return Json();
}

Json Adapter::attach_to(const Json& arguments) {
    Attach options;
    options.program = text_in(arguments, "program");
    options.endpoint = text_in(arguments, "endpoint");
    options.baud = static_cast<std::uint32_t>(number_in(arguments, "baud", options.baud));
    if (arguments.contains("address"))
        options.address = static_cast<std::uint8_t>(number_in(arguments, "address", 0));
    if (options.program.empty())
        throw Problem("attach needs \"program\", the .seq file that the gateway runs");
    if (options.endpoint.empty())
        throw Problem(
            "attach needs \"endpoint\", such as /dev/ttyUSB0, pty:PATH, unix:PATH or tcp:127.0.0.1:PORT");
    realtime_ = true;
    begin(attach(options), arguments);
    return Json();
}

void Adapter::begin(std::unique_ptr<Debuggee> debuggee, const Json& arguments) {
    program_ = text_in(arguments, "program");
    stop_on_entry_ = flag_in(arguments, "stopOnEntry");
    CompiledProgram program = compiled(program_);
    step_places_.assign(kSteps, {});
    const seqc::Places places(program.sources);
    for (const seqc::StepOrigin& step : program.compilation.steps) {
        if (step.span.length == 0 || step.number >= kSteps) continue;
        const seqc::ShownPlace place = places.of(step.span.offset);
        step_places_[step.number] = {place.file->name, place.at.line};
    }
    conditions_ = std::make_unique<const seqc::Conditions>(std::move(program.sources));
    debuggee_ = std::move(debuggee);
}

/// Maps a line to its step: a breakpoint holds when its step is entered.
Json Adapter::set_breakpoints(const Json& arguments) {
    debuggee();
    Json list = Json::array();
    std::string file = text_in(arguments.value("source", Json::object()), "path");
    if (file.empty()) file = program_;
    const auto is_here = [&](const StepPlace& place) {
        return place.line != 0 && (place.file == file || last_name(place.file) == last_name(file));
    };
    std::uint64_t& breakpoints = line_breakpoints_[file];
    breakpoints = 0;
    for (const Json& wanted : arguments.value("breakpoints", Json::array())) {
        const auto line = static_cast<std::uint32_t>(number_in(wanted, "line", 0) + (1 - line_base_));
        std::uint32_t best = 0;
        std::uint8_t step = 0;
        for (std::uint8_t number = 0; number < kSteps; ++number) {
            const StepPlace& place = step_places_[number];
            if (is_here(place) && place.line <= line && place.line > best) {
                best = place.line;
                step = number;
            }
        }
        if (best == 0) {
            list.push_back({{"verified", false}, {"message", "no step begins here or above"}});
            continue;
        }
        breakpoints |= with_copies(step);
        list.push_back(
            {{"verified", true},
             {"line", static_cast<int>(best) - (1 - line_base_)},
             {"message", fmt::format("holds when step {} is entered", debuggee().symbols().steps[step])}});
    }
    apply_breakpoints();
    return {{"breakpoints", list}};
}

Json Adapter::set_function_breakpoints(const Json& arguments) {
    Json list = Json::array();
    name_breakpoints_ = 0;
    debuggee();
    for (const Json& wanted : arguments.value("breakpoints", Json::array())) {
        const auto step = step_named(text_in(wanted, "name"));
        if (step) name_breakpoints_ |= with_copies(*step);
        list.push_back(step ? Json{{"verified", true}}
                            : Json{{"verified", false}, {"message", "there is no such step"}});
    }
    apply_breakpoints();
    return {{"breakpoints", list}};
}

Json Adapter::set_exception_breakpoints(const Json& arguments) {
    const Json filters = arguments.value("filters", Json::array());
    const auto has = [&](const char* name) {
        return std::find(filters.begin(), filters.end(), name) != filters.end();
    };
    debuggee().stop_on_error(has("error"));
    debuggee().stop_on_failure(has("expectation"));
    return Json::object();
}

void Adapter::apply_breakpoints() {
    std::uint64_t all = name_breakpoints_;
    for (const auto& [file, breakpoints] : line_breakpoints_) all |= breakpoints;
    debuggee().set_breakpoints(all);
}

Json Adapter::configuration_done() {
    if (stop_on_entry_) return Json();
    try {
        go(Order::go_on);
    } catch (const Problem& problem) {  // a gateway with a stopped sequence can still be inspected
        output(problem.what(), "important");
    }
    return Json();
}

Json Adapter::go(Order order) {
    debuggee().start(order);
    running_ = true;
    return {{"allThreadsContinued", true}};
}

Json Adapter::pause() {
    if (running_ && debuggee().pause().reason != StopReason::none) running_ = false;
    return Json::object();
}

void Adapter::tick() {
    if (!running_) return;
    try {
        const Stopped why = debuggee().tick();
        tell_remarks();
        if (why.reason == StopReason::none) return tell_state();
        running_ = false;
        stopped(why);
    } catch (const Problem& problem) {
        running_ = false;
        output(problem.what(), "stderr");
        event("terminated");
    }
}

void Adapter::look() {
    if (running_ || !debuggee_) return;
    try {
        const Look now = debuggee_->look();
        if (now.state == "running") {  // by another client
            running_ = true;
            event("continued", {{"threadId", kThread}, {"allThreadsContinued", true}});
        }
        tell_state(now);
    } catch (const Problem& problem) {
        output(problem.what(), "stderr");
        event("terminated");
        ended_ = true;
    }
}

void Adapter::stopped(const Stopped& why) {
    running_ = false;
    tell_remarks();
    tell_state();
    if (why.reason == StopReason::end) {
        output(why.text.empty() ? "the rehearsal has ended" : why.text);
        event("exited", {{"exitCode", debuggee().failed() ? 1 : 0}});
        event("terminated");
        return;
    }
    event("stopped", {{"reason", why.text == "entry" ? "entry" : reason_text(why.reason)},
                      {"description", why.text},
                      {"threadId", kThread},
                      {"allThreadsStopped", true}});
}

void Adapter::tell_remarks() {
    for (const std::string& line : debuggee().take_remarks()) output(line, "stdout");
}

void Adapter::tell_state() {
    if (debuggee_) tell_state(debuggee_->look());
}

void Adapter::tell_state(const Look& look) {
    const StepPlace place = place_of_step(look.step);
    Json body = {{"step", look.step},         {"name", debuggee_->symbols().steps[look.step]},
                 {"line", place.line},        {"file", place.line == 0 ? program_ : place.file},
                 {"inputs", look.inputs},     {"outputs", look.outputs},
                 {"inpos", look.in_position}, {"error", look.error},
                 {"state", look.state},       {"conditions", conditions_now(look)}};
    std::string now = body.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (now == told_state_) return;
    told_state_ = std::move(now);
    body["time"] = look.time;
    body["timer"] = look.timer;
    body["counter"] = look.counter;
    event("seqc/state", std::move(body));
}

/// Runs or stops the sequence itself, independent of the debugger's hold.
Json Adapter::switch_machine(bool run) {
    debuggee().switch_sequence(run);
    if (run && !running_) event("continued", {{"threadId", kThread}, {"allThreadsContinued", true}});
    running_ = run || running_;
    tell_remarks();
    tell_state();
    return Json::object();
}

Json Adapter::disconnect() {
    running_ = false;
    ended_ = true;
    if (!debuggee_) return Json();
    try {
        output(debuggee_->leave());
    } catch (const Problem& problem) {  // connection lost: nothing to clean up
        output(problem.what(), "important");
    }
    return Json();
}

}  // namespace nplc::dap
