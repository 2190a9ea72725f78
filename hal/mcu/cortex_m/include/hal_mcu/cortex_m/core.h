#pragma once

#include <cstdint>

namespace nplc::hal_mcu::cortex_m {

void enable_interrupt(unsigned number);
/// Sets an interrupt pending, as its device would.
void pend_interrupt(unsigned number);
void forbid_interrupts();
void allow_interrupts();
/// Sleeps until the next interrupt; also with interrupts disabled, where a pending one ends the sleep at
/// once.
void sleep();
[[noreturn]] void reset();

}  // namespace nplc::hal_mcu::cortex_m
