#pragma once

#include <cstdint>

/// Registers of the Stellaris LM3S6965, named as in its data sheet; only those in use.
namespace nplc::hal_mcu::stellaris {

using Register = volatile std::uint32_t;

struct SystemControl {
    Register reserved_000[20];
    Register RIS;  // 050h
    Register reserved_054[2];
    Register RESC;  // 05Ch
    Register RCC;   // 060h
    Register reserved_064[39];
    Register RCGC0;  // 100h
    Register RCGC1;  // 104h
    Register RCGC2;  // 108h
    Register reserved_10C[13];
    Register USECRL;  // 140h
};
inline constexpr std::uint32_t kRisPllLocked = 1U << 6;
inline constexpr std::uint32_t kRescWatchdog = 1U << 3;
inline constexpr std::uint32_t kRescFromOutside = 7U << 0;  ///< reset pin, power-on, brown-out
inline constexpr std::uint32_t kRccMainOscillatorOff = 1U << 0;
inline constexpr std::uint32_t kRccSource = 3U << 4;
inline constexpr std::uint32_t kRccCrystal = 0xFU << 6;
inline constexpr std::uint32_t kRccCrystal8MHz = 0xEU << 6;
inline constexpr std::uint32_t kRccBypass = 1U << 11;
inline constexpr std::uint32_t kRccPllOff = 1U << 13;
inline constexpr std::uint32_t kRccUseDivider = 1U << 22;
inline constexpr std::uint32_t kRccDivider = 0xFU << 23;
inline constexpr std::uint32_t kRccDivideBy4 = 3U << 23;

struct UartRegisters {
    Register DR;  // 000h
    Register RSR;
    Register reserved_008[4];
    Register FR;  // 018h
    Register reserved_01C[2];
    Register IBRD;  // 024h
    Register FBRD;
    Register LCRH;
    Register CTL;
    Register IFLS;
    Register IM;
    Register RIS;
    Register MIS;
    Register ICR;
};
inline constexpr std::uint32_t kDrFraming = 1U << 8;
inline constexpr std::uint32_t kDrBreak = 1U << 10;
inline constexpr std::uint32_t kDrOverrun = 1U << 11;
inline constexpr std::uint32_t kFrBusy = 1U << 3;
inline constexpr std::uint32_t kFrReceiverEmpty = 1U << 4;
inline constexpr std::uint32_t kFrTransmitterFull = 1U << 5;
inline constexpr std::uint32_t kLcrhFifo = 1U << 4;
inline constexpr std::uint32_t kLcrh8Bits = 3U << 5;
inline constexpr std::uint32_t kCtlEnable = 1U << 0 | 1U << 8 | 1U << 9;
inline constexpr std::uint32_t kImReceive = 1U << 4;
inline constexpr std::uint32_t kImTransmit = 1U << 5;
inline constexpr std::uint32_t kImReceiveTimeout = 1U << 6;
inline constexpr std::uint32_t kImOverrun = 1U << 10;

struct GpioRegisters {
    Register DATA[256];  // the index is the mask of the pins concerned
    Register DIR;        // 400h
    Register reserved_404[7];
    Register AFSEL;  // 420h
    Register reserved_424[58];
    Register ODR;  // 50Ch
    Register PUR;
    Register PDR;
    Register SLR;
    Register DEN;
};

struct I2cRegisters {
    Register MSA;
    Register MCS;
    Register MDR;
    Register MTPR;
    Register MIMR;
    Register MRIS;
    Register MMIS;
    Register MICR;
    Register MCR;
};
inline constexpr std::uint32_t kMcsRun = 1U << 0;
inline constexpr std::uint32_t kMcsStart = 1U << 1;
inline constexpr std::uint32_t kMcsStop = 1U << 2;
inline constexpr std::uint32_t kMcsAcknowledge = 1U << 3;
inline constexpr std::uint32_t kMcsError = 1U << 1;  // read
inline constexpr std::uint32_t kMcsLost = 1U << 4;   // read
inline constexpr std::uint32_t kMcrMaster = 1U << 4;

struct WatchdogRegisters {
    Register LOAD;
    Register VALUE;
    Register CTL;
    Register ICR;
    Register reserved_010[764];
    Register LOCK;  // C00h
};
inline constexpr std::uint32_t kWatchdogInterrupt = 1U << 0;
inline constexpr std::uint32_t kWatchdogResets = 1U << 1;
inline constexpr std::uint32_t kWatchdogKey = 0x1ACC'E551U;

template <class Block>
Block& block(std::uint32_t address) {
    return *reinterpret_cast<Block*>(address);
}
inline SystemControl& system_control() {
    return block<SystemControl>(0x400F'E000U);
}

static_assert(sizeof(SystemControl) == 0x144 && sizeof(UartRegisters) == 0x48 &&
              sizeof(GpioRegisters) == 0x520);
static_assert(sizeof(I2cRegisters) == 0x24 && sizeof(WatchdogRegisters) == 0xC04);

}  // namespace nplc::hal_mcu::stellaris
