#include "hal_mcu/nrf51/timer_clock.h"

#include "hal_mcu/cortex_m/core.h"
#include "registers.h"

namespace nplc::hal_mcu::nrf51 {
namespace {

constexpr std::uint32_t kTo1MHz = 4;  // 16 MHz / 2^4
constexpr std::uint32_t kTick = 1'000;
constexpr unsigned kForLoop = 0;  // capture registers
constexpr unsigned kForInterrupt = 1;

std::uint32_t capture(unsigned into) {
    timer0().TASKS_CAPTURE[into] = 1;
    return timer0().CC[into];
}

}  // namespace

void TimerClock::begin() {
    timer0().BITMODE = kTimer32Bits;
    timer0().PRESCALER = kTo1MHz;
    timer0().TASKS_START = 1;
    timer1().BITMODE = kTimer16Bits;
    timer1().PRESCALER = kTo1MHz;
    timer1().CC[0] = kTick;
    timer1().SHORTS = kTimerCompare0Clears;
    timer1().INTENSET = kTimerCompare0;
    timer1().TASKS_START = 1;
    cortex_m::enable_interrupt(kInterrupt);
}

base::Instant TimerClock::now() {
    const std::uint32_t counted = capture(kForLoop);
    time_ += base::Microseconds(counted - last_);
    last_ = counted;
    return time_;
}

std::uint32_t TimerClock::on_interrupt() {
    timer1().EVENTS_COMPARE[0] = 0;
    return capture(kForInterrupt);
}

}  // namespace nplc::hal_mcu::nrf51
