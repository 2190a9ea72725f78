#include "hal_mcu/cortex_m/core.h"

#include "registers.h"

namespace nplc::hal_mcu::cortex_m {

void enable_interrupt(unsigned number) {
    interrupt_enable()[number / 32] = 1U << (number % 32);
}

void pend_interrupt(unsigned number) {
    interrupt_pending()[number / 32] = 1U << (number % 32);
}

void forbid_interrupts() {
    asm volatile("cpsid i" ::: "memory");
}

void allow_interrupts() {
    asm volatile("cpsie i" ::: "memory");
}

void sleep() {
    asm volatile("dsb\n\twfi" ::: "memory");
}

void reset() {
    asm volatile("dsb" ::: "memory");
    system_control().AIRCR = kAircrKey | kAircrReset;
    for (;;) asm volatile("dsb" ::: "memory");
}

}  // namespace nplc::hal_mcu::cortex_m
