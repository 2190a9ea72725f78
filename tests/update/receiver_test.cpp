// What an update takes and what it refuses; storages that fail.

#include "bench.h"

namespace nplc::update {
namespace {

constexpr std::uint32_t kFew = 200;  ///< bytes announced

struct Receiving : testing::Test {
    const Shape shape = shapes().front();
    const Layout& layout = shape.layout;
    sim::SimStorage device = begun();
    Receiver receiver{device, layout, kBoard, 0};

    sim::SimStorage begun() {
        sim::SimStorage made(shape.geometry, 2);
        install(made, layout, 0, firmware(2, 0), kConfirmed);
        return made;
    }
    std::string boots() { return update::boots(device, layout); }
    void expect_refused(const Bytes& bytes, Result why) {
        EXPECT_EQ(send(receiver, bytes), why);
        EXPECT_EQ(receiver.phase(), Phase::failed);
        EXPECT_EQ(boots(), "0");
    }
    std::span<const std::uint8_t> piece(const Bytes& bytes, std::uint32_t at, std::size_t count) {
        return std::span(bytes).subspan(at, count);
    }
    void begin() {
        ASSERT_EQ(receiver.begin(kFew), Result::done);
        poll_while(receiver, Phase::erasing);
        ASSERT_EQ(receiver.phase(), Phase::receiving);
    }
};

TEST_F(Receiving, ANewerOneIsTriedAndConfirmed) {
    EXPECT_TRUE(receiver.is_confirmed());
    EXPECT_EQ(send(receiver, firmware(3, 1)), Result::done);
    EXPECT_EQ(receiver.slot(1).header->version, 3U);
    EXPECT_EQ(receiver.slot(1).marks, kFresh);
    EXPECT_EQ(boots(), "1 on trial");
    Receiver next(device, layout, kBoard, 1);
    EXPECT_FALSE(next.is_confirmed());
    next.confirm();
    for (int i = 0; i < 10; ++i) next.poll();
    EXPECT_TRUE(next.is_confirmed());
    EXPECT_EQ(boots(), "1");
    EXPECT_EQ(send(next, firmware(4, 0)), Result::done) << "and back";
    EXPECT_EQ(boots(), "0 on trial");
    EXPECT_EQ(device.programmed_twice(), 0U);
}

TEST_F(Receiving, AConfirmedOneNotesNothingMore) {
    const std::uint64_t before = device.operations();
    receiver.confirm();
    EXPECT_EQ(device.operations(), before);
}

TEST_F(Receiving, NothingIsTakenWhileTheRunningOneIsOnTrial) {
    ASSERT_EQ(send(receiver, firmware(3, 1)), Result::done);
    ASSERT_EQ(boots(), "1 on trial");
    Receiver trial(device, layout, kBoard, 1);
    EXPECT_EQ(trial.begin(kFew), Result::not_confirmed);
    EXPECT_EQ(boots(), "1 on trial");
    trial.confirm();
    EXPECT_EQ(trial.begin(kFew), Result::busy) << "the mark is being programmed";
    for (int i = 0; i < 10; ++i) trial.poll();
    EXPECT_EQ(trial.begin(kFew), Result::done);
}

TEST_F(Receiving, OneThatFailedIsFollowedByTheNext) {
    ASSERT_EQ(send(receiver, firmware(3, 1)), Result::done);
    for (unsigned i = 0; i < kTries; ++i) EXPECT_EQ(boots(), "1 on trial");
    ASSERT_EQ(boots(), "0");
    Receiver again(device, layout, kBoard, 0);
    EXPECT_EQ(again.slot(1).marks.tries, kTries);
    EXPECT_EQ(send(again, firmware(3, 1)), Result::done) << "the same version: it never ran healthily";
    EXPECT_EQ(boots(), "1 on trial");
}

TEST_F(Receiving, AnOlderOneAndTheSameAreRefused) {
    expect_refused(firmware(1, 1), Result::not_newer);
    expect_refused(firmware(2, 1), Result::not_newer);
}

TEST_F(Receiving, OneOfAnotherBoardOrSlotIsRefused) {
    expect_refused(firmware(2, 1, kOtherBoards), Result::other_board);
    expect_refused(firmware(3, 0), Result::bad_firmware);
}

TEST_F(Receiving, WhatIsNoFirmwareOrPartOfOneIsRefused) {
    expect_refused(Bytes(600, 0xA5), Result::bad_firmware);
    Bytes cut = firmware(3, 1);
    cut.resize(cut.size() - 4);
    expect_refused(cut, Result::bad_firmware);
    Bytes longer = firmware(3, 1);
    longer.resize(longer.size() + 4);
    expect_refused(longer, Result::bad_firmware);
    expect_refused(Bytes(8, 0), Result::bad_firmware);
    EXPECT_EQ(send(receiver, firmware(3, 1)), Result::done) << "the next one goes well";
}

TEST_F(Receiving, WhatTheSenderMeantIsHeldAgainstWhatCame) {
    EXPECT_EQ(send(receiver, firmware(3, 1), 1), Result::wrong_check);
    EXPECT_EQ(receiver.phase(), Phase::failed);
    begin();
    const Bytes bytes = firmware(3, 1);
    EXPECT_EQ(receiver.write(0, piece(bytes, 0, 120)), Result::done);
    EXPECT_EQ(receiver.finish(124, base::crc32(piece(bytes, 0, 120))), Result::wrong_check);
    EXPECT_EQ(receiver.finish(120, 0), Result::no_upload);
    EXPECT_EQ(boots(), "0");
}

TEST_F(Receiving, PiecesComeInOrderAndARepeatIsTaken) {
    const Bytes bytes = firmware(3, 1);
    EXPECT_EQ(receiver.write(0, piece(bytes, 0, 8)), Result::no_upload);
    EXPECT_EQ(receiver.finish(0, 0), Result::no_upload);
    ASSERT_EQ(receiver.begin(kFew), Result::done);
    EXPECT_EQ(receiver.write(0, piece(bytes, 0, 8)), Result::busy) << "it still erases";
    EXPECT_EQ(receiver.finish(8, 0), Result::busy);
    poll_while(receiver, Phase::erasing);
    EXPECT_EQ(receiver.write(4, piece(bytes, 4, 8)), Result::bad_offset);
    EXPECT_EQ(receiver.write(0, piece(bytes, 0, 8)), Result::done);
    EXPECT_EQ(receiver.write(0, piece(bytes, 0, 8)), Result::done) << "the accept was lost";
    EXPECT_EQ(receiver.write(0, piece(bytes, 8, 8)), Result::bad_offset) << "not the same";
    EXPECT_EQ(receiver.write(8, piece(bytes, 8, 8)), Result::busy) << "the piece before is not programmed";
    for (int i = 0; i < 10; ++i) receiver.poll();
    EXPECT_EQ(receiver.write(8, piece(bytes, 8, 8)), Result::done);
    EXPECT_EQ(receiver.received(), 16U);
}

TEST_F(Receiving, PiecesOfAnotherSizeAreRefused) {
    begin();
    const Bytes bytes(200, 0);
    EXPECT_EQ(receiver.write(0, piece(bytes, 0, 0)), Result::bad_length);
    EXPECT_EQ(receiver.write(0, piece(bytes, 0, 6)), Result::bad_length);
    EXPECT_EQ(receiver.write(0, piece(bytes, 0, 124)), Result::bad_length);
}

TEST_F(Receiving, MoreThanThereIsRoomForIsRefused) {
    EXPECT_EQ(receiver.begin(layout.capacity() + 4), Result::no_space);
    EXPECT_EQ(receiver.begin(0), Result::no_space);
    EXPECT_EQ(receiver.phase(), Phase::idle);
    EXPECT_EQ(send(receiver, Bytes(layout.capacity(), 0)), Result::bad_firmware)
        << "as much as there is room for";
    begin();
    const Bytes bytes = firmware(3, 1);
    EXPECT_EQ(receiver.write(0, piece(bytes, 0, 120)), Result::done);
    for (int i = 0; i < 10; ++i) receiver.poll();
    EXPECT_EQ(receiver.write(120, piece(bytes, 120, 84)), Result::no_space);
    EXPECT_EQ(receiver.write(120, piece(bytes, 120, 80)), Result::done) << "what was announced";
    finish(device);
    EXPECT_EQ(boots(), "0");
}

TEST_F(Receiving, FinishMayBeRepeated) {
    const Bytes bytes = firmware(3, 1);
    ASSERT_EQ(send(receiver, bytes), Result::done);
    const auto length = static_cast<std::uint32_t>(bytes.size());
    EXPECT_EQ(receiver.finish(length, base::crc32(bytes)), Result::done);
    EXPECT_EQ(receiver.finish(length, 1), Result::no_upload);
    receiver.abandon();
    EXPECT_EQ(receiver.phase(), Phase::done) << "it is stored";
}

TEST_F(Receiving, OneThatIsGivenUpIsNotStarted) {
    begin();
    receiver.abandon();
    EXPECT_EQ(receiver.phase(), Phase::idle);
    EXPECT_EQ(receiver.write(0, piece(firmware(3, 1), 0, 8)), Result::no_upload);
    EXPECT_EQ(boots(), "0");
}

TEST_F(Receiving, ALastPieceOfHalfAUnitIsFilledUp) {
    const Shape wide = shapes().back();
    sim::SimStorage eight(wide.geometry);
    install(eight, wide.layout, 0, firmware(2, 0), kConfirmed);
    Receiver other(eight, wide.layout, kBoard, 0);
    ASSERT_EQ(firmware(3, 1).size() % 8, 4U);
    EXPECT_EQ(send(other, firmware(3, 1)), Result::done);
    EXPECT_EQ(update::boots(eight, wide.layout), "1 on trial");
}

TEST_F(Receiving, AfterAPieceOfHalfAUnitNothingCanFollow) {
    const Shape wide = shapes().back();
    sim::SimStorage eight(wide.geometry);
    Receiver other(eight, wide.layout, kBoard, 0);
    ASSERT_EQ(other.begin(kFew), Result::done);
    poll_while(other, Phase::erasing);
    EXPECT_EQ(other.write(0, piece(firmware(3, 1), 0, 4)), Result::done);
    for (int i = 0; i < 10; ++i) other.poll();
    EXPECT_EQ(other.write(4, piece(firmware(3, 1), 4, 4)), Result::bad_offset);
}

TEST_F(Receiving, AStorageThatSaysNoFailsTheUpdate) {
    const std::uint64_t before = device.operations();
    sim::SimStorage counted(device);
    Receiver whole(counted, layout, kBoard, 0);
    ASSERT_EQ(send(whole, firmware(3, 1)), Result::done);
    const std::uint64_t all = counted.operations() - before;
    for (std::uint64_t i = 0; i < all; ++i) {
        sim::SimStorage bad(device);
        bad.fail_operation(i);
        Receiver attempt(bad, layout, kBoard, 0);
        EXPECT_NE(send(attempt, firmware(3, 1)), Result::done) << i;
        EXPECT_EQ(attempt.phase(), Phase::failed) << i;
        EXPECT_EQ(update::boots(bad, layout), "0") << i;
        EXPECT_EQ(send(attempt, firmware(3, 1)), Result::done) << "the next one goes well";
    }
}

TEST_F(Receiving, AWornBitIsFoundByReadingBack) {
    const Bytes bytes = firmware(3, 1);
    for (std::uint32_t at = 0; at < bytes.size(); at += 37) {
        sim::SimStorage worn(device);
        worn.wear_out(layout.header(1) + at, 3);
        Receiver attempt(worn, layout, kBoard, 0);
        const bool is_one = (bytes[at] & 8U) != 0;
        EXPECT_EQ(send(attempt, bytes), is_one ? Result::done : Result::wrong_check) << at;
    }
}

TEST_F(Receiving, AConfirmationThatFailsIsTriedAgain) {
    ASSERT_EQ(send(receiver, firmware(3, 1)), Result::done);
    ASSERT_EQ(boots(), "1 on trial");
    Receiver trial(device, layout, kBoard, 1);
    device.fail_operation(0);
    trial.confirm();
    for (int i = 0; i < 10; ++i) trial.poll();
    EXPECT_FALSE(trial.is_confirmed());
    trial.confirm();
    for (int i = 0; i < 10; ++i) trial.poll();
    EXPECT_TRUE(trial.is_confirmed());
}

}  // namespace
}  // namespace nplc::update
