#pragma once

#include <cstdint>
#include <vector>

#include "random_tables.h"
#include "sim/world.h"

namespace nplc::property {

/// A sequence whose every step waits for IN0 to change and then sends some orders, run beside a client
/// program that never pauses. The input changes at fixed times, so that what is ordered does not depend on
/// how long the motor's line is taken.
class PortTraffic {
  public:
    enum class Traffic { none, reads, anything };

    /// The same seed gives the same sequence, whatever the traffic.
    PortTraffic(std::uint64_t seed, Traffic traffic, sim::Polling polling = sim::Polling::steadily);

    void run();

    struct Ordered {
        sim::SentOrder order;
        sim::Time at{};
    };
    const std::vector<Ordered>& ordered() const { return ordered_; }
    /// Outputs and step before each change of the input.
    const std::vector<unsigned>& trace() const { return trace_; }
    const sim::World& world() const { return world_; }
    /// Bytes that the port has answered.
    std::size_t answered() const { return answered_; }
    /// When the motor executed the sequence's orders; what only concerns the link is left out.
    std::vector<sim::Time> executed() const;

  private:
    static constexpr unsigned kChanges = 24;
    static constexpr sim::Time kBetween = std::chrono::milliseconds{400};

    static std::vector<std::uint8_t> table(std::uint64_t seed);
    void go_on(sim::Time until);
    void ask();
    std::vector<std::uint8_t> message();
    std::vector<std::uint8_t> other_message();

    Traffic traffic_;
    Dice dice_;
    sim::World world_;
    std::vector<Ordered> ordered_;
    std::vector<unsigned> trace_;
    std::size_t answered_ = 0;
    sim::Time next_question_{0};
};

}  // namespace nplc::property
