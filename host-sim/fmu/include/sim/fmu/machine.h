#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "sim/fmu/setup.h"
#include "sim/fmu/variables.h"
#include "sim/text.h"

namespace nplc::sim::fmu {

/// An impossible machine, with the reason for the user.
struct BadMachine : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The machine in an FMU: a motor, or a gateway and its motor, in virtual time from 0.
class Machine {
  public:
    Machine() = default;
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;
    virtual ~Machine() = default;

    /// To be called before the first advance().
    virtual void take_parameters(const Values& values) = 0;
    /// Sets an input to a new value at the present time.
    virtual void set(Id input, double value) = 0;
    /// Simulates up to `limit`, inclusive.
    virtual void advance(Time limit) = 0;
    /// Writes only the outputs, with their present values.
    virtual void read(Values& values) = 0;
};

/// Throws BadMachine.
std::unique_ptr<Machine> make_machine(const Setup& setup);

}  // namespace nplc::sim::fmu
