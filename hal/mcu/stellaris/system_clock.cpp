#include "hal_mcu/stellaris/system_clock.h"

#include "registers.h"

namespace nplc::hal_mcu::stellaris {
namespace {

constexpr std::uint32_t kWatchdog = 1U << 3;
constexpr std::uint32_t kUart0To2AndI2c0 = 7U << 0 | 1U << 12;
constexpr std::uint32_t kPortsAToG = 0x7F;
constexpr int kLongestLock = 100'000;  // turns; the data sheet says 0.5 ms

void use_pll(std::uint32_t& rcc) {
    auto& control = system_control();
    rcc = (rcc & ~(kRccMainOscillatorOff | kRccSource | kRccCrystal | kRccPllOff)) | kRccCrystal8MHz;
    control.RCC = rcc;
    rcc = (rcc & ~kRccDivider) | kRccDivideBy4 | kRccUseDivider;
    control.RCC = rcc;
}

}  // namespace

bool begin_clock() {
    auto& control = system_control();
    control.RCGC0 = kWatchdog;
    control.RCGC1 = kUart0To2AndI2c0;
    control.RCGC2 = kPortsAToG;
    std::uint32_t rcc = (control.RCC | kRccBypass) & ~kRccUseDivider;
    control.RCC = rcc;
    use_pll(rcc);
    int turns = 0;
    while ((control.RIS & kRisPllLocked) == 0) {
        if (++turns == kLongestLock) return false;
    }
    control.RCC = rcc & ~kRccBypass;
    return true;
}

bool was_reset_from_outside() {
    return (system_control().RESC & kRescFromOutside) != 0;
}

bool take_watchdog_reset() {
    const bool was_watchdog = (system_control().RESC & kRescWatchdog) != 0;
    system_control().RESC = 0;
    return was_watchdog;
}

}  // namespace nplc::hal_mcu::stellaris
