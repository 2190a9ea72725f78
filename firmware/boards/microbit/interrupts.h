#pragma once

/// Targets of the vector table, defined in main.cpp with the drivers.
namespace nplc::board {

void on_timer1();
void on_uart0();

}  // namespace nplc::board
