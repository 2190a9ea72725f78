#pragma once

#include <cstdint>

namespace nplc::hal_mcu::cortex_m {

void enable_interrupt(unsigned number);
/// As if its device had asked for it.
void pend_interrupt(unsigned number);
void forbid_interrupts();
void allow_interrupts();
/// Until the next interrupt; also with interrupts forbidden, when one that is pending ends it at once.
void sleep();
[[noreturn]] void reset();

}  // namespace nplc::hal_mcu::cortex_m
