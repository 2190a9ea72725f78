#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/crc32.h"
#include "sim/sim_storage.h"
#include "store/slots.h"
#include "store/table_check.h"

namespace nplc::store {

using Bytes = std::vector<std::uint8_t>;

struct Shape {
    const char* name;
    ports::StorageGeometry geometry;
    Area area;
};

/// Flash in a small chip, flash beside a chip, and an EEPROM with pages; and flash with error correction.
inline std::vector<Shape> shapes(std::uint32_t content_bytes) {
    const auto fit = [&](std::uint32_t erase, std::uint32_t page, std::uint32_t unit) {
        const std::uint32_t slot =
            (content_bytes + 3 * std::max<std::uint32_t>(unit, 32U) + erase - 1) / erase * erase;
        return std::pair(ports::StorageGeometry{.size = erase * (2 * slot / erase + 3),
                                                .erase_block = erase,
                                                .program_page = page,
                                                .program_unit = unit},
                         Area{.begin = erase, .slot_bytes = slot});
    };
    std::vector<Shape> result;
    const auto add = [&](const char* name, std::uint32_t erase, std::uint32_t page, std::uint32_t unit) {
        const auto [geometry, area] = fit(erase, page, unit);
        result.push_back({name, geometry, area});
    };
    add("flash 1024/4", 1024, 4, 4);
    add("flash 2048/8", 2048, 8, 8);
    add("flash 4096/256", 4096, 256, 256);
    add("flash 4096/1 in pages of 256", 4096, 256, 1);
    add("EEPROM pages of 32", 32, 32, 1);
    return result;
}

/// Valid terms, the end term included; `seed` makes tables differ in every term.
inline Bytes table_of(std::size_t terms, std::uint8_t seed) {
    Bytes bytes;
    for (std::size_t i = 0; i < terms; ++i) {
        const auto low = static_cast<std::uint8_t>(i + seed);
        const Bytes term{static_cast<std::uint8_t>(0xC0 | (i % 60)), low, seed, 0x3E, 0x80, 0x01, low, seed};
        bytes.insert(bytes.end(), term.begin(), term.end());
    }
    bytes.insert(bytes.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    return bytes;
}

inline void poll_while(Slots& slots, Phase phase) {
    for (int i = 0; slots.phase() == phase && i < 100'000; ++i) slots.poll();
}

/// In pieces of 8 bytes, as a client sends terms.
inline Phase write(Slots& slots, const Bytes& bytes, std::optional<std::uint32_t> crc = {}) {
    if (!slots.begin()) return Phase::failed;
    poll_while(slots, Phase::erasing);
    std::uint32_t at = 0;
    for (int i = 0; at < bytes.size() && i < 1'000'000; ++i) {
        const std::uint32_t count = std::min<std::uint32_t>(8, static_cast<std::uint32_t>(bytes.size()) - at);
        const auto status = slots.write(at, std::span(bytes).subspan(at, count));
        if (status) {
            at += count;
        } else if (status.error() != base::Error::busy) {
            return slots.phase();
        }
        slots.poll();
    }
    static_cast<void>(
        slots.finish(static_cast<std::uint32_t>(bytes.size()), crc.value_or(base::crc32(bytes))));
    poll_while(slots, Phase::closing);
    return slots.phase();
}

/// Content of any kind, whatever it is.
inline void write_raw(ports::Storage& device, const Area& area, Kind kind, const Bytes& bytes) {
    AnyContent anything;
    Slots slots(device, area, kind, anything);
    ASSERT_TRUE(slots.mount().ok());
    ASSERT_EQ(write(slots, bytes), Phase::done);
}

/// One start of the gateway on a device.
struct Session {
    explicit Session(ports::Storage& device, const Area& area) : slots(device, area, Kind::table, check) {
        mounted = slots.mount().ok();
    }

    /// Nothing without a current table.
    std::optional<Bytes> content() {
        if (!slots.has_current()) return std::nullopt;
        Bytes bytes(slots.current().length);
        const auto length = slots.load(bytes);
        return length ? std::optional(bytes) : std::nullopt;
    }

    void poll_while(Phase phase) { store::poll_while(slots, phase); }
    Phase write(const Bytes& bytes, std::optional<std::uint32_t> crc = {}) {
        return store::write(slots, bytes, crc);
    }

    TableCheck check;
    Slots slots;
    bool mounted = false;
};

/// The tables were written one after the other.
inline sim::SimStorage device_with(const Shape& shape, const std::vector<Bytes>& tables) {
    sim::SimStorage device(shape.geometry);
    for (const Bytes& table : tables) {
        Session session(device, shape.area);
        EXPECT_EQ(session.write(table), Phase::done);
    }
    return device;
}

}  // namespace nplc::store
