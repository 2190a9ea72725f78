#pragma once

#include <array>
#include <cstdint>

#include "hal_mcu/stellaris/flash.h"
#include "update/layout.h"

/// With NPLC_UPDATE: the flash layout, and the constants shared by loader and firmware.
namespace nplc::board {

// The loader at 0, then two slots up to the end. The linker scripts have the same figures.
inline constexpr std::uint32_t kBoardId = 2;
inline constexpr std::uint32_t kSlotsBegin = 12 * 1024;
inline constexpr std::uint32_t kSlotBytes = 122 * 1024;
inline constexpr std::uint32_t kPage = hal_mcu::stellaris::Flash::kPage;
inline constexpr update::Layout kSlots(
    {.size = 2 * kSlotBytes, .erase_block = kPage, .program_page = kPage, .program_unit = 4}, 0, kSlotBytes,
    kSlotsBegin);
static_assert(kSlotsBegin + 2 * kSlotBytes == 256 * 1024);
static_assert(kSlots.address(0) % 256 == 0 && kSlots.address(1) % 256 == 0, "vector tables begin there");

inline constexpr std::array<std::uint8_t, 4> kOutputs{0, 1, 5, 6};  ///< of port B

}  // namespace nplc::board
