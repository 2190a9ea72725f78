#include "hal_mcu/nrf51/timer_clock.h"

#include "hal_mcu/cortex_m/core.h"
#include "registers.h"

namespace nplc::hal_mcu::nrf51 {
namespace {

constexpr std::uint32_t kTo1MHz = 4;  // 16 MHz / 2^4
constexpr std::uint32_t kTick = 1'000;
constexpr unsigned kNext = 0;  // compare registers
constexpr unsigned kForLoop = 1;
constexpr unsigned kForInterrupt = 2;

std::uint32_t capture(unsigned into) {
    timer0().TASKS_CAPTURE[into] = 1;
    return timer0().CC[into];
}

}  // namespace

void TimerClock::begin() {
    timer0().BITMODE = kTimer32Bits;
    timer0().PRESCALER = kTo1MHz;
    timer0().CC[kNext] = kTick;
    timer0().INTENSET = kTimerCompare0;
    timer0().TASKS_START = 1;
    cortex_m::enable_interrupt(kInterrupt);
}

base::Instant TimerClock::now() {
    const std::uint32_t counted = capture(kForLoop);
    time_ += base::Microseconds(counted - last_);
    last_ = counted;
    return time_;
}

/// From now on, so that a tick which was held up (an erasure halts the core) never misses the next.
void TimerClock::on_interrupt() {
    timer0().EVENTS_COMPARE[kNext] = 0;
    timer0().CC[kNext] = capture(kForInterrupt) + kTick;
}

}  // namespace nplc::hal_mcu::nrf51
