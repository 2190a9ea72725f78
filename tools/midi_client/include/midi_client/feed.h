#pragma once

#include <optional>

#include "midi_client/plan.h"

namespace nplc::midi_client {

/// Segments that wait beside the one that runs (000 §VI 16h; R).
inline constexpr std::size_t kFifo = 3;

/// Which module gets its next segment when, so that no FIFO is offered more than it holds or runs empty. Time
/// in ticks from the moment at which all modules begin with their lead-in together.
class Feed {
  public:
    /// Keeps a reference to `plan`.
    Feed(const Plan& plan, std::int64_t lead_in);

    struct Next {
        std::size_t axis = 0;
        Segment segment{};
        std::int64_t free = 0;      ///< from then on its FIFO has a place
        std::int64_t deadline = 0;  ///< its FIFO is empty and the segment before has ended: too late
    };
    /// Of all axes the one whose FIFO runs empty first of those that have a place first; nothing when all is
    /// sent.
    std::optional<Next> next() const;
    /// The segment of next() was taken.
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

/// Whether messages that take `message` ticks each can keep all FIFOs fed, with `reserve` ticks to spare;
/// empty, or a sentence on what cannot be kept up.
std::string feeding_problem(const Plan& plan, std::int64_t lead_in, std::int64_t message,
                            std::int64_t reserve);

}  // namespace nplc::midi_client
