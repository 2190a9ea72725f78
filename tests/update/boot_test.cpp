// Which slot a loader starts.

#include "bench.h"

namespace nplc::update {
namespace {

struct Boot : testing::Test {
    const Shape shape = shapes().front();
    const Layout& layout = shape.layout;
    sim::SimStorage device{shape.geometry};

    void have(unsigned version, unsigned slot, Marks marks) {
        install(device, layout, slot, firmware(version, slot), marks);
    }
    std::string boots() { return update::boots(device, layout); }
};

TEST_F(Boot, AnErasedChipHasNothingToStart) {
    EXPECT_EQ(boots(), "none");
}

TEST_F(Boot, WhatIsNotCompleteIsNotStarted) {
    have(1, 0, {});
    EXPECT_EQ(boots(), "none");
    have(2, 1, {.confirmed = true});
    EXPECT_EQ(boots(), "none");
}

TEST_F(Boot, TheConfirmedOneIsStarted) {
    have(1, 0, kConfirmed);
    EXPECT_EQ(boots(), "0");
    EXPECT_EQ(device.operations(), firmware(1, 0).size() / 4 + 3) << "nothing is noted";
}

TEST_F(Boot, OfTwoConfirmedOnesTheNewer) {
    have(3, 0, kConfirmed);
    have(2, 1, kConfirmed);
    EXPECT_EQ(boots(), "0");
    sim::SimStorage other(shape.geometry);
    install(other, layout, 0, firmware(1, 0), kConfirmed);
    install(other, layout, 1, firmware(2, 1), kConfirmed);
    EXPECT_EQ(update::boots(other, layout), "1");
}

TEST_F(Boot, ANewOneIsTriedThreeTimes) {
    have(1, 0, kConfirmed);
    have(2, 1, kFresh);
    for (unsigned i = 0; i < kTries; ++i) EXPECT_EQ(boots(), "1 on trial");
    EXPECT_EQ(boots(), "0");
    EXPECT_EQ(boots(), "0");
}

TEST_F(Boot, OneThatConfirmsItselfStays) {
    have(1, 0, kConfirmed);
    have(2, 1, kFresh);
    EXPECT_EQ(boots(), "1 on trial");
    put_mark(device, layout, 1, Mark::confirmed);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(boots(), "1");
}

TEST_F(Boot, AnOlderOneIsNotTried) {
    have(2, 0, kConfirmed);
    have(1, 1, kFresh);
    EXPECT_EQ(boots(), "0");
}

TEST_F(Boot, TheSameVersionIsNotTried) {
    have(2, 0, kConfirmed);
    have(2, 1, kFresh);
    EXPECT_EQ(boots(), "0");
}

TEST_F(Boot, WithoutAnotherOneTheOneThatFailedIsStarted) {
    have(1, 0, {.complete = true, .tries = 3});
    EXPECT_EQ(boots(), "0");
    have(2, 1, {});
    EXPECT_EQ(boots(), "0");
}

TEST_F(Boot, OneSignedWithAnotherKeyIsNotStarted) {
    have(1, 0, kConfirmed);
    install(device, layout, 1, firmware(2, 1, kForged), kFresh);
    EXPECT_EQ(boots(), "0");
    EXPECT_EQ(look(device, layout, 1, kBoard).marks.tries, 0) << "so a user sees that it was not even tried";
}

TEST_F(Boot, OneOfAnotherBoardIsNotStarted) {
    install(device, layout, 1, firmware(2, 1, kOtherBoards), kConfirmed);
    EXPECT_EQ(boots(), "none");
}

TEST_F(Boot, OneOfTheOtherSlotIsNotStarted) {
    install(device, layout, 0, firmware(2, 1), kConfirmed);
    EXPECT_EQ(boots(), "none");
}

TEST_F(Boot, NoBitOfAHeaderMayBeAnother) {
    have(2, 1, kConfirmed);
    ASSERT_EQ(boots(), "1");
    for (std::uint32_t bit = 0; bit < 8 * kHeaderBytes; ++bit) {
        sim::SimStorage flipped(device);
        flipped.flip(layout.header(1) + bit / 8, bit % 8);
        EXPECT_EQ(update::boots(flipped, layout), "none") << "bit " << bit;
    }
}

TEST_F(Boot, NoBitOfAnImageMayBeAnother) {
    have(2, 1, kConfirmed);
    for (std::uint32_t bit = 0; bit < 8 * kBytes; ++bit) {
        sim::SimStorage flipped(device);
        flipped.flip(layout.image(1) + bit / 8, bit % 8);
        EXPECT_EQ(update::boots(flipped, layout), "none") << "bit " << bit;
    }
}

TEST_F(Boot, WhenTheNewerOneIsDamagedTheOlderOneIsStarted) {
    have(1, 0, kConfirmed);
    have(2, 1, kConfirmed);
    for (const std::uint32_t address : {layout.header(1), layout.header(1) + 150, layout.image(1) + 40}) {
        sim::SimStorage flipped(device);
        flipped.flip(address, 5);
        EXPECT_EQ(update::boots(flipped, layout), "0") << address;
    }
}

TEST_F(Boot, WithAnyBitOfTheMarksFlippedOneIsStarted) {
    have(1, 0, kConfirmed);
    have(2, 1, kConfirmed);
    for (unsigned slot = 0; slot < kSlots; ++slot) {
        for (std::uint32_t bit = 0; bit < 8 * 7 * layout.unit(); ++bit) {
            sim::SimStorage flipped(device);
            flipped.flip(layout.marks(slot) + bit / 8, bit % 8);
            EXPECT_NE(update::boots(flipped, layout), "none") << "slot " << slot << ", bit " << bit;
        }
    }
}

TEST_F(Boot, AStorageThatCannotNoteATryStartsTheConfirmedOne) {
    have(1, 0, kConfirmed);
    have(2, 1, kFresh);
    device.fail_operation(0);
    EXPECT_EQ(boots(), "0");
    EXPECT_EQ(boots(), "1 on trial");
}

TEST_F(Boot, AStorageThatCannotBeReadHasNothingToStart) {
    have(1, 0, kConfirmed);
    device.work_for(1'000'000);
    EXPECT_TRUE(device.erase(layout.marks(1)).ok());
    EXPECT_EQ(boots(), "none");
}

}  // namespace
}  // namespace nplc::update
