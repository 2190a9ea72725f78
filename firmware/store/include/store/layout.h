#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/result.h"
#include "ports/storage.h"

/// Layout of a slot in the storage: header, mark and content, each aligned to a program unit; the last unit
/// has a byte that is no longer FFh once another slot has replaced this one.
namespace nplc::store {

enum class Kind : std::uint8_t { table = 1, settings = 2, set_points = 3 };

/// Two adjacent slots.
struct Area {
    std::uint32_t begin = 0;       ///< an erase block's first byte
    std::uint32_t slot_bytes = 0;  ///< a multiple of erase_block
};

struct Header {
    Kind kind{};
    std::uint32_t sequence = 0;  ///< the later writing has the higher one, modulo 2^32
    std::uint32_t length = 0;    ///< bytes of content
    std::uint32_t crc = 0;       ///< of the content, base/crc32.h
    bool operator==(const Header&) const = default;
};

inline constexpr std::size_t kHeaderBytes = 24;
inline constexpr std::size_t kMarkBytes = 8;
inline constexpr std::uint32_t kLargestUnit = 256;

std::array<std::uint8_t, kHeaderBytes> encode(const Header& header);
/// The mark makes a slot valid and is programmed last. It repeats the header's check sum.
std::array<std::uint8_t, kMarkBytes> mark_for(std::span<const std::uint8_t, kHeaderBytes> header);
/// Error: damaged.
base::Result<Header> decode(std::span<const std::uint8_t, kHeaderBytes> bytes);

/// True if `sequence` is newer than `other`.
constexpr bool is_later(std::uint32_t sequence, std::uint32_t other) {
    return static_cast<std::int32_t>(sequence - other) > 0;
}

/// Addresses within one area on one storage. Needs is_possible().
class Layout {
  public:
    Layout(const ports::StorageGeometry& geometry, const Area& area) : geometry_(geometry), area_(area) {}

    bool is_possible() const;
    std::uint32_t header(unsigned slot) const { return area_.begin + slot * area_.slot_bytes; }
    std::uint32_t mark(unsigned slot) const { return header(slot) + whole_units(kHeaderBytes); }
    std::uint32_t content(unsigned slot) const { return mark(slot) + whole_units(kMarkBytes); }
    std::uint32_t superseded(unsigned slot) const { return end(slot) - geometry_.program_unit; }
    std::uint32_t end(unsigned slot) const { return header(slot) + area_.slot_bytes; }
    std::uint32_t capacity() const { return superseded(0) - content(0); }
    std::uint32_t slot_bytes() const { return area_.slot_bytes; }

    std::uint32_t whole_units(std::size_t bytes) const;
    /// Number of bytes from `address` on that one program operation can write.
    std::uint32_t one_programming(std::uint32_t address, std::uint32_t bytes) const;
    std::uint32_t erase_block() const { return geometry_.erase_block; }

  private:
    ports::StorageGeometry geometry_;
    Area area_;
};

}  // namespace nplc::store
