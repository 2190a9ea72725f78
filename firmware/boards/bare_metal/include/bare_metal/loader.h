#pragma once

#include <cstdint>

#include "hal_mcu/cortex_m/start.h"
#include "update/boot.h"

/// The boot loader of a board with firmware update, and what its firmware shares with it.
namespace nplc::bare_metal {

/// Parts of a loader; all are initialized, and the outputs are at their safe values.
struct LoaderParts {
    update::Loader choice;
    /// Activates a vector table by its address.
    void (*use_vectors)(std::uint32_t vectors);
    /// Starts the chip's watchdog, for an image on trial that may hang before it has started its own.
    void (*begin_watchdog)();
};

/// Starts the image of a slot; sleeps if there is none.
[[noreturn]] void load(const LoaderParts& parts);

/// A core vector table whose exceptions all go to `handler`.
constexpr hal_mcu::cortex_m::VectorsOfCore vectors_to(std::uint32_t* stack,
                                                      hal_mcu::cortex_m::Handler handler) {
    return {.stack = stack,
            .reset = hal_mcu::cortex_m::nplc_reset,
            .nmi = handler,
            .hard_fault = handler,
            .memory_fault = handler,
            .bus_fault = handler,
            .usage_fault = handler,
            .reserved_to_10 = {handler, handler, handler, handler},
            .svcall = handler,
            .debug = handler,
            .reserved_13 = handler,
            .pendsv = handler,
            .systick = handler};
}

/// For the firmware: the slot that it runs from. Its linker script defines link_image_begin.
unsigned running_slot(const update::Layout& slots);

}  // namespace nplc::bare_metal
