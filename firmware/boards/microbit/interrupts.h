#pragma once

/// What the vector table leads to; in main.cpp, which has the drivers.
namespace nplc::board {

void on_timer1();
void on_uart0();

}  // namespace nplc::board
