#include "sim/coil.h"

#include <algorithm>

namespace nplc::sim {

bool Coil::usable(const Setup& setup) {
    return setup.left_thread <= setup.left_stop && setup.left_stop <= setup.right_stop &&
           setup.right_stop <= setup.right_thread;
}

void Coil::step(const Setup& setup, bool start, std::int64_t travel_16) {
    if (!usable(setup)) return;
    if (start) {
        started_ = true;
        to_the_left_ = setup.direction < 0;
        place_16_ = 16 * std::clamp(setup.start, setup.left_thread, setup.right_thread);
    } else if (started_) {
        travel(setup, travel_16);
    }
}

/// The way there and back laid out as one ring: from P1 to P4 in its first half, back in its second.
void Coil::travel(const Setup& setup, std::int64_t travel_16) {
    const std::int64_t left = 16 * setup.left_thread;
    const std::int64_t width = 16 * setup.right_thread - left;
    if (width == 0) {
        place_16_ = left;
        return;
    }
    const std::int64_t from_left = std::clamp<std::int64_t>(place_16_ - left, 0, width);
    const std::int64_t ring = 2 * width;
    std::int64_t on_ring = (to_the_left_ ? ring - from_left : from_left) + travel_16 % ring;
    on_ring = (on_ring % ring + ring) % ring;
    to_the_left_ = on_ring >= width;
    place_16_ = left + (to_the_left_ ? ring - on_ring : on_ring);
}

std::int64_t Coil::target_16(const Setup& setup, std::int64_t here_16) const {
    if (!started_ || !usable(setup)) return here_16;
    return std::clamp(place_16_, 16 * setup.left_stop, 16 * setup.right_stop);
}

}  // namespace nplc::sim
