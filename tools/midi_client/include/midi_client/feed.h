#pragma once

#include <optional>

#include "midi_client/plan.h"

namespace nplc::midi_client {

/// Segments that a module queues in addition to the running one (000 §VI 16h; R).
inline constexpr std::size_t kFifo = 3;

/// Schedules the segments of all modules, so that no FIFO overflows or runs empty. Time in ticks from the
/// common start of all lead-ins.
class Feed {
  public:
    /// Keeps a reference to `plan`.
    Feed(const Plan& plan, std::int64_t lead_in);

    struct Next {
        std::size_t axis = 0;
        Segment segment{};
        std::int64_t free = 0;      ///< from then on its FIFO has a free place
        std::int64_t deadline = 0;  ///< its FIFO is empty and the segment before has ended: too late
    };
    /// Of the axes whose FIFO gets a free place first, the one whose FIFO runs empty first; nullopt when all
    /// is sent.
    std::optional<Next> next() const;
    /// The segment of next() was accepted.
    void taken(std::size_t axis);
    std::size_t sent(std::size_t axis) const { return axes_[axis].sent; }
    std::int64_t end() const;

  private:
    struct Axis {
        std::vector<std::int64_t> ends{};  ///< [0] the lead-in's, then each segment's
        std::size_t sent = 0;
    };
    Next next_of(std::size_t axis) const;

    const Plan& plan_;
    std::vector<Axis> axes_;
};

/// Whether messages that take `message` ticks each can keep all FIFOs filled, with a margin of `reserve`
/// ticks; empty, or a sentence on what is too fast.
std::string feeding_problem(const Plan& plan, std::int64_t lead_in, std::int64_t message,
                            std::int64_t reserve);

}  // namespace nplc::midi_client
