#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/bytes.h"

/// The set-points of a table: values that an operator may change while the machine is in use, with their
/// ranges. Their record follows the end term of the uploaded table, before the certificate; the table itself
/// has their defaults. firmware/gateway/SET_POINTS.md describes the bytes.
namespace nplc::registers::set_points {

inline constexpr std::array<std::uint8_t, 8> kMark{'N', 'P', 'L', 'S', 'E', 'T', 'P', 'T'};
inline constexpr std::uint8_t kVersion = 1;
inline constexpr std::size_t kMost = 16;               ///< per table
inline constexpr std::size_t kMostRecordBytes = 1024;  ///< including the mark
inline constexpr std::size_t kHeaderBytes = 20;
inline constexpr std::size_t kEntryBytes = 36;  ///< without places and texts

/// The target of the value.
enum class ValueKind : std::uint8_t { motor_register = 0, timer = 1, counter = 2 };

/// Unit of a value's steps: a registers::Unit for a motor's register, else one of these.
inline constexpr std::uint8_t kMilliseconds = 0x80;
inline constexpr std::uint8_t kCount = 0x81;

enum Flag : std::uint8_t {
    kAtPowerUp = 1,  ///< POWER_UP writes it; written to the motor at a step that takes set-points
    kLongword = 2,
    kGrid = 4,  ///< behind the texts: the lower end as written, from which tools lay the steps
};

/// One set-point in a record. Numbers are signed, in the raw steps of their target.
class Entry {
  public:
    explicit Entry(const std::uint8_t* bytes) : bytes_(bytes) {}

    std::uint8_t kind_number() const { return bytes_[0]; }
    ValueKind kind() const { return static_cast<ValueKind>(bytes_[0]); }
    std::uint8_t reg() const { return bytes_[1]; }
    bool is(Flag flag) const { return (bytes_[2] & flag) != 0; }
    std::uint8_t unit() const { return bytes_[3]; }
    std::int32_t initial() const { return number(4); }
    std::int32_t lowest() const { return number(8); }
    std::int32_t highest() const { return number(12); }
    std::uint32_t name_hash() const {
        return base::load_u32(bytes_ + 16);
    }  ///< CRC-32 of the name in capitals
    std::size_t places() const { return bytes_[32]; }
    /// Number of a term with the value.
    std::uint16_t place(std::size_t index) const { return base::load_u16(bytes_ + kEntryBytes + 2 * index); }
    std::size_t name_bytes() const { return bytes_[33]; }
    std::size_t unit_bytes() const { return bytes_[34]; }
    const std::uint8_t* bytes() const { return bytes_; }
    std::size_t size() const { return std::size_t{4} * bytes_[35]; }

    bool allows(std::int32_t value) const { return value >= lowest() && value <= highest(); }

  private:
    std::int32_t number(std::size_t at) const {
        return static_cast<std::int32_t>(base::load_u32(bytes_ + at));
    }
    const std::uint8_t* bytes_;
};

/// Writes a value into the bytes of its term.
void patch(std::uint8_t* term, const Entry& entry, std::int32_t value);

/// A record that is_sound(), or an empty one.
class Record {
  public:
    Record() = default;
    explicit Record(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::size_t count() const { return bytes_.empty() ? 0 : bytes_[11]; }
    Entry entry(std::size_t index) const;
    /// Changed values may take effect when `step` is active.
    bool takes_at(std::uint8_t step) const {
        return !bytes_.empty() && (std::uint32_t{bytes_[12 + step / 8U]} >> (step % 8U) & 1U) != 0;
    }
    std::span<const std::uint8_t> bytes() const { return bytes_; }

  private:
    std::span<const std::uint8_t> bytes_;
};

/// Length of the record that begins here; 0: none.
std::size_t record_bytes(std::span<const std::uint8_t> behind_end_term);

/// Complete, within the limits, and each place in `table` (whole terms) has the default that the record
/// gives.
bool is_sound(std::span<const std::uint8_t> record, std::span<const std::uint8_t> table);

}  // namespace nplc::registers::set_points
