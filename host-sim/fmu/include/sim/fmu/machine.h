#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "sim/fmu/setup.h"
#include "sim/fmu/variables.h"
#include "sim/text.h"

namespace nplc::sim::fmu {

/// A machine that cannot be, with the reason for the user.
struct BadMachine : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What an FMU holds: a motor, or a gateway and its motor, in virtual time from 0.
class Machine {
  public:
    Machine() = default;
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;
    virtual ~Machine() = default;

    /// Before the first advance().
    virtual void take_parameters(const Values& values) = 0;
    /// An input gets another value, now.
    virtual void set(Id input, double value) = 0;
    /// Does what happens until `limit`, and at it.
    virtual void advance(Time limit) = 0;
    /// Writes the outputs as they stand, and nothing else.
    virtual void read(Values& values) = 0;
};

/// Throws BadMachine.
std::unique_ptr<Machine> make_machine(const Setup& setup);

}  // namespace nplc::sim::fmu
