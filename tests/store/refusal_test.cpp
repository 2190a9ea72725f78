// A storage that refuses one call, whichever it is: reading, programming or erasing. The old or the new
// content is there afterwards, and what went wrong is said.

#include <gtest/gtest.h>

#include <iostream>

#include "store/settings_store.h"
#include "store_bench.h"

namespace nplc::store {
namespace {

const Bytes kBefore = table_of(40, 1);
const Bytes kAfter = table_of(60, 2);
constexpr std::uint64_t kRefusesNone = ~std::uint64_t{0};

/// Another's storage, of which call number `refused` of read(), program() and erase() is answered with `why`.
class RefusingStorage final : public ports::Storage {
  public:
    RefusingStorage(ports::Storage& device, std::uint64_t refused, base::Error why)
        : device_(device), refused_(refused), why_(why) {}

    ports::StorageGeometry geometry() const override { return device_.geometry(); }
    base::Status read(std::uint32_t address, std::span<std::uint8_t> out) override {
        return refuses() ? base::Status{why_} : device_.read(address, out);
    }
    base::Status program(std::uint32_t address, std::span<const std::uint8_t> bytes) override {
        return refuses() ? base::Status{why_} : device_.program(address, bytes);
    }
    base::Status erase(std::uint32_t address) override {
        return refuses() ? base::Status{why_} : device_.erase(address);
    }
    ports::StorageState state() override { return device_.state(); }

    std::uint64_t calls() const { return calls_; }

  private:
    bool refuses() { return calls_++ == refused_; }

