#pragma once

#include <cstdint>

#include "ports/storage.h"
#include "update/image.h"

namespace nplc::update {

inline constexpr unsigned kSlots = 2;
inline constexpr std::uint32_t kLargestUnit = 8;  ///< largest supported program unit of a storage

/// Two adjacent slots on a storage from which the chip also executes code.
class Layout {
  public:
    /// `begin`: of slot 0 in the storage; `chip_address`: of the storage's first byte.
    constexpr Layout(const ports::StorageGeometry& geometry, std::uint32_t begin, std::uint32_t slot_bytes,
                     std::uint32_t chip_address)
        : block_(geometry.erase_block),
          page_(geometry.program_page),
          unit_(geometry.program_unit),
          begin_(begin),
          slot_bytes_(slot_bytes),
          chip_address_(chip_address) {}

    // Addresses in the storage.
    constexpr std::uint32_t header(unsigned slot) const { return begin_ + slot * slot_bytes_; }
    constexpr std::uint32_t image(unsigned slot) const { return header(slot) + kImageAt; }
    constexpr std::uint32_t marks(unsigned slot) const { return header(slot) + slot_bytes_ - block_; }
    constexpr std::uint32_t mark(unsigned slot, unsigned number) const {
        return marks(slot) + number * unit_;
    }

    /// Link address of the slot's image.
    constexpr std::uint32_t address(unsigned slot) const { return chip_address_ + image(slot); }
    /// Maximum size of header and image together.
    constexpr std::uint32_t capacity() const { return slot_bytes_ - block_; }
    constexpr std::uint32_t block() const { return block_; }
    constexpr std::uint32_t unit() const { return unit_; }
    /// Number of bytes from `address` on that one program operation can write.
    std::uint32_t one_programming(std::uint32_t address, std::uint32_t bytes) const;

    /// The header is valid for this slot of this board.
    bool fits(const ImageHeader& header, unsigned slot, std::uint32_t board) const;

  private:
    std::uint32_t block_;
    std::uint32_t page_;
    std::uint32_t unit_;
    std::uint32_t begin_;
    std::uint32_t slot_bytes_;
    std::uint32_t chip_address_;
};

}  // namespace nplc::update
