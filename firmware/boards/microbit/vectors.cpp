#include "hal_mcu/cortex_m/start.h"
#include "hal_mcu/nrf51/timer_clock.h"
#include "hal_mcu/nrf51/uart.h"
#include "interrupts.h"

namespace nplc::board {
namespace {

using hal_mcu::cortex_m::Handler;
using hal_mcu::cortex_m::VectorsOfCore;

extern "C" std::uint32_t link_stack_top;

constexpr unsigned kInterrupts = 32;

struct Vectors {
    VectorsOfCore core;
    Handler chip[kInterrupts];
};

constexpr Handler kFault = hal_mcu::cortex_m::nplc_fault;

constexpr Vectors make() {
    Vectors vectors{.core = hal_mcu::cortex_m::vectors_of_core(&link_stack_top, kFault), .chip = {}};
    for (Handler& handler : vectors.chip) handler = kFault;  // the watchdog's too
    vectors.chip[hal_mcu::nrf51::Uart::kInterrupt] = on_uart0;
    vectors.chip[hal_mcu::nrf51::TimerClock::kInterrupt] = on_timer1;
    return vectors;
}

[[gnu::section(".vectors"), gnu::used]] constinit const Vectors vectors = make();

}  // namespace
}  // namespace nplc::board