    ports::Storage& device_;
    std::uint64_t refused_;
    base::Error why_;
    std::uint64_t calls_ = 0;
};

/// From the start-up on, through a whole upload.
void upload_with_a_refusal(const Shape& shape, const sim::SimStorage& before, std::uint64_t call,
                           base::Error why) {
    sim::SimStorage device(before);
    RefusingStorage storage(device, call, why);
    Session session(storage, shape.area);
    const Phase phase = session.mounted ? session.write(kAfter) : Phase::failed;
    const auto found = Session(device, shape.area).content();
    if (phase == Phase::done) {
        EXPECT_EQ(found, kAfter) << shape.name << ", call " << call;
    } else {
        EXPECT_TRUE(found == kBefore || found == kAfter) << shape.name << ", call " << call;
        if (session.mounted) {
            EXPECT_EQ(session.slots.error(), why) << shape.name << ", call " << call;
        }
        EXPECT_EQ(Session(device, shape.area).write(kAfter), Phase::done) << "the next one goes well";
    }
}

TEST(Refusal, OfAnyOneCallLeavesTheOldOrTheNewTable) {
    std::uint64_t cases = 0;
    for (const Shape& shape : shapes(600)) {
        const sim::SimStorage before = device_with(shape, {kBefore});
        sim::SimStorage device(before);
        RefusingStorage counting(device, kRefusesNone, {});
        ASSERT_EQ(Session(counting, shape.area).write(kAfter), Phase::done);
        for (const base::Error why : {base::Error::storage_failed, base::Error::busy}) {
            for (std::uint64_t call = 0; call < counting.calls(); ++call, ++cases)
                upload_with_a_refusal(shape, before, call, why);
        }
    }
    EXPECT_GT(cases, 500U);
    std::cout << cases << " cases\n";
}

TEST(Refusal, WhileTheTableIsLoadedIsHandedOn) {
    const Shape shape = shapes(600).front();
    sim::SimStorage device = device_with(shape, {kBefore});
    RefusingStorage mounted(device, kRefusesNone, {});
    ASSERT_TRUE(Session(mounted, shape.area).mounted);
    RefusingStorage storage(device, mounted.calls(), base::Error::busy);
    Session session(storage, shape.area);
    Bytes bytes(kBefore.size());
    EXPECT_EQ(session.slots.load(bytes).error(), base::Error::busy);
    EXPECT_EQ(session.slots.load(bytes).value(), kBefore.size());
    EXPECT_EQ(bytes, kBefore);
}

TEST(Refusal, OfLessRoomThanTheTableHasIsSaid) {
    const Shape shape = shapes(600).front();
    sim::SimStorage device = device_with(shape, {kBefore});
    Session session(device, shape.area);
    Bytes bytes(kBefore.size() - 1);
    EXPECT_EQ(session.slots.load(bytes).error(), base::Error::no_space);
    bytes.resize(8);
    const auto length = static_cast<std::uint32_t>(kBefore.size());
    EXPECT_TRUE(session.slots.read(length - 8, bytes).ok());
    EXPECT_EQ(bytes, Bytes(kBefore.end() - 8, kBefore.end()));
    EXPECT_EQ(session.slots.read(length - 7, bytes).error(), base::Error::bad_offset);
    EXPECT_EQ(session.slots.read(length + 1, {}).error(), base::Error::bad_offset);
}

TEST(Refusal, OfAnyOneCallLeavesTheOldOrTheNewSettings) {
    const Shape shape = shapes(kMaxSettingsBytes).front();
    SettingValues old;
    SettingValues next;
    ASSERT_TRUE(old.set(Setting::safe_outputs, 5).ok());
    ASSERT_TRUE(next.set(Setting::safe_outputs, 10).ok());
    sim::SimStorage before(shape.geometry);
    const auto save = [&](ports::Storage& storage, const SettingValues& values) {
        SettingsStore settings(storage, shape.area);
        if (!settings.mount().ok() || !settings.save(values).ok()) return false;
        for (int i = 0; i < 100'000 && settings.phase() != Phase::done && settings.phase() != Phase::failed;
             ++i) {
            EXPECT_NE(settings.next_poll(base::Instant{}), base::kNever);
            settings.poll();
        }
        return settings.phase() == Phase::done;
    };
    ASSERT_TRUE(save(before, old));
    sim::SimStorage device(before);
    RefusingStorage counting(device, kRefusesNone, {});
    ASSERT_TRUE(save(counting, next));
    for (std::uint64_t call = 0; call < counting.calls(); ++call) {
        sim::SimStorage tried(before);
        RefusingStorage storage(tried, call, base::Error::storage_failed);
        const bool done = save(storage, next);
        const auto found = SettingsStore(tried, shape.area).mount();
        ASSERT_TRUE(found.ok()) << "call " << call;
        EXPECT_TRUE(found.value() == next || (!done && found.value() == old)) << "call " << call;
    }
}

TEST(Refusal, OfAGeometryThatNoStorageHas) {
    const ports::StorageGeometry good{
        .size = 4096, .erase_block = 1024, .program_page = 256, .program_unit = 4};
    const Area area{.begin = 1024, .slot_bytes = 1024};
    ASSERT_TRUE(Layout(good, area).is_possible());
    const auto with = [&](std::uint32_t ports::StorageGeometry::*part, std::uint32_t value) {
        ports::StorageGeometry changed = good;
        changed.*part = value;
        return Layout(changed, area).is_possible();
    };
    using Geometry = ports::StorageGeometry;
    for (const std::uint32_t unit : {0U, 3U, 512U}) EXPECT_FALSE(with(&Geometry::program_unit, unit)) << unit;
    for (const std::uint32_t page : {0U, 6U, 768U}) EXPECT_FALSE(with(&Geometry::program_page, page)) << page;
    for (const std::uint32_t block : {0U, 384U, 3072U})
        EXPECT_FALSE(with(&Geometry::erase_block, block)) << block;
    for (const std::uint32_t size : {0U, 4000U, 2048U}) EXPECT_FALSE(with(&Geometry::size, size)) << size;
    // A unit of 512 bytes is larger than the buffer it would be programmed from (kLargestUnit = 256).
    EXPECT_FALSE(Layout({.size = 4096, .erase_block = 1024, .program_page = 512, .program_unit = 512}, area)
                     .is_possible());
    // Two blocks of 32 bytes, all of them header and mark.
    EXPECT_FALSE(Layout({.size = 128, .erase_block = 32, .program_page = 32, .program_unit = 1},
                        {.begin = 0, .slot_bytes = 32})
                     .is_possible());
}

/// A slot that is whole, except for its header.
sim::SimStorage device_with_header(const Shape& shape, const Header& header) {
    sim::SimStorage device(shape.geometry);
    const Layout layout(shape.geometry, shape.area);
    const auto encoded = encode(header);
    const auto mark = mark_for(encoded);
    EXPECT_TRUE(device.program(layout.header(0), encoded).ok());
    while (device.state() == ports::StorageState::busy) continue;
    EXPECT_TRUE(device.program(layout.mark(0), mark).ok());
    while (device.state() == ports::StorageState::busy) continue;
    return device;
}

TEST(Refusal, OfAHeaderForAnotherKindOrForMoreThanASlotHolds) {
    const Shape shape = shapes(600).back();  // an EEPROM takes records of any size at once
    const std::uint32_t capacity = Layout(shape.geometry, shape.area).capacity();
    const Header empty{.kind = Kind::table, .sequence = 1, .length = 0, .crc = 0};
    Header other = empty;
    other.kind = Kind::settings;
    Header full = empty;
    full.length = capacity;
    full.crc = base::crc32(Bytes(capacity, 0xFF));
    Header longer = empty;
    longer.length = capacity + 1;
    for (const auto& [header, state] :
         {std::pair(empty, SlotState::good), std::pair(full, SlotState::good),
          std::pair(other, SlotState::damaged), std::pair(longer, SlotState::damaged)}) {
        sim::SimStorage device = device_with_header(shape, header);
        Session session(device, shape.area);
        EXPECT_TRUE(session.mounted);
        EXPECT_EQ(session.slots.state(0), state) << header.length;
    }
}

TEST(Refusal, OfATableWhoseBothCopiesWentBadSinceTheStart) {
    const Shape shape = shapes(600).front();
    sim::SimStorage device = device_with(shape, {kBefore, kAfter});
    Session session(device, shape.area);
    ASSERT_TRUE(session.mounted);
    const Layout layout(shape.geometry, shape.area);
    for (const unsigned slot : {0U, 1U}) device.flip(layout.content(slot) + 5, 3);
    Bytes bytes(kAfter.size());
    EXPECT_EQ(session.slots.load(bytes).error(), base::Error::damaged);
}

TEST(Refusal, OfPiecesThatAreNoRepeat) {
    const Shape shape = shapes(2000).front();
    const Bytes table = table_of(200, 3);  // 1608 bytes: more than both buffers of 256 hold
    sim::SimStorage device(shape.geometry);
    Session session(device, shape.area);
    ASSERT_TRUE(session.slots.begin().ok());
    EXPECT_EQ(session.slots.finish(0, 0).error(), base::Error::busy) << "the slot is still being erased";
    session.poll_while(Phase::erasing);
    const auto piece = [&](std::uint32_t at) { return std::span(table).subspan(at, 8); };
    for (std::uint32_t at = 0; at < 800;) {
        if (session.slots.write(at, piece(at)).ok()) at += 8;
        session.slots.poll();
    }
    EXPECT_TRUE(session.slots.write(792, piece(792)).ok());
    EXPECT_EQ(session.slots.write(0, piece(0)).error(), base::Error::bad_offset) << "too long ago";
    EXPECT_EQ(session.slots.write(792, piece(784)).error(), base::Error::bad_offset) << "other bytes";
    EXPECT_EQ(session.slots.write(808, piece(808)).error(), base::Error::bad_offset) << "one is missing";
    EXPECT_EQ(session.slots.write(796, piece(796)).error(), base::Error::bad_offset) << "half of it is new";
    EXPECT_EQ(session.slots.write(792, {}).error(), base::Error::bad_offset) << "nothing";
}

TEST(Refusal, ToNoteALossIsHandedOn) {
    const Shape shape = shapes(600).front();
    sim::SimStorage slow(shape.geometry, 3);
    ASSERT_TRUE(note_loss(slow, shape.area).ok());
    Session session(slow, shape.area);
    EXPECT_FALSE(session.slots.has_current());
    EXPECT_TRUE(session.slots.is_fallback());

    sim::SimStorage device(shape.geometry);
    RefusingStorage refusing(device, 0, base::Error::busy);
    EXPECT_EQ(note_loss(refusing, shape.area).error(), base::Error::busy);
    device.fail_operation(0);
    EXPECT_EQ(note_loss(device, shape.area).error(), base::Error::storage_failed);
}

}  // namespace
}  // namespace nplc::store
