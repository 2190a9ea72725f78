#pragma once

#include <cstdint>

#include "hal_mcu/cortex_m/start.h"
#include "update/boot.h"

/// What starts first on a board whose firmware can be renewed, and what its firmware knows of that.
namespace nplc::bare_metal {

/// A loader's; all of it begun, the outputs at their safe values.
struct LoaderParts {
    update::Loader choice;
    /// Whose handlers serve exceptions from now on: a vector table's address.
    void (*use_vectors)(std::uint32_t vectors);
    /// The chip's, for an image on trial that may hang before it has begun its own.
    void (*begin_watchdog)();
};

/// Starts the image of a slot; sleeps if there is none.
[[noreturn]] void load(const LoaderParts& parts);

/// A vector table of the core whose exceptions all lead to `handler`.
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

/// The firmware's: the slot that it runs from. Its linker script names link_image_begin.
unsigned running_slot(const update::Layout& slots);

}  // namespace nplc::bare_metal
