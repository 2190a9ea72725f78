#include "set_points/record.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "base/bytes.h"
#include "base/crc32.h"

namespace nplc::set_points {

namespace layout = registers::set_points;

namespace {

constexpr std::size_t kGridBytes = sizeof(double);

std::string in_capitals(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

void store_u64(std::uint8_t* at, std::uint64_t value) {
    base::store_u32(at, static_cast<std::uint32_t>(value));
    base::store_u32(at + 4, static_cast<std::uint32_t>(value >> 32));
}

std::uint64_t load_u64(const std::uint8_t* at) {
    return base::load_u32(at) | std::uint64_t{base::load_u32(at + 4)} << 32;
}

void append(std::vector<std::uint8_t>& bytes, const SetPoint& point) {
    std::vector<std::uint8_t> entry(layout::kEntryBytes);
    entry[0] = static_cast<std::uint8_t>(point.kind);
    entry[1] = point.reg;
    entry[2] = static_cast<std::uint8_t>((point.at_power_up ? layout::kAtPowerUp : 0) |
                                         (point.longword ? layout::kLongword : 0) |
                                         (point.grid_from ? layout::kGrid : 0));
    entry[3] = point.unit_code;
    base::store_u32(&entry[4], static_cast<std::uint32_t>(point.initial));
    base::store_u32(&entry[8], static_cast<std::uint32_t>(point.lowest));
    base::store_u32(&entry[12], static_cast<std::uint32_t>(point.highest));
    base::store_u32(&entry[16], hash_of(point.name));
    store_u64(&entry[20], std::bit_cast<std::uint64_t>(point.steps_per_unit));
    base::store_u32(&entry[28], std::bit_cast<std::uint32_t>(static_cast<float>(point.step)));
    entry[32] = static_cast<std::uint8_t>(point.places.size());
    entry[33] = static_cast<std::uint8_t>(point.name.size());
    entry[34] = static_cast<std::uint8_t>(point.unit.size());
    for (const std::uint16_t place : point.places) {
        entry.resize(entry.size() + 2);
        base::store_u16(&entry[entry.size() - 2], place);
    }
    entry.insert(entry.end(), point.name.begin(), point.name.end());
    entry.insert(entry.end(), point.unit.begin(), point.unit.end());
    if (point.grid_from) {
        entry.resize(entry.size() + kGridBytes);
        store_u64(&entry[entry.size() - kGridBytes], std::bit_cast<std::uint64_t>(*point.grid_from));
    }
    entry.resize((entry.size() + 3) / 4 * 4);
    entry[35] = static_cast<std::uint8_t>(entry.size() / 4);
    bytes.insert(bytes.end(), entry.begin(), entry.end());
}

/// The decimal number as written: 0.1, not the double nearest to the record's single.
double written(float step) {
    return std::strtod(fmt::format("{}", step).c_str(), nullptr);
}

SetPoint point_of(const layout::Entry& entry) {
    SetPoint point;
    point.kind = entry.kind();
    point.reg = entry.reg();
    point.longword = entry.is(layout::kLongword);
    point.at_power_up = entry.is(layout::kAtPowerUp);
    point.unit_code = entry.unit();
    point.initial = entry.initial();
    point.lowest = entry.lowest();
    point.highest = entry.highest();
    point.steps_per_unit = std::bit_cast<double>(load_u64(entry.bytes() + 20));
    point.step = written(std::bit_cast<float>(base::load_u32(entry.bytes() + 28)));
    for (std::size_t i = 0; i < entry.places(); ++i) point.places.push_back(entry.place(i));
    const std::uint8_t* text = entry.bytes() + layout::kEntryBytes + 2 * entry.places();
    point.name.assign(text, text + entry.name_bytes());
    text += entry.name_bytes();
    point.unit.assign(text, text + entry.unit_bytes());
    text += entry.unit_bytes();
    const std::uint8_t* end = entry.bytes() + entry.size();
    if (entry.is(layout::kGrid) && end - text >= static_cast<std::ptrdiff_t>(kGridBytes)) {
        const double from = std::bit_cast<double>(load_u64(text));
        if (std::isfinite(from)) point.grid_from = from;
    }
    return point;
}

Record record_of(std::span<const std::uint8_t> bytes) {
    const layout::Record read(bytes);
    Record record;
    record.takes = load_u64(&bytes[12]);
    for (std::size_t i = 0; i < read.count(); ++i) record.values.push_back(point_of(read.entry(i)));
    return record;
}

}  // namespace

std::uint32_t hash_of(std::string_view name) {
    const std::string capitals = in_capitals(name);
    return base::crc32(std::span(reinterpret_cast<const std::uint8_t*>(capitals.data()), capitals.size()));
}

std::vector<std::uint8_t> encode(const Record& record) {
    if (record.values.empty()) return {};
    std::vector<std::uint8_t> bytes(layout::kHeaderBytes);
    std::copy(layout::kMark.begin(), layout::kMark.end(), bytes.begin());
    bytes[10] = layout::kVersion;
    bytes[11] = static_cast<std::uint8_t>(record.values.size());
    store_u64(&bytes[12], record.takes);
    for (const SetPoint& point : record.values) append(bytes, point);
    base::store_u16(&bytes[8], static_cast<std::uint16_t>(bytes.size()));
    return bytes;
}

std::optional<Record> decode(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> table) {
    if (!layout::is_sound(bytes, table)) return std::nullopt;
    return record_of(bytes);
}

std::optional<Record> decode(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < layout::kHeaderBytes || layout::record_bytes(bytes) != bytes.size())
        return std::nullopt;
    std::size_t at = layout::kHeaderBytes;
    for (std::size_t i = 0; i < bytes[11]; ++i) {
        if (bytes.size() - at < layout::kEntryBytes) return std::nullopt;
        const layout::Entry entry(&bytes[at]);
        const std::size_t least =
            layout::kEntryBytes + 2 * entry.places() + entry.name_bytes() + entry.unit_bytes();
        if (entry.size() < least || entry.size() > bytes.size() - at) return std::nullopt;
        at += entry.size();
    }
    if (at != bytes.size()) return std::nullopt;
    return record_of(bytes);
}

std::vector<std::uint8_t> with_record(std::span<const std::uint8_t> table, const Record& record) {
    std::vector<std::uint8_t> bytes(table.begin(), table.end());
    const std::vector<std::uint8_t> behind = encode(record);
    bytes.insert(bytes.end(), behind.begin(), behind.end());
    return bytes;
}

const SetPoint* find(const Record& record, std::string_view name) {
    const std::string wanted = in_capitals(name);
    const auto found = std::find_if(record.values.begin(), record.values.end(),
                                    [&](const SetPoint& point) { return in_capitals(point.name) == wanted; });
    return found == record.values.end() ? nullptr : &*found;
}

}  // namespace nplc::set_points
