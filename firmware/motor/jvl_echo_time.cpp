#include "motor/jvl_echo_time.h"

#include <algorithm>

namespace nplc::motor {
namespace {

constexpr base::Microseconds kLeastPause{8'000};  ///< longer than lost characters explain

std::uint32_t within(base::Microseconds most, base::Microseconds time) {
    return static_cast<std::uint32_t>(std::clamp(time, base::Microseconds(0), most).count());
}

}  // namespace

void MeasuredEchoTime::learn(base::Microseconds late) {
    const std::uint32_t sample = within(std::chrono::seconds(1), late);
    const std::uint32_t before = is_known_ ? late_ : pause_;
    late_ = wait_ = sample > before ? sample : before - (before - sample) / 16;
    is_known_ = true;
}

void MeasuredEchoTime::doubt() {
    wait_ = 2 * wait_ + 2'000;
    if (base::Microseconds(wait_) > kMost) forget();
}

void MeasuredEchoTime::pause(base::Microseconds time) {
    if (time <= kLeastPause) return;
    std::uint32_t& known = is_known_ ? late_ : pause_;
    known = std::max(known, within(kMost, time));
}

}  // namespace nplc::motor
