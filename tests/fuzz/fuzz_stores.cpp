// Any bytes in the storage: a start takes a whole table, whole settings and whole set-points from it, or
// none, and what is written then is there at the next start.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/crc32.h"
#include "fuzz.h"
#include "sequencer/table.h"
#include "sim/sim_storage.h"
#include "store/set_points.h"
#include "store/settings_store.h"
#include "store/table_check.h"

namespace {

using namespace nplc;

constexpr ports::StorageGeometry kGeometry{
    .size = 0x4000, .erase_block = 256, .program_page = 256, .program_unit = 8};
constexpr store::Area kTable{0, 512};
constexpr store::Area kSettings{1024, 512};
constexpr store::Area kSetPoints{2048, 2048};

void put(sim::SimStorage& storage, std::uint32_t address, std::span<const std::uint8_t> bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += kGeometry.program_unit) {
        std::array<std::uint8_t, kGeometry.program_unit> unit{};
        const auto part = bytes.subspan(at, std::min(unit.size(), bytes.size() - at));
        std::copy(part.begin(), part.end(), unit.begin());
        require(storage.program(address + static_cast<std::uint32_t>(at), unit).ok());
        while (storage.state() == ports::StorageState::busy) {
        }
    }
}

/// Two slots of unknown origin: with an even first byte just these bytes, else a whole slot with this
/// content.
sim::SimStorage flash_with(std::span<const std::uint8_t> bytes, const store::Area& area, store::Kind kind) {
    sim::SimStorage storage(kGeometry);
    if (bytes.empty()) return storage;
    const bool is_whole = bytes[0] % 2 != 0;
    bytes = bytes.subspan(1);
    const store::Layout layout(kGeometry, area);
    if (!is_whole) {
        put(storage, area.begin, bytes.first(std::min<std::size_t>(bytes.size(), 2 * area.slot_bytes)));
        return storage;
    }
    bytes = bytes.first(std::min<std::size_t>(bytes.size(), layout.capacity()));
    const auto length = static_cast<std::uint32_t>(bytes.size());
    const auto header = encode(store::Header{kind, 7, length, base::crc32(bytes)});
    put(storage, layout.content(0), bytes);
    put(storage, layout.header(0), header);
    put(storage, layout.mark(0), store::mark_for(header));
    return storage;
}

void hold_whole(store::Slots& slots) {
    if (!slots.has_current()) return;
    const store::Header header = slots.current();
    require(header.length <= slots.capacity());
    std::vector<std::uint8_t> content(slots.capacity());
    const auto loaded = slots.load(content);
    require(loaded.ok() && loaded.value() == header.length);
    require(base::crc32(std::span(content).first(header.length)) == header.crc);
}

void table(std::span<const std::uint8_t> bytes) {
    sim::SimStorage storage = flash_with(bytes, kTable, store::Kind::table);
    store::TableCheck check;
    store::Slots slots(storage, kTable, store::Kind::table, check);
    require(slots.mount().ok());
    hold_whole(slots);
    constexpr std::array<std::uint8_t, 16> kNew = {0xC0, 1, 1, 1, 0x80, 5, 0, 0, 0x3F};
    require(slots.begin().ok());
    for (int i = 0; i < 10'000 && slots.phase() != store::Phase::receiving; ++i) slots.poll();
    require(slots.write(0, kNew).ok() && slots.finish(kNew.size(), base::crc32(kNew)).ok());
    for (int i = 0; i < 10'000 && slots.phase() == store::Phase::closing; ++i) slots.poll();
    require(slots.phase() == store::Phase::done);
    store::Slots next(storage, kTable, store::Kind::table, check);
    require(next.mount().ok() && next.has_current());
    require(next.current().length == kNew.size() && next.current().crc == base::crc32(kNew));
}

void settings(std::span<const std::uint8_t> bytes) {
    sim::SimStorage storage = flash_with(bytes, kSettings, store::Kind::settings);
    store::SettingsStore kept(storage, kSettings);
    const auto read = kept.mount();
    const store::SettingValues values = read.ok() ? read.value() : store::SettingValues{};
    require(kept.save(values).ok());
    for (int i = 0; i < 10'000 && kept.phase() != store::Phase::done; ++i) kept.poll();
    store::SettingsStore next(storage, kSettings);
    const auto again = next.mount();
    require(again.ok() && again.value() == values);
}

void set_points(std::span<const std::uint8_t> bytes) {
    sim::SimStorage storage = flash_with(bytes, kSetPoints, store::Kind::set_points);
    store::SetPointStore kept(storage, kSetPoints);
    (void)kept.mount();
    require(kept.image().is_sound());
    require(kept.image().active() <= store::kRecipes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    table({data, size});
    settings({data, size});
    set_points({data, size});
    return 0;
}
