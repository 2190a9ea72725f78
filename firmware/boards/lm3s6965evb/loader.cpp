// The boot loader of a board with firmware update: checks the image of a slot and starts it.

#include "bare_metal/loader.h"
#include "bare_metal/fault_reset.h"
#include "flash_map.h"
#include "hal_mcu/cortex_m/core.h"
#include "hal_mcu/cortex_m/image_start.h"
#include "hal_mcu/cortex_m/start.h"
#include "hal_mcu/stellaris/pins.h"
#include "hal_mcu/stellaris/system_clock.h"
#include "hal_mcu/stellaris/watchdog.h"
#include "public_key.h"

namespace nplc::board {
namespace {

namespace core = hal_mcu::cortex_m;
namespace chip = hal_mcu::stellaris;

extern "C" std::uint32_t link_stack_top;

/// No interrupt is enabled before an image runs.
[[gnu::section(".vectors"), gnu::used]] constinit const core::VectorsOfCore vectors =
    bare_metal::vectors_to(&link_stack_top, core::nplc_fault);

/// Watchdog timeout until the image on trial sets its own, after it has initialized the chip.
constexpr base::Milliseconds kTrialStart{3'000};

chip::OutputPins outputs(chip::kPortB, kOutputs);
chip::Flash flash(chip::chip_flash(), kSlotsBegin, 2 * kSlotBytes);

void begin_watchdog() {
    static chip::Watchdog watchdog;
    watchdog.feed();  // restarts the timeout
    watchdog.begin(kTrialStart);
}

}  // namespace
}  // namespace nplc::board

void run_firmware() {
    using namespace nplc::board;
    const bool has_clock = chip::begin_clock();
    outputs.begin(nplc::bare_metal::safe_outputs());
    if (!has_clock) core::reset();
    chip::begin_flash();
    nplc::bare_metal::load(
        {.choice =
             {.storage = flash, .layout = kSlots, .board = kBoardId, .key = kPublicKey, .meanwhile = [] {}},
         .use_vectors = core::use_vectors,
         .begin_watchdog = begin_watchdog});
}

void end_firmware(std::uint32_t, std::uint32_t) {
    nplc::hal_mcu::cortex_m::reset();
}
