#include "hal_mcu/cortex_m/start.h"

namespace nplc::mcu_units {
namespace {

using namespace hal_mcu::cortex_m;

extern "C" std::uint32_t link_stack_top;

[[gnu::section(".vectors"), gnu::used]] constinit const VectorsOfCore vectors =
    vectors_of_core(&link_stack_top, nplc_fault);

}  // namespace
}  // namespace nplc::mcu_units
