#pragma once

#include <cstdint>
#include <span>

#include "base/result.h"

namespace nplc::ports {

/// Sizes in bytes. Each divides the next: program_unit, program_page, erase_block, size.
struct StorageGeometry {
    std::uint32_t size = 0;
    std::uint32_t erase_block = 0;   ///< what one erasure sets to FFh
    std::uint32_t program_page = 0;  ///< one programming stays inside such a page
    std::uint32_t program_unit = 0;  ///< the least that can be programmed, and programmed once only

    // What Storage answers bad_geometry to is none of these.
    constexpr bool can_read(std::uint32_t address, std::size_t bytes) const {
        return address <= size && size - address >= bytes;
    }
    constexpr bool can_program(std::uint32_t address, std::size_t bytes) const {
        const bool aligned = address % program_unit == 0 && bytes % program_unit == 0;
        return aligned && address < size && bytes <= program_page - address % program_page;
    }
    constexpr bool can_erase(std::uint32_t address) const {
        return address < size && address % erase_block == 0;
    }
};

enum class StorageState : std::uint8_t {
    ready,
    busy,
    failed,  ///< the last operation did not succeed; the next one may be begun
};

/// Memory that keeps its bytes without power: NOR flash in the chip or beside it, or an EEPROM. Programming
/// only turns ones into zeros, and a unit is programmed once between two erasures of its block (flash with
/// error correction allows no more). An EEPROM has erase_block = program_page = its page, program_unit 1, and
/// its driver erases by writing FFh.
///
/// `program` and `erase` only begin the work: until state() is no longer `busy` nothing else can be begun,
/// and nothing read. Power that fails meanwhile leaves the bytes concerned, and no others, undefined. Errors:
/// busy; bad_geometry (outside, not aligned, over a page's end).
class Storage {
  public:
    virtual StorageGeometry geometry() const = 0;

    /// Copies at once. Serial memories take the bus for the time of the transfer, so whoever must not wait
    /// reads kReadAtOnce bytes at a time.
    virtual base::Status read(std::uint32_t address, std::span<std::uint8_t> out) = 0;
    static constexpr std::size_t kReadAtOnce = 64;

    /// Address and length are multiples of program_unit. The bytes must stay until the work is done.
    virtual base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) = 0;

    /// `address`: the first byte of the block.
    virtual base::Status erase(std::uint32_t address) = 0;

    virtual StorageState state() = 0;

  protected:
    ~Storage() = default;
};

}  // namespace nplc::ports
