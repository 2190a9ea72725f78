#pragma once

#include <cstdint>

/// Start of an image with its own vector table, for a loader.
namespace nplc::hal_mcu::cortex_m {

/// Selects the vector table, on a core with VTOR (from the M3 on; a multiple of 256 bytes for up to 48
/// interrupts).
void use_vectors(std::uint32_t vectors);
/// The same on a core whose vector table is fixed at address 0 (M0), where all vectors must be
/// nplc_forward(). The linker script defines link_forward, a word of RAM reserved for this.
void forward_to(std::uint32_t vectors);
/// Starts the image as a reset would; its vector table must be in use already.
[[noreturn]] void start_image(std::uint32_t vectors);

extern "C" {
/// Handler for every exception but reset: calls the image's handler. Takes 12 instructions.
void nplc_forward();
}

}  // namespace nplc::hal_mcu::cortex_m
