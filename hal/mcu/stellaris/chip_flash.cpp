#include "hal_mcu/stellaris/flash.h"
#include "hal_mcu/stellaris/system_clock.h"
#include "registers.h"

namespace nplc::hal_mcu::stellaris {
namespace {

constexpr std::uint32_t kController = 0x400F'D000U;

class ChipFlash final : public FlashAccess {
  public:
    std::uint32_t get(std::uint32_t offset) override { return block<Register>(kController + offset); }
    void set(std::uint32_t offset, std::uint32_t value) override {
        block<Register>(kController + offset) = value;
    }
    std::uint8_t byte(std::uint32_t address) override { return block<const volatile std::uint8_t>(address); }
};

ChipFlash own_flash;

}  // namespace

FlashAccess& chip_flash() {
    return own_flash;
}

void begin_flash() {
    system_control().USECRL = kHertz / 1'000'000 - 1;
}

}  // namespace nplc::hal_mcu::stellaris
