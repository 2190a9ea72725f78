#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace nplc::panel {

/// User actions on a simulated machine besides its gateway. For any thread; never waits for the simulation.
class Simulation {
  public:
    struct State {
        std::uint64_t milliseconds = 0;  ///< of virtual time
        bool is_paused = false;
        double speed = 1;            ///< virtual seconds per real second
        std::uint32_t recorded = 0;  ///< lines
        bool is_cut = false;         ///< the line to the motor is cut, by any client or scenario
        bool is_blocked = false;     ///< the shaft
        bool operator==(const State&) const = default;
    };
    virtual State state() const = 0;
    /// Carries out a scenario action, `Start := 1` or `motor power off`, as soon as possible, and records it.
    /// Empty, or a one-line error.
    virtual std::string act(std::string_view action) = 0;
    virtual void pause(bool on) = 0;
    /// 0.01 to 100.
    virtual void set_speed(double speed) = 0;
    /// Records an action that was carried out over the gateway.
    virtual void note(std::string_view action) = 0;
    /// All recorded actions, as a scenario that repeats them.
    virtual std::string record() const = 0;
    virtual void clear_record() = 0;

  protected:
    ~Simulation() = default;
};

}  // namespace nplc::panel
