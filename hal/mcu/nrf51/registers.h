#pragma once

#include <cstdint>

/// Registers of Nordic's nRF51 series, named as in its reference manual; only those in use.
namespace nplc::hal_mcu::nrf51 {

using Register = volatile std::uint32_t;

struct PowerClockRegisters {
    Register TASKS_HFCLKSTART;  // 000h
    Register reserved_004[255];
    Register RESETREAS;  // 400h
};
inline constexpr std::uint32_t kResetByPin = 1U << 0;
inline constexpr std::uint32_t kResetByWatchdog = 1U << 1;

struct UartRegisters {
    Register TASKS_STARTRX;  // 000h
    Register TASKS_STOPRX;
    Register TASKS_STARTTX;
    Register TASKS_STOPTX;
    Register reserved_010[62];
    Register EVENTS_RXDRDY;  // 108h
    Register reserved_10C[4];
    Register EVENTS_TXDRDY;  // 11Ch
    Register reserved_120;
    Register EVENTS_ERROR;  // 124h
    Register reserved_128[119];
    Register INTENSET;  // 304h
    Register INTENCLR;
    Register reserved_30C[93];
    Register ERRORSRC;  // 480h
    Register reserved_484[31];
    Register ENABLE;  // 500h
    Register reserved_504;
    Register PSELRTS;
    Register PSELTXD;
    Register PSELCTS;
    Register PSELRXD;
    Register RXD;  // 518h
    Register TXD;
    Register reserved_520;
    Register BAUDRATE;  // 524h
    Register reserved_528[17];
    Register CONFIG;  // 56Ch
};
inline constexpr std::uint32_t kUartReceived = 1U << 2;  // of INTENSET
inline constexpr std::uint32_t kUartSent = 1U << 7;
inline constexpr std::uint32_t kUartError = 1U << 9;
inline constexpr std::uint32_t kUartOverrun = 1U << 0;  // of ERRORSRC
inline constexpr std::uint32_t kUartFraming = 1U << 2;
inline constexpr std::uint32_t kUartBreak = 1U << 3;
inline constexpr std::uint32_t kUartEnable = 4;

struct GpioRegisters {
    Register OUT;  // 504h
    Register OUTSET;
    Register OUTCLR;
    Register IN;
    Register DIR;
    Register DIRSET;
    Register DIRCLR;
    Register reserved_520[120];
    Register PIN_CNF[32];  // 700h
};
inline constexpr std::uint32_t kPinInput = 0;
inline constexpr std::uint32_t kPinOutput = 3;  // the input's buffer off
inline constexpr std::uint32_t kPinPullDown = 1U << 2;
inline constexpr std::uint32_t kPinPullUp = 3U << 2;

struct TimerRegisters {
    Register TASKS_START;  // 000h
    Register reserved_004[15];
    Register TASKS_CAPTURE[4];  // 040h
    Register reserved_050[60];
    Register EVENTS_COMPARE[4];  // 140h
    Register reserved_150[44];
    Register SHORTS;  // 200h
    Register reserved_204[64];
    Register INTENSET;  // 304h
    Register reserved_308[128];
    Register BITMODE;  // 508h
    Register reserved_50C;
    Register PRESCALER;  // 510h
    Register reserved_514[11];
    Register CC[4];  // 540h
};
inline constexpr std::uint32_t kTimerCompare0 = 1U << 16;
inline constexpr std::uint32_t kTimerCompare0Clears = 1U << 0;
inline constexpr std::uint32_t kTimer16Bits = 0;
inline constexpr std::uint32_t kTimer32Bits = 3;

struct FlashRegisters {
    Register READY;  // 400h
    Register reserved_404[64];
    Register CONFIG;     // 504h
    Register ERASEPAGE;  // 508h
};
inline constexpr std::uint32_t kFlashReads = 0;
inline constexpr std::uint32_t kFlashWrites = 1;
inline constexpr std::uint32_t kFlashErases = 2;

struct WatchdogRegisters {
    Register TASKS_START;  // 000h
    Register reserved_004[320];
    Register CRV;   // 504h
    Register RREN;  // 508h
    Register CONFIG;
    Register reserved_510[60];
    Register RR[8];  // 600h
};
inline constexpr std::uint32_t kWatchdogRunsInSleep = 1U << 0;  // and stops while a debugger halts the core
inline constexpr std::uint32_t kWatchdogReload = 0x6E52'4635U;
inline constexpr std::uint32_t kWatchdogHertz = 32'768;

template <class Block>
Block& block(std::uint32_t address) {
    return *reinterpret_cast<Block*>(address);
}
inline PowerClockRegisters& power_clock() {
    return block<PowerClockRegisters>(0x4000'0000U);
}
inline UartRegisters& uart() {
    return block<UartRegisters>(0x4000'2000U);
}
inline TimerRegisters& timer0() {
    return block<TimerRegisters>(0x4000'8000U);
}
inline TimerRegisters& timer1() {
    return block<TimerRegisters>(0x4000'9000U);
}
inline WatchdogRegisters& watchdog() {
    return block<WatchdogRegisters>(0x4001'0000U);
}
inline FlashRegisters& flash_controller() {
    return block<FlashRegisters>(0x4001'E400U);
}
inline GpioRegisters& gpio() {
    return block<GpioRegisters>(0x5000'0504U);
}

static_assert(sizeof(PowerClockRegisters) == 0x404 && sizeof(UartRegisters) == 0x570 &&
              sizeof(GpioRegisters) == 0x780 - 0x504 && sizeof(TimerRegisters) == 0x550);
static_assert(sizeof(FlashRegisters) == 0x50C - 0x400 && sizeof(WatchdogRegisters) == 0x620);

}  // namespace nplc::hal_mcu::nrf51
