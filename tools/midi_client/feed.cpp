#include "midi_client/feed.h"

#include <fmt/format.h>

#include <algorithm>

#include "registers/midi_scale.h"

namespace nplc::midi_client {

Feed::Feed(const Plan& plan, std::int64_t lead_in) : plan_(plan) {
    for (const AxisPlan& axis : plan.axes) {
        Axis times;
        times.ends.push_back(lead_in);
        for (const Segment& one : axis.segments) times.ends.push_back(times.ends.back() + one.ticks());
        axes_.push_back(std::move(times));
    }
}

Feed::Next Feed::next_of(std::size_t axis) const {
    const auto& [ends, sent] = axes_[axis];
    return {.axis = axis,
            .segment = plan_.axes[axis].segments[sent],
            .free = sent < kFifo ? 0 : ends[sent - kFifo],
            .deadline = ends[sent]};
}

std::optional<Feed::Next> Feed::next() const {
    std::optional<Next> best;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        if (axes_[i].sent == plan_.axes[i].segments.size()) continue;
        const Next one = next_of(i);
        if (!best || one.free < best->free || (one.free == best->free && one.deadline < best->deadline))
            best = one;
    }
    return best;
}

void Feed::taken(std::size_t axis) {
    ++axes_[axis].sent;
}

std::int64_t Feed::end() const {
    std::int64_t last = 0;
    for (const Axis& axis : axes_) last = std::max(last, axis.ends.back());
    return last;
}

std::string feeding_problem(const Plan& plan, std::int64_t lead_in, std::int64_t message,
                            std::int64_t reserve) {
    Feed feed(plan, lead_in);
    std::int64_t now = 0;
    while (const auto next = feed.next()) {
        now = std::max(now, next->free) + message;
        if (now + reserve > next->deadline)
            return fmt::format(
                "axis {} would run out of segments {:.3f} s after the start: a message takes {:.1f} ms on "
                "this line; use fewer and longer segments, or less speed",
                plan.axes[next->axis].address,
                static_cast<double>(next->deadline - lead_in) / registers::midi::kTicksPerSecond,
                static_cast<double>(message) * 1000 / registers::midi::kTicksPerSecond);
        feed.taken(next->axis);
    }
    return {};
}

}  // namespace nplc::midi_client
