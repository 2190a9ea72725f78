#include "registers/set_points.h"

#include <algorithm>

namespace nplc::registers::set_points {
namespace {

constexpr std::size_t kTermBytes = 8;
constexpr std::uint8_t kFlexFormat = 0x80;   // CARE's bit 7 (001 §6.1.5)
constexpr std::uint8_t kLongwordBit = 0x80;  // of a register's number (001 §6.1.8)
constexpr std::uint8_t kCounterBit = 0x40;   // CNT_TIME (001 §6.1.7)
constexpr std::int32_t kLongestPreset = 0xFFFF;

bool is_term_of(const std::uint8_t* term, const Entry& entry) {
    const bool flex = (term[2] & kFlexFormat) != 0;
    if (entry.kind() == ValueKind::motor_register)
        return flex && term[3] == (entry.reg() | (entry.is(kLongword) ? kLongwordBit : 0));
    return !flex && ((term[3] & kCounterBit) != 0) == (entry.kind() == ValueKind::counter);
}

bool has_default(const std::uint8_t* term, const Entry& entry) {
    std::array<std::uint8_t, kTermBytes> same;
    std::copy_n(term, same.size(), same.begin());
    patch(same.data(), entry, entry.initial());
    return std::equal(same.begin(), same.end(), term);
}

bool is_sound(const Entry& entry, std::span<const std::uint8_t> table) {
    if (entry.kind_number() > static_cast<std::uint8_t>(ValueKind::counter)) return false;
    if (!entry.allows(entry.initial()) || entry.places() == 0) return false;
    const bool preset = entry.kind() != ValueKind::motor_register;
    if (preset && (entry.lowest() < 1 || entry.highest() > kLongestPreset)) return false;
    for (std::size_t i = 0; i < entry.places(); ++i) {
        const std::size_t at = entry.place(i) * kTermBytes;
        if (at + kTermBytes > table.size()) return false;
        if (!is_term_of(&table[at], entry) || !has_default(&table[at], entry)) return false;
    }
    return true;
}

}  // namespace

void patch(std::uint8_t* term, const Entry& entry, std::int32_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    if (entry.kind() != ValueKind::motor_register)
        return base::store_u16(term + 6, static_cast<std::uint16_t>(bits));
    base::store_u16(term + 4, static_cast<std::uint16_t>(bits));
    if (entry.is(kLongword)) base::store_u16(term + 6, static_cast<std::uint16_t>(bits >> 16));
}

Entry Record::entry(std::size_t index) const {
    const std::uint8_t* at = bytes_.data() + kHeaderBytes;
    for (; index > 0; --index) at += Entry(at).size();
    return Entry(at);
}

std::size_t record_bytes(std::span<const std::uint8_t> behind_end_term) {
    if (behind_end_term.size() < kHeaderBytes ||
        !std::equal(kMark.begin(), kMark.end(), behind_end_term.begin()))
        return 0;
    return base::load_u16(&behind_end_term[8]);
}

bool is_sound(std::span<const std::uint8_t> record, std::span<const std::uint8_t> table) {
    if (record_bytes(record) != record.size() || record.size() > kMostRecordBytes || record[10] != kVersion)
        return false;
    const std::size_t count = record[11];
    if (count == 0 || count > kMost) return false;
    std::size_t at = kHeaderBytes;
    for (std::size_t i = 0; i < count; ++i) {
        if (record.size() - at < kEntryBytes) return false;
        const Entry entry(&record[at]);
        const std::size_t least = kEntryBytes + 2 * entry.places() + entry.name_bytes() + entry.unit_bytes();
        if (entry.size() < least || entry.size() > record.size() - at || !is_sound(entry, table))
            return false;
        at += entry.size();
    }
    return at == record.size();
}

}  // namespace nplc::registers::set_points
