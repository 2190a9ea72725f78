#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "seqc/seqc.h"

/// A program on the simulated board with its virtual motor, in virtual time that is stopped between two
/// calls.
namespace nplc::rehearsal {

struct Options {
    std::string scenario;       ///< its text; empty: inputs are set by hand
    std::string scenario_file;  ///< for messages
    std::string motor;          ///< MAC140 or MAC34-1; empty: the program's own
};

struct State {
    std::uint64_t time_us = 0;
    std::uint8_t step = 0;
    std::uint16_t timer = 0;  ///< ms
    std::uint16_t counter = 0;
    std::uint8_t inputs = 0;  ///< at the terminals
    std::uint8_t outputs = 0;
    bool in_position = false;
    bool error = false;
    bool link_up = false;
    bool running = false;
    std::int32_t p_ist = 0;  ///< counts
    std::int32_t v_ist = 0;  ///< counts/sample
};

enum class Stop : std::uint8_t {
    time,        ///< the limit
    breakpoint,  ///< such a step was entered
    step,        ///< the step has changed
    scan,        ///< any visible change of the sequence
    error,       ///< ERROR became 1
    failure,     ///< an expectation of the scenario failed
    end,         ///< of the scenario
};

struct Until {
    std::uint64_t limit_us = 0;     ///< of virtual time
    std::uint64_t breakpoints = 0;  ///< bit n: step n
    bool step = false;              ///< stop when the step changes
    bool scan = false;              ///< stop at any change
    bool error = false;             ///< stop when ERROR becomes 1
    bool failure = true;            ///< stop when an expectation fails
};

/// A message for the console: an order, a remark, an expectation.
struct Remark {
    std::uint64_t time_us = 0;
    std::string text;
    bool important = false;
};

class Rehearsal {
  public:
    struct Opened {
        std::unique_ptr<Rehearsal> rehearsal;
        std::string error;  ///< why it could not be opened
    };
    /// `program` must be without errors.
    static Opened open(const seqc::Compilation& program, const Options& options);

    virtual ~Rehearsal() = default;
    Rehearsal(const Rehearsal&) = delete;
    Rehearsal& operator=(const Rehearsal&) = delete;

    virtual Stop run(const Until& until) = 0;
    virtual State state() const = 0;
    virtual void set_input(unsigned index, bool level) = 0;
    /// Raw bits of a register of the motor; empty for a drive of another family.
    virtual std::optional<std::int64_t> read_register(std::uint8_t number) const = 0;
    /// Written as by a client; false if not possible.
    virtual bool write_register(std::uint8_t number, std::int64_t value) = 0;
    virtual std::vector<Remark> take_remarks() = 0;
    /// To be called once, at the end: the number of passed and failed expectations as text.
    virtual std::string verdict() = 0;

  protected:
    Rehearsal() = default;
};

}  // namespace nplc::rehearsal
