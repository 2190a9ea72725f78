#include "hal_mcu/cortex_m/image_start.h"

extern "C" std::uint32_t link_forward;

namespace nplc::hal_mcu::cortex_m {

void forward_to(std::uint32_t vectors) {
    link_forward = vectors;
}

/// The registers it uses are already on the stack.
extern "C" [[gnu::naked]] void nplc_forward() {
    asm volatile(
        ".syntax unified\n\t"
        "ldr r0, =link_forward\n\t"
        "ldr r0, [r0]\n\t"
        "mrs r1, ipsr\n\t"
        "lsls r1, r1, #2\n\t"
        "ldr r0, [r0, r1]\n\t"
        "bx r0\n\t"
        ".ltorg");
}

}  // namespace nplc::hal_mcu::cortex_m
