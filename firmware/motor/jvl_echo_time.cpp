#include "motor/jvl_echo_time.h"

namespace nplc::motor {
namespace {

constexpr std::uint32_t kLeastPause = 8'000;  ///< more than lost characters explain
constexpr std::uint32_t kMostSample = 1'000'000;

std::uint32_t clamped(base::Microseconds time, std::uint32_t most) {
    if (time.count() < 0) return 0;
    return time.count() > most ? most : static_cast<std::uint32_t>(time.count());
}

}  // namespace

void MeasuredEchoTime::learn(base::Microseconds late) {
    const std::uint32_t sample = clamped(late, kMostSample);
    const std::uint32_t before = is_known_ ? late_ : pause_;
    late_ = wait_ = sample > before ? sample : before - (before - sample) / 16;
    is_known_ = true;
}

void MeasuredEchoTime::doubt() {
    wait_ = 2 * wait_ + 2'000;
    if (wait_ > kMost) forget();
}

void MeasuredEchoTime::pause(base::Microseconds time) {
    const std::uint32_t sample = clamped(time, kMost);
    if (sample <= kLeastPause) return;
    std::uint32_t& known = is_known_ ? late_ : pause_;
    if (known < sample) known = sample;
}

}  // namespace nplc::motor
