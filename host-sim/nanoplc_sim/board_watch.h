#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/world.h"
#include "timeline.h"

namespace nplc::sim {

/// Adds changes of the gateway's safe state, of the motor and of the watchdog to the timeline.
class BoardWatch {
  public:
    /// Both must outlive it.
    BoardWatch(World& world, Timeline& timeline) : world_(world), timeline_(timeline) {}

    /// To be called after each step.
    void look();
    /// No step has begun because the motor has not answered, for longer than a connected one takes.
    bool waits_for_motor() const;

  private:
    World& world_;
    Timeline& timeline_;
    gateway::SafeReason reason_ = gateway::SafeReason::not_started;
    std::string motor_note_;
    std::uint32_t bites_ = 0;
    std::optional<Time> waiting_since_;
    bool said_that_it_waits_ = false;
};

}  // namespace nplc::sim
