// When the loop must be polled again if nothing arrives.
#include <algorithm>

#include "gateway/gateway.h"
#include "gateway/status_light.h"

namespace nplc::gateway {

namespace {

constexpr base::Microseconds kTick{1};

}  // namespace

base::Instant Gateway::next_poll(base::Instant now, base::Instant motors) {
    base::Instant next = std::min({motors, debouncer_.next_update(), quick_debouncer_.next_update(),
                                   forces_.end(settings_.force_time)});
    if (settings_.status_output) {
        const std::uint32_t beat = next_status_light(run_state_, safe_reason_, uptime_.milliseconds());
        if (beat != 0) next = std::min(next, uptime_.in(beat));
    }
    next = std::max(now, std::min(next, next_work(now)));
    may_rest_until_ = next;
    return next;
}

base::Instant Gateway::next_work(base::Instant now) const {
    const base::Instant patience = progress_ + settings_.longest_wait + kTick;
    switch (run_state_) {
        case RunState::stopped:
        case RunState::held:
            return base::kNever;
        case RunState::waiting_for_motor: {
            if (!motor::delivers(ports_.motor.link())) return base::kNever;
            const bool has_to_stop = settings_.on_start == OnStart::stop && !stop_ordered_;
            return has_to_stop || ports_.motor.settled() ? now : base::kNever;
        }
        case RunState::holding:
            return ports_.motor.settled() ? now : patience;
        case RunState::running:
            if (resumes_) return now;
            if (in_scan_) return ports_.motor.has_room() ? now : patience;
            if (hold_after_ == HoldAfter::at_once) return now;
            if (!ports_.motor.settled()) return rests_ ? now : patience;
            return next_scan(now);
    }
    return now;
}

/// At once unless it would do nothing; else when the timer is 0, the only part of a key that nobody brings.
base::Instant Gateway::next_scan(base::Instant now) const {
    if (quiet_key_ != engine_.key(present_image())) return std::max(now, next_scan_);
    const std::uint16_t timer = engine_.state().timer;
    return timer == 0 ? base::kNever : ticked_ + base::Milliseconds(timer);
}

}  // namespace nplc::gateway
