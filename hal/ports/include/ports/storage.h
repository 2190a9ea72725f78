#pragma once

#include <cstdint>
#include <span>

#include "base/result.h"

namespace nplc::ports {

/// Sizes in bytes. Each divides the next: program_unit, program_page, erase_block, size.
struct StorageGeometry {
    std::uint32_t size = 0;
    std::uint32_t erase_block = 0;   ///< size of an erase, which sets FFh
    std::uint32_t program_page = 0;  ///< one program operation stays within such a page
    std::uint32_t program_unit = 0;  ///< smallest programmable size; may be programmed once only

    // For other ranges Storage returns bad_geometry.
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
    failed,  ///< the last operation failed; a new one may be started
};

/// Non-volatile memory: NOR flash in or beside the chip, or an EEPROM. Programming only turns ones into
/// zeros, and a unit is programmed once between two erases of its block (flash with error correction allows
/// no more). An EEPROM has erase_block = program_page = its page, program_unit 1, and its driver erases by
/// writing FFh.
///
/// `program` and `erase` only start the operation: until state() is no longer `busy` no other one can be
/// started, and nothing can be read. After a power failure meanwhile the bytes concerned, and no others, are
/// undefined. Errors: busy; bad_geometry (outside, not aligned, across a page boundary).
class Storage {
  public:
    virtual StorageGeometry geometry() const = 0;

    /// Copies at once. A serial memory takes the bus for the time of the transfer, so time-critical callers
    /// read kReadAtOnce bytes at a time.
    virtual base::Status read(std::uint32_t address, std::span<std::uint8_t> out) = 0;
    static constexpr std::size_t kReadAtOnce = 64;

    /// Address and length are multiples of program_unit. The bytes must stay valid until the operation ends.
    virtual base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) = 0;

    /// `address`: the first byte of the block.
    virtual base::Status erase(std::uint32_t address) = 0;

    virtual StorageState state() = 0;

  protected:
    ~Storage() = default;
};

}  // namespace nplc::ports
