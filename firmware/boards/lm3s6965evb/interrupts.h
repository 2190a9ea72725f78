#pragma once

/// What the vector table leads to; in main.cpp, which has the drivers.
namespace nplc::board {

void on_systick();
void on_uart0();
void on_uart1();
void on_uart2();
void on_i2c0();

}  // namespace nplc::board
