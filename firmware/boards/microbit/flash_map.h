#pragma once

#include <array>
#include <cstdint>

#include "hal_mcu/nrf51/flash.h"
#include "update/layout.h"

/// The flash layout, and the constants shared by loader and firmware.
namespace nplc::board {

/// The last 20 pages: two tables of nine, two sets of settings of one.
inline constexpr std::uint32_t kStorageBegin = 236 * 1024;
inline constexpr std::uint32_t kStoragePages = 20;

// With NPLC_UPDATE: the loader at 0, then two slots. The linker scripts have the same figures.
inline constexpr std::uint32_t kBoardId = 1;
inline constexpr std::uint32_t kSlotsBegin = 12 * 1024;
inline constexpr std::uint32_t kSlotBytes = 112 * 1024;
inline constexpr std::uint32_t kPage = hal_mcu::nrf51::Flash::kPage;
inline constexpr update::Layout kSlots(
    {.size = 2 * kSlotBytes, .erase_block = kPage, .program_page = kPage, .program_unit = 4}, 0, kSlotBytes,
    kSlotsBegin);
static_assert(kSlotsBegin + 2 * kSlotBytes == kStorageBegin);

inline constexpr std::array<std::uint8_t, 4> kOutputs{4, 5, 12,
                                                      11};  ///< of the chip; edge connector 3, 4, 6, 7

}  // namespace nplc::board
