// What a writing takes and what it refuses; storages that fail.

#include <gtest/gtest.h>

#include "store_bench.h"

namespace nplc::store {
namespace {

const Bytes kTable = table_of(50, 1);
const Bytes kOther = table_of(60, 2);

struct SlotsTest : testing::Test {
    const Shape shape = shapes(600).front();
    sim::SimStorage device{shape.geometry, 3};
    Session session{device, shape.area};
    Slots& slots = session.slots;

    void begin() {
        ASSERT_TRUE(slots.begin().ok());
        session.poll_while(Phase::erasing);
        ASSERT_EQ(slots.phase(), Phase::receiving);
    }
    std::span<const std::uint8_t> piece(std::uint32_t at, std::size_t count) {
        return std::span(kTable).subspan(at, count);
    }
    void expect_failed(Phase phase, base::Error error) {
        EXPECT_EQ(phase, Phase::failed);
        EXPECT_EQ(slots.error(), error);
    }
};

TEST_F(SlotsTest, ANewDeviceHasNoTableAndNothingToComplainOf) {
    EXPECT_TRUE(session.mounted);
    EXPECT_FALSE(slots.has_current());
    EXPECT_FALSE(slots.is_fallback());
    Bytes none;
    EXPECT_EQ(slots.load(none).error(), base::Error::no_table);
    EXPECT_EQ(slots.read(0, none).error(), base::Error::no_table);
}

TEST_F(SlotsTest, EachWritingCountsOn) {
    for (std::uint32_t i = 1; i <= 5; ++i) {
        EXPECT_EQ(session.write(i % 2 == 0 ? kTable : kOther), Phase::done);
        EXPECT_EQ(slots.current().sequence, i);
    }
    EXPECT_EQ(slots.current().crc, base::crc32(kOther));
    EXPECT_EQ(Session(device, shape.area).content(), kOther);
}

TEST_F(SlotsTest, PiecesComeInOrderAndARepeatIsTaken) {
    EXPECT_EQ(slots.write(0, piece(0, 8)).error(), base::Error::not_begun);
    ASSERT_TRUE(slots.begin().ok());
    EXPECT_EQ(slots.write(0, piece(0, 8)).error(), base::Error::busy) << "it still erases";
    begin();
    EXPECT_TRUE(slots.write(0, piece(0, 8)).ok());
    EXPECT_TRUE(slots.write(0, piece(0, 8)).ok()) << "the accept was lost";
    EXPECT_EQ(slots.write(0, piece(8, 8)).error(), base::Error::bad_offset) << "not the same";
    EXPECT_EQ(slots.write(16, piece(16, 8)).error(), base::Error::bad_offset) << "a gap";
    EXPECT_EQ(slots.write(4, piece(4, 8)).error(), base::Error::bad_offset) << "half of it new";
    EXPECT_EQ(slots.received(), 8U);
    EXPECT_TRUE(slots.write(8, piece(8, 248)).ok());
    EXPECT_TRUE(slots.write(256, piece(256, 8)).ok());
    EXPECT_TRUE(slots.write(252, piece(252, 12)).ok()) << "a repeat over both buffers";
}

TEST_F(SlotsTest, WhenTheStorageIsSlowPiecesWait) {
    sim::SimStorage slow(shape.geometry, 1000);
    Session other(slow, shape.area);
    ASSERT_TRUE(other.slots.begin().ok());
    other.poll_while(Phase::erasing);
    std::uint32_t at = 0;
    while (other.slots.write(at, piece(at % 8, 8)).ok()) {
        at += 8;
        other.slots.poll();
    }
    EXPECT_EQ(at, 512U) << "two buffers of 256";
    EXPECT_EQ(other.slots.write(at, piece(0, 8)).error(), base::Error::busy);
    EXPECT_EQ(other.slots.received(), 512U);
}

TEST_F(SlotsTest, WhatTheSenderMeantIsHeldAgainstWhatCame) {
    ASSERT_EQ(session.write(kOther), Phase::done);
    expect_failed(session.write(kTable, base::crc32(kOther)), base::Error::wrong_check);
    begin();
    EXPECT_TRUE(slots.write(0, piece(0, 8)).ok());
    EXPECT_EQ(slots.finish(16, base::crc32(piece(0, 8))).error(), base::Error::wrong_check);
    EXPECT_EQ(session.content(), kOther);
    EXPECT_EQ(slots.finish(8, 0).error(), base::Error::not_begun);
}

TEST_F(SlotsTest, FinishMayBeRepeated) {
    ASSERT_EQ(session.write(kTable), Phase::done);
    const auto length = static_cast<std::uint32_t>(kTable.size());
    EXPECT_TRUE(slots.finish(length, base::crc32(kTable)).ok());
    EXPECT_EQ(slots.finish(length - 8, base::crc32(kTable)).error(), base::Error::not_begun);
    EXPECT_EQ(slots.finish(length, 1).error(), base::Error::not_begun);
    EXPECT_EQ(slots.phase(), Phase::done);
}

TEST_F(SlotsTest, ATableThatBreaksARuleIsRefusedWithItsTerm) {
    ASSERT_EQ(session.write(kOther), Phase::done);
    Bytes wrong = kTable;
    wrong[7 * 8 + 3] = 0x3F;  // NEXT_STATE of term 7
    expect_failed(session.write(wrong), base::Error::bad_next_step);
    EXPECT_EQ(session.check.fault_term(), 7);
    Bytes endless(kTable.begin(), kTable.end() - 8);
    expect_failed(session.write(endless), base::Error::table_no_end);
    EXPECT_EQ(session.check.fault_term(), 50);
    expect_failed(session.write(Bytes(kTable.begin(), kTable.end() - 3)), base::Error::table_ragged);
    expect_failed(session.write({}), base::Error::table_no_end);
    EXPECT_EQ(Session(device, shape.area).content(), kOther);
}

struct NoOutputs final : TermCheck {
    bool accepts(sequencer::TermView term) const override { return (term[5] & 0x0F) == 0; }
};

TEST_F(SlotsTest, ATermThatTheMotorDoesNotHaveIsRefused) {
    const NoOutputs terms;
    TableCheck check(&terms);
    check.begin();
    EXPECT_EQ(check.take(kTable).error(), base::Error::not_for_motor);
    EXPECT_EQ(check.fault_term(), 0);
}

TEST_F(SlotsTest, MoreThanThereIsRoomForIsRefused) {
    begin();
    Bytes fill(256, 0);
    std::uint32_t at = 0;
    for (int i = 0; i < 10'000 && at + 256 <= slots.capacity(); ++i) {
        if (slots.write(at, fill)) at += 256;
        slots.poll();
    }
    session.poll_while(Phase::closing);
    EXPECT_EQ(slots.write(at, fill).error(), base::Error::no_space);
}

TEST_F(SlotsTest, AWornBitIsFoundByReadingBack) {
    ASSERT_EQ(session.write(kOther), Phase::done);
    const Layout layout(shape.geometry, shape.area);
    const std::array<std::uint32_t, 3> places{layout.content(1) + 9, layout.header(1) + 8, layout.mark(1)};
    for (const std::uint32_t address : places) {
        for (unsigned bit = 0; bit < 8; ++bit) {
            sim::SimStorage worn(device);
            worn.wear_out(address, bit);
            Session attempt(worn, shape.area);
            if (attempt.write(kTable) == Phase::done) {
                EXPECT_EQ(Session(worn, shape.area).content(), kTable) << "the bit was to be 1 anyway";
            } else {
                EXPECT_EQ(attempt.slots.error(), base::Error::storage_failed);
                EXPECT_EQ(Session(worn, shape.area).content(), kOther);
            }
        }
    }
}

TEST_F(SlotsTest, AStorageThatSaysNoFailsTheWriting) {
    ASSERT_EQ(session.write(kOther), Phase::done);
    const std::uint64_t before = device.operations();
    sim::SimStorage counted(device);
    ASSERT_EQ(Session(counted, shape.area).write(kTable), Phase::done);
    const std::uint64_t last = counted.operations() - before - 1;
    for (std::uint64_t i = 0; i <= last; ++i) {
        sim::SimStorage bad(device);
        bad.fail_operation(i);
        Session attempt(bad, shape.area);
        if (i == last) {
            EXPECT_EQ(attempt.write(kTable), Phase::done)
                << "the new one is current, the old one not told so";
            EXPECT_EQ(Session(bad, shape.area).content(), kTable);
            break;
        }
        EXPECT_EQ(attempt.write(kTable), Phase::failed) << i;
        EXPECT_EQ(attempt.slots.error(), base::Error::storage_failed);
        EXPECT_EQ(attempt.content(), kOther);
        EXPECT_EQ(attempt.write(kTable), Phase::done) << "the next one goes well";
    }
}

TEST_F(SlotsTest, TheOldTableIsReadWhileANewOneComes) {
    ASSERT_EQ(session.write(kOther), Phase::done);
    begin();
    EXPECT_TRUE(slots.write(0, piece(0, 8)).ok());
    EXPECT_EQ(session.content(), kOther);
    slots.abandon();
    EXPECT_EQ(slots.phase(), Phase::idle);
    EXPECT_EQ(session.content(), kOther);
    EXPECT_EQ(session.write(kTable), Phase::done);
}

TEST_F(SlotsTest, ReadsUpToTheEndAndNotBeyond) {
    ASSERT_EQ(session.write(kTable), Phase::done);
    const auto length = static_cast<std::uint32_t>(kTable.size());
    Bytes bytes(8);
    EXPECT_TRUE(slots.read(length - 8, bytes).ok());
    EXPECT_EQ(bytes, Bytes(kTable.end() - 8, kTable.end()));
    EXPECT_EQ(slots.read(length - 7, bytes).error(), base::Error::bad_offset);
    EXPECT_TRUE(slots.read(length, {}).ok());
    EXPECT_EQ(slots.read(length + 1, {}).error(), base::Error::bad_offset);
}

TEST_F(SlotsTest, WhatDoesNotFitTheStorageIsNamedAtTheStart) {
    TableCheck check;
    for (const Area area : {Area{1, 1024}, Area{0, 1000}, Area{0, 0}, Area{0, 1'000'000},
                            Area{shape.geometry.size - 1024, 1024}, Area{0xFFFF'FC00, 1024}}) {
        Slots wrong(device, area, Kind::table, check);
        EXPECT_EQ(wrong.mount().error(), base::Error::bad_geometry) << area.begin << ' ' << area.slot_bytes;
        EXPECT_EQ(wrong.begin().error(), base::Error::bad_geometry);
    }
}

}  // namespace
}  // namespace nplc::store
