#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "seqc/seqc.h"

namespace nplc::dap {

/// Error of a request, as a sentence for the user.
struct Problem : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A snapshot of a machine.
struct Look {
    std::string time;  ///< "1.250 s"; for a gateway since its start
    std::uint8_t step = 0;
    std::uint16_t timer = 0;
    std::uint16_t counter = 0;
    std::uint8_t inputs = 0;
    std::uint8_t outputs = 0;
    bool in_position = false;
    bool error = false;
    bool link = false;
    std::string state;  ///< "running", "held"
};

struct Variable {
    std::string name;
    std::string value;
    std::string type;  ///< "BOOL", the register's name
    bool can_be_set = false;
};

enum class StopReason : std::uint8_t { none, breakpoint, step, pause, exception, end };
struct Stopped {
    StopReason reason = StopReason::none;
    std::string text;
};

enum class Order : std::uint8_t { go_on, next_step, next_scan };

/// The debugged machine: a rehearsal or a gateway. All functions may throw Problem.
class Debuggee {
  public:
    virtual ~Debuggee() = default;
    Debuggee(const Debuggee&) = delete;
    Debuggee& operator=(const Debuggee&) = delete;

    virtual const seqc::Symbols& symbols() const = 0;
    virtual Look look() = 0;
    /// Bit n: step n.
    virtual void set_breakpoints(std::uint64_t steps) = 0;
    virtual void stop_on_error(bool /*yes*/) {}
    virtual void stop_on_failure(bool /*yes*/) {}
    virtual void start(Order order) = 0;
    /// While it runs: continues for a short time, or polls; returns why it has stopped, if it has.
    virtual Stopped tick() = 0;
    /// Returns why it has stopped; StopReason::none: it stops a little later.
    virtual Stopped pause() = 0;
    /// A machine that other clients operate too, not a rehearsal.
    virtual bool lives_by_itself() const { return false; }
    /// Starts a stopped sequence, or stops it: a machine's own run and stop.
    virtual void switch_sequence(bool run) = 0;
    virtual std::vector<Variable> registers() = 0;
    /// The terminal, whatever its name in the program says.
    virtual void set_input(unsigned index, bool level) = 0;
    virtual void set_output(unsigned index, bool level) = 0;
    /// Sets `text` with its unit; returns the resulting value.
    virtual std::string set_register(const std::string& name, const std::string& text) = 0;
    /// Console output since the last call.
    virtual std::vector<std::string> take_remarks() = 0;
    /// Disconnects and leaves the machine in a usable state; returns a final message.
    virtual std::string leave() = 0;
    /// Whether the result is a failure, for the exit code.
    virtual bool failed() const { return false; }

  protected:
    Debuggee() = default;
};

struct Rehearse {
    std::string program;  ///< files
    std::string scenario;
    std::string motor;
    bool realtime = false;
    double seconds = 0;  ///< limit of virtual time; 0: the scenario's end, else 60
};
std::unique_ptr<Debuggee> rehearse(const Rehearse& options);

struct Attach {
    std::string program;
    std::string endpoint;
    std::uint32_t baud = 19'200;
    std::optional<std::uint8_t> address;  ///< empty: the gateway's default
};
std::unique_ptr<Debuggee> attach(const Attach& options);

/// A program, compiled; throws Problem with the first message.
struct CompiledProgram {
    seqc::Sources sources;
    seqc::Compilation compilation;
};
CompiledProgram compiled(const std::string& file);

}  // namespace nplc::dap
