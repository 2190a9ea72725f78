#pragma once

#include <cstdint>

/// Registers of every Cortex-M, named as in Arm's architecture; only those in use.
namespace nplc::hal_mcu::cortex_m {

using Register = volatile std::uint32_t;

struct SysTick {
    Register CSR;
    Register RVR;
    Register CVR;
};
inline constexpr std::uint32_t kCsrEnable = 1U << 0;
inline constexpr std::uint32_t kCsrInterrupt = 1U << 1;
inline constexpr std::uint32_t kCsrOfCore = 1U << 2;

struct SystemControl {
    Register CPUID;
    Register ICSR;
    Register VTOR;
    Register AIRCR;
    Register SCR;
    Register CCR;
};
inline constexpr std::uint32_t kAircrKey = 0x05FAU << 16;
inline constexpr std::uint32_t kAircrReset = 1U << 2;

inline SysTick& systick() {
    return *reinterpret_cast<SysTick*>(0xE000'E010U);
}
inline Register* interrupt_enable() {
    return reinterpret_cast<Register*>(0xE000'E100U);
}
inline Register* interrupt_pending() {
    return reinterpret_cast<Register*>(0xE000'E200U);
}
inline SystemControl& system_control() {
    return *reinterpret_cast<SystemControl*>(0xE000'ED00U);
}

}  // namespace nplc::hal_mcu::cortex_m
