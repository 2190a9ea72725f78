#include "hal_mcu/cortex_m/image_start.h"

#include "registers.h"

namespace nplc::hal_mcu::cortex_m {

void use_vectors(std::uint32_t vectors) {
    system_control().VTOR = vectors;
    asm volatile("dsb\n\tisb" ::: "memory");
}

void start_image(std::uint32_t vectors) {
    const auto* const table = reinterpret_cast<const std::uint32_t*>(vectors);
    asm volatile(
        "msr msp, %0\n\t"
        "bx %1"
        :
        : "r"(table[0]), "r"(table[1])
        : "memory");
    __builtin_unreachable();
}

}  // namespace nplc::hal_mcu::cortex_m
