#pragma once

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "debuggee.h"
#include "seqc/conditions.h"

namespace nplc::dap {

using Json = nlohmann::json;

/// Source position of a step.
struct StepPlace {
    std::string file;
    std::uint32_t line = 0;  ///< from 1; 0: nowhere
};

/// A file's name without its folders.
inline std::string last_name(const std::string& path) {
    return path.substr(path.find_last_of("/\\") + 1);
}

/// The debug adapter without streams and threads: requests in, responses and events out.
class Adapter {
  public:
    using Send = std::function<void(Json)>;

    explicit Adapter(Send send) : send_(std::move(send)) {}

    void receive(const Json& message);
    /// The debuggee runs: tick() must be called.
    bool runs() const { return running_; }
    bool realtime() const { return realtime_; }
    void tick();
    /// A machine that other clients may start too: look() must be called regularly while it does not run
    /// here.
    bool looks_on() const { return debuggee_ && debuggee_->lives_by_itself() && !ended_; }
    void look();
    bool ended() const { return ended_; }

  private:
    Json answer(const std::string& command, const Json& arguments);
    Json initialize();
    Json launch(const Json& arguments);
    Json attach_to(const Json& arguments);
    void begin(std::unique_ptr<Debuggee> debuggee, const Json& arguments);
    Json set_breakpoints(const Json& arguments);
    Json set_function_breakpoints(const Json& arguments);
    Json set_exception_breakpoints(const Json& arguments);
    Json configuration_done();
    Json stack_trace();
    Json scopes();
    Json variables(const Json& arguments);
    Json set_variable(const Json& arguments);
    Json evaluate(const Json& arguments);
    Json go(Order order);
    Json pause();
    Json disconnect();
    Json switch_machine(bool run);

    std::vector<Variable> variables_in(int scope);
    std::string set(int scope, const std::string& name, const std::string& value);
    std::optional<std::uint8_t> step_named(const std::string& name) const;
    std::uint64_t with_copies(std::uint8_t step) const;
    StepPlace place_of_step(std::uint8_t step) const;
    Json conditions_now(const Look& look) const;
    void apply_breakpoints();
    void stopped(const Stopped& why);
    void tell_remarks();
    /// For views that follow the machine: event `seqc/state` at each change.
    void tell_state();
    void tell_state(const Look& look);
    void output(const std::string& text, const char* category = "console");
    void event(const std::string& name, Json body = Json::object());
    Debuggee& debuggee();

    Send send_;
    int sequence_ = 0;
    std::unique_ptr<Debuggee> debuggee_;
    std::string program_;                 ///< the file
    std::vector<StepPlace> step_places_;  ///< by number
    std::unique_ptr<const seqc::Conditions> conditions_;
    std::map<std::string, std::uint64_t> line_breakpoints_;  ///< by file
    std::uint64_t name_breakpoints_ = 0;
    std::string told_state_;
    int line_base_ = 1;
    bool stop_on_entry_ = false;
    bool realtime_ = false;
    bool running_ = false;
    bool ended_ = false;
};

}  // namespace nplc::dap
