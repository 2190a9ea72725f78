#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace nplc::panel {

/// What a simulated machine lets a person do beside its gateway. For any thread; nothing waits for the
/// simulation.
class Simulation {
  public:
    struct State {
        std::uint64_t milliseconds = 0;  ///< of virtual time
        bool is_paused = false;
        double speed = 1;            ///< virtual seconds in a real one
        std::uint32_t recorded = 0;  ///< lines
        bool operator==(const State&) const = default;
    };
    virtual State state() const = 0;
    /// An action of a scenario, `Start := 1` or `motor power off`, at the next moment, and into the record.
    /// Empty, or one line what is wrong.
    virtual std::string act(std::string_view action) = 0;
    virtual void pause(bool on) = 0;
    /// 0.01 to 100.
    virtual void set_speed(double speed) = 0;
    /// Into the record only: what the gateway was told to do, as an action.
    virtual void note(std::string_view action) = 0;
    /// All that was done, as a scenario that does the same.
    virtual std::string record() const = 0;
    virtual void clear_record() = 0;

  protected:
    ~Simulation() = default;
};

}  // namespace nplc::panel
