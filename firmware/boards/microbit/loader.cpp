// The boot loader of a micro:bit with firmware update: checks the image of a slot and starts it.

#include "bare_metal/loader.h"
#include "bare_metal/fault_reset.h"
#include "flash_map.h"
#include "hal_mcu/cortex_m/core.h"
#include "hal_mcu/cortex_m/image_start.h"
#include "hal_mcu/cortex_m/start.h"
#include "hal_mcu/nrf51/pins.h"
#include "hal_mcu/nrf51/watchdog.h"
#include "public_key.h"

namespace nplc::board {
namespace {

namespace core = hal_mcu::cortex_m;
namespace chip = hal_mcu::nrf51;

extern "C" std::uint32_t link_stack_top;

constexpr unsigned kInterrupts = 32;

struct Vectors {
    core::VectorsOfCore core;
    core::Handler chip[kInterrupts];
};

constexpr Vectors make() {
    Vectors vectors{.core = bare_metal::vectors_to(&link_stack_top, core::nplc_forward), .chip = {}};
    for (core::Handler& handler : vectors.chip) handler = core::nplc_forward;
    return vectors;
}

[[gnu::section(".vectors"), gnu::used]] constinit const Vectors vectors = make();

/// Vector table until an image runs.
constinit const core::VectorsOfCore own_faults = bare_metal::vectors_to(&link_stack_top, core::nplc_fault);

chip::OutputPins outputs(kOutputs);
chip::Flash flash(kSlotsBegin, 2 * kSlotBytes);

}  // namespace
}  // namespace nplc::board

void run_firmware() {
    using namespace nplc::board;
    core::forward_to(reinterpret_cast<std::uint32_t>(&own_faults));
    outputs.begin(nplc::bare_metal::safe_outputs());
    nplc::bare_metal::load({.choice = {.storage = flash,
                                       .layout = kSlots,
                                       .board = kBoardId,
                                       .key = kPublicKey,
                                       .meanwhile = chip::Watchdog::feed_chip},
                            .use_vectors = core::forward_to,
                            .begin_watchdog = chip::Watchdog::begin_chip});
}

void end_firmware(std::uint32_t, std::uint32_t) {
    nplc::hal_mcu::cortex_m::reset();
}
