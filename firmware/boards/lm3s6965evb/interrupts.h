#pragma once

/// Targets of the vector table, defined in main.cpp with the drivers.
namespace nplc::board {

void on_systick();
void on_uart0();
void on_uart1();
void on_uart2();
void on_i2c0();

}  // namespace nplc::board
