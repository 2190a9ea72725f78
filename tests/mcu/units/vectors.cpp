#include "hal_mcu/cortex_m/start.h"

namespace nplc::mcu_units {
namespace {

using hal_mcu::cortex_m::VectorsOfCore;

extern "C" std::uint32_t link_stack_top;

constexpr auto kFault = hal_mcu::cortex_m::nplc_fault;

[[gnu::section(".vectors"), gnu::used]] constinit const VectorsOfCore vectors{
    .stack = &link_stack_top,
    .reset = hal_mcu::cortex_m::nplc_reset,
    .nmi = kFault,
    .hard_fault = kFault,
    .memory_fault = kFault,
    .bus_fault = kFault,
    .usage_fault = kFault,
    .reserved_to_10 = {kFault, kFault, kFault, kFault},
    .svcall = kFault,
    .debug = kFault,
    .reserved_13 = kFault,
    .pendsv = kFault,
    .systick = kFault};

}  // namespace
}  // namespace nplc::mcu_units
