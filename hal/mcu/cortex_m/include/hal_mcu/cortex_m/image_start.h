#pragma once

#include <cstdint>

/// How a loader starts an image that has a vector table of its own.
namespace nplc::hal_mcu::cortex_m {

/// Whose handlers serve exceptions from now on, on a core that can be told (VTOR: from the M3 on; a multiple
/// of 256 bytes for up to 48 interrupts).
void use_vectors(std::uint32_t vectors);
/// The same on a core whose vector table is always the one at address 0 (M0), where all must lead to
/// nplc_forward(). The linker script names link_forward, a word of RAM that nobody else uses.
void forward_to(std::uint32_t vectors);
/// As a reset with this vector table would, which is in use already.
[[noreturn]] void start_image(std::uint32_t vectors);

extern "C" {
/// For every exception but reset: the same one of the image. 12 instructions' time.
void nplc_forward();
}

}  // namespace nplc::hal_mcu::cortex_m
