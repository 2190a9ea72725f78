#include "hal_mcu/cortex_m/start.h"
#include "interrupts.h"

namespace nplc::board {
namespace {

using hal_mcu::cortex_m::Handler;
using hal_mcu::cortex_m::VectorsOfCore;

extern "C" std::uint32_t link_stack_top;

constexpr unsigned kInterrupts = 44;  // 0 to 43, data sheet

struct Vectors {
    VectorsOfCore core;
    Handler chip[kInterrupts];
};

constexpr Handler kFault = hal_mcu::cortex_m::nplc_fault;

constexpr Vectors make() {
    Vectors vectors{.core = hal_mcu::cortex_m::vectors_of_core(&link_stack_top, on_systick), .chip = {}};
    for (Handler& handler : vectors.chip) handler = kFault;  // the watchdog's too
    vectors.chip[5] = on_uart0;
    vectors.chip[6] = on_uart1;
    vectors.chip[8] = on_i2c0;
    vectors.chip[33] = on_uart2;
    return vectors;
}

[[gnu::section(".vectors"), gnu::used]] constinit const Vectors vectors = make();

}  // namespace
}  // namespace nplc::board
