// Several clients on one MacTalk line: their messages never mix, and each hears its own answer.
#include "shared_line/shared_line.h"

#include <gtest/gtest.h>

#include <string>

namespace nplc::boards {
namespace {

namespace mactalk = protocol::mactalk;
using mactalk::Kind;
using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;

constexpr std::uint8_t kGateway = 128;
constexpr std::uint8_t kMotor = 1;

struct Clients final : hal_linux::ByteServer {
    const std::string& name() const override { return name_; }
    bool has_client() override { return true; }
    std::size_t seats() const override { return 2; }
    std::uint64_t visit(std::size_t seat) override { return visits[seat]; }
    bool has_left(std::size_t seat) override { return left[seat]; }
    void note_message(std::size_t seat) override { ++messages[seat]; }
    std::size_t read_seat(std::size_t seat, std::span<std::uint8_t> out) override {
        const std::size_t count = std::min(out.size(), sends[seat].size());
        std::copy_n(sends[seat].begin(), count, out.begin());
        sends[seat].erase(sends[seat].begin(), sends[seat].begin() + static_cast<std::ptrdiff_t>(count));
        return count;
    }
    void write_seat(std::size_t seat, std::span<const std::uint8_t> bytes) override {
        hears[seat].insert(hears[seat].end(), bytes.begin(), bytes.end());
    }
    int descriptor() const override { return -1; }

    std::array<std::uint64_t, 2> visits{1, 2};
    std::array<bool, 2> left{};
    std::array<unsigned, 2> messages{};
    std::array<Bytes, 2> sends;
    std::array<Bytes, 2> hears;
    std::string name_ = "clients";
};

template <class Encoded>
Bytes bytes(const Encoded& encoded) {
    return {encoded.view().begin(), encoded.view().end()};
}

Bytes read_of(std::uint8_t reg) {
    return bytes(mactalk::encode({.kind = Kind::read, .address = kGateway, .reg = reg}));
}
Bytes write_of(std::uint8_t reg) {
    return bytes(
        mactalk::encode({.kind = Kind::write, .address = kGateway, .reg = reg, .length = 4, .value = 1}));
}
Bytes reply_of(std::uint8_t reg, std::array<std::uint8_t, 4> data = {}) {
    return bytes(mactalk::encode_registers(reg, data));
}
/// COMMAND is 48; run 1, stop 2, safe 3, hold 6 (firmware/gateway/REGISTERS.md).
Bytes order(std::uint32_t command) {
    return bytes(mactalk::encode(
        {.kind = Kind::write, .address = kGateway, .reg = 48, .length = 4, .value = command}));
}
constexpr std::uint32_t kRun = 1;
constexpr std::uint32_t kStop = 2;
constexpr std::uint32_t kSafe = 3;
constexpr std::uint32_t kHold = 6;
/// RESULT, 31: too_late, 19, of the register in bits 15..8.
Bytes too_late(std::uint8_t reg) {
    return reply_of(31, {19, reg, 0, 0});
}

Bytes operator+(Bytes first, const Bytes& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

struct SharedLineTest : testing::Test {
    Bytes on_the_line() { return line.to_line(now, {kGateway, kMotor}); }
    void answer(const Bytes& answer) { line.from_line(answer, now); }
    void look() { EXPECT_EQ(on_the_line(), Bytes()); }

    Clients clients;
    SharedLine line{clients};
    SharedLine::Time now{0};
};

TEST_F(SharedLineTest, MessagesInPiecesDoNotMix) {
    const Bytes first = read_of(16);
    const Bytes second = read_of(17);
    for (std::size_t i = 0; i + 1 < first.size(); ++i) {
        clients.sends[0] = {first[i]};
        clients.sends[1] = {second[i]};
        EXPECT_TRUE(on_the_line().empty());
    }
    clients.sends[0] = {first.back()};
    clients.sends[1] = {second.back()};
    EXPECT_EQ(on_the_line(), first);
    EXPECT_TRUE(on_the_line().empty()) << "until the first is answered";
    answer(reply_of(16));
    EXPECT_EQ(on_the_line(), second);
    answer(reply_of(17));
    EXPECT_EQ(clients.hears[0], reply_of(16));
    EXPECT_EQ(clients.hears[1], reply_of(17));
}

TEST_F(SharedLineTest, LongWritesPassAsTheyAre) {
    const Bytes piece(128, 0x11);
    const Bytes message = bytes(mactalk::encode_long_write(kGateway, 61, piece));
    clients.sends[1] = message;
    EXPECT_EQ(on_the_line(), message);
}

TEST_F(SharedLineTest, NoiseOfOneClientDoesNotReachTheOther) {
    clients.sends[0] = {0x52, 0x52, 0x52, 0x80};
    clients.sends[1] = read_of(5);
    EXPECT_EQ(on_the_line(), read_of(5));
}

TEST_F(SharedLineTest, ARefusedMessageKeepsTheLineForAWhileOrUntilItsClientAsksAgain) {
    clients.sends[0] = write_of(16);
    clients.sends[1] = read_of(17);
    EXPECT_EQ(on_the_line(), write_of(16));
    now += SharedLine::kLongestAnswer - 1ms;
    EXPECT_TRUE(on_the_line().empty());
    clients.sends[0] = read_of(31);
    EXPECT_EQ(on_the_line(), read_of(31)) << "why it was refused";
    answer(reply_of(31));
    EXPECT_EQ(on_the_line(), read_of(17));
    now += SharedLine::kLongestAnswer;
    clients.sends[0] = read_of(1);
    EXPECT_EQ(on_the_line(), read_of(1)) << "the other one has waited long enough";
}

TEST_F(SharedLineTest, AMessageForNobodyKeepsNothing) {
    const Bytes wrong = bytes(mactalk::encode({.kind = Kind::read, .address = 77, .reg = 5}));
    for (int i = 0; i < 3; ++i) clients.sends[0].insert(clients.sends[0].end(), wrong.begin(), wrong.end());
    EXPECT_EQ(on_the_line(), wrong);
    clients.sends[1] = read_of(17);
    EXPECT_EQ(on_the_line(), read_of(17)) << "at once, and before the other one's next";
}

TEST_F(SharedLineTest, WhomNobodyAnswersIsWaitedForOnlyBriefly) {
    for (int i = 0; i < 9; ++i) {
        const Bytes refused = write_of(16);
        clients.sends[0].insert(clients.sends[0].end(), refused.begin(), refused.end());
    }
    EXPECT_EQ(on_the_line(), write_of(16));
    EXPECT_EQ(on_the_line(), write_of(16)) << "may ask once more";
    clients.sends[1] = read_of(17);
    now += SharedLine::kBriefly + 20ms;  // 16 characters take 8.3 ms at 19200 baud
    EXPECT_EQ(on_the_line(), read_of(17));
    answer(reply_of(17));
    EXPECT_EQ(on_the_line(), write_of(16));
    EXPECT_EQ(on_the_line(), write_of(16));
    clients.sends[1] = read_of(18);
    now += SharedLine::kBriefly + 20ms;
    EXPECT_EQ(on_the_line(), read_of(18));
}

TEST_F(SharedLineTest, ClientsTakeTurns) {
    const Bytes accept = bytes(mactalk::encode_accept());
    clients.sends[0] = write_of(50) + write_of(51) + write_of(52);
    EXPECT_EQ(on_the_line(), write_of(50));
    clients.sends[1] = read_of(17);
    EXPECT_EQ(on_the_line(), write_of(51)) << "a follow-up of the same client";
    answer(accept);
    EXPECT_EQ(on_the_line(), read_of(17));
    answer(reply_of(17));
    EXPECT_EQ(on_the_line(), write_of(52));
}

TEST_F(SharedLineTest, AReadThatItsClientHasNotWaitedForIsDropped) {
    clients.sends[0] = write_of(50);
    EXPECT_EQ(on_the_line(), write_of(50));
    clients.sends[1] = read_of(16) + read_of(17);
    look();
    clients.sends[1] = read_of(18);
    look();
    answer(bytes(mactalk::encode_accept()));
    EXPECT_EQ(on_the_line(), read_of(18));
    answer(reply_of(18));
    look();
}

TEST_F(SharedLineTest, AStopEndsAnothersTurnAndGoesBeforeAllThatWaits) {
    for (const std::uint32_t command : {kStop, kSafe, kHold}) {
        clients.sends[0] = write_of(16) + write_of(16);
        EXPECT_EQ(on_the_line(), write_of(16));
        clients.sends[1] = order(command);
        EXPECT_EQ(on_the_line(), order(command));
        answer(bytes(mactalk::encode_accept()));
        EXPECT_EQ(clients.hears[1], bytes(mactalk::encode_accept()));
        clients.hears[1].clear();
        EXPECT_TRUE(clients.hears[0].empty());
        look();
    }
}

TEST_F(SharedLineTest, AStopIsTakenHoweverMuchItsClientSentBefore) {
    Bytes before;
    for (int i = 0; i < 40; ++i) before = before + write_of(16);
    clients.sends[0] = before + order(kStop);
    EXPECT_EQ(on_the_line(), order(kStop));
    EXPECT_EQ(clients.messages[0], 41U);
}

TEST_F(SharedLineTest, AStopIsNotCutShortByAHold) {
    clients.sends[0] = order(kHold);
    EXPECT_EQ(on_the_line(), order(kHold));
    clients.sends[0] = order(kHold);
    clients.sends[1] = order(kStop);
    look();
    now = line.next_turn(now);
    EXPECT_LE(now, 100ms) << "a hold that is refused is not waited for long";
    EXPECT_EQ(on_the_line(), order(kStop)) << "and a stop goes before the next one";
    answer(bytes(mactalk::encode_accept()));
    EXPECT_EQ(on_the_line(), order(kHold));
}

TEST_F(SharedLineTest, WhatWasSentBeforeAStopIsRefusedAndItsClientIsToldWhy) {
    clients.sends[0] = read_of(17);
    EXPECT_EQ(on_the_line(), read_of(17));
    clients.sends[0] = order(kRun);
    clients.sends[1] = order(kRun) + order(kStop) + write_of(50);
    EXPECT_EQ(on_the_line(), order(kStop));
    answer(bytes(mactalk::encode_accept()));
    EXPECT_EQ(on_the_line(), write_of(50)) << "it was sent after the stop";
    answer(bytes(mactalk::encode_accept()));
    look();
    clients.sends[0] = read_of(31);
    look();
    EXPECT_EQ(clients.hears[0], too_late(48));
    clients.sends[0] = write_of(50) + read_of(31);
    EXPECT_EQ(on_the_line(), write_of(50));
    EXPECT_EQ(on_the_line(), read_of(31)) << "of that one the gateway tells";
}

TEST_F(SharedLineTest, AWriteThatAStopCutShortIsNotTakenForDone) {
    clients.sends[0] = order(kRun);
    EXPECT_EQ(on_the_line(), order(kRun));
    clients.sends[1] = order(kStop);
    EXPECT_EQ(on_the_line(), order(kStop));
    answer(bytes(mactalk::encode_accept()));
    clients.sends[0] = read_of(31);
    look();
    EXPECT_EQ(clients.hears[0], too_late(48));
}

/// It may be stored: the gateway knows.
TEST_F(SharedLineTest, AChangeOfSetPointsThatAStopCutShortIsNotSaidToBeLost) {
    constexpr std::uint8_t kSetPointWrite = 91;
    clients.sends[0] = bytes(mactalk::encode_long_write(kGateway, kSetPointWrite, Bytes(16, 1)));
    EXPECT_EQ(on_the_line(), bytes(mactalk::encode_long_write(kGateway, kSetPointWrite, Bytes(16, 1))));
    clients.sends[1] = order(kStop);
    EXPECT_EQ(on_the_line(), order(kStop));
    answer(bytes(mactalk::encode_accept()));
    clients.sends[0] = read_of(31);
    EXPECT_EQ(on_the_line(), read_of(31));
}

TEST_F(SharedLineTest, WhatMayHaveWaitedTooLongToBeReadIsRefusedButForReadsAndStops) {
    look();
    now += SharedLine::kLongestUnread;
    clients.sends[0] = order(kRun);
    EXPECT_EQ(on_the_line(), order(kRun)) << "just in time";
    answer(bytes(mactalk::encode_accept()));
    now += SharedLine::kLongestUnread + 1ms;
    const Bytes motor =
        bytes(mactalk::encode({.kind = Kind::write, .address = kMotor, .reg = 2, .length = 2, .value = 2}));
    clients.sends[0] = order(kRun) + motor + read_of(16);
    clients.sends[1] = order(kStop);
    EXPECT_EQ(on_the_line(), order(kStop));
    answer(bytes(mactalk::encode_accept()));
    EXPECT_EQ(on_the_line(), read_of(16));
    answer(reply_of(16));
    clients.sends[0] = order(kRun);
    EXPECT_EQ(on_the_line(), order(kRun)) << "the next one is fresh";
}

TEST_F(SharedLineTest, WhatWaitsForOthersTooLongIsRefused) {
    clients.sends[0] = write_of(16);
    EXPECT_EQ(on_the_line(), write_of(16));
    clients.sends[1] = order(kRun);
    look();
    now += SharedLine::kLongestAnswer;
    look();
    clients.sends[1] = read_of(31);
    look();
    EXPECT_EQ(clients.hears[1], too_late(48));
}

TEST_F(SharedLineTest, TheSendersOfWhatIsOldAreNotDisturbedByOneThatNeverPauses) {
    Bytes flood;
    while (flood.size() < 20'000) flood = flood + read_of(16);
    look();
    now += SharedLine::kLongestUnread + 1ms;
    clients.sends[0] = flood + order(kRun);
    Bytes last;
    for (int i = 0; i < 20; ++i) {
        EXPECT_NE(last = on_the_line(), order(kRun)) << "it waited behind the others, in the same buffer";
        answer(reply_of(16));
    }
}

TEST_F(SharedLineTest, WhatAClientSentThatHasLeftIsRefusedButForStops) {
    clients.sends[0] = order(kRun);
    clients.left[0] = true;
    look();
    clients.sends[0] = order(kRun) + order(kStop);
    EXPECT_EQ(on_the_line(), order(kStop));
}

TEST_F(SharedLineTest, AStopIsCarriedOutThoughItsClientsSeatIsAnothersByNow) {
    clients.sends[1] = order(kHold);
    EXPECT_EQ(on_the_line(), order(kHold));
    clients.sends[0] = order(kStop);
    look();
    clients.visits[0] = 3;
    look();
    now = line.next_turn(now);
    EXPECT_EQ(on_the_line(), order(kStop));
    answer(bytes(mactalk::encode_accept()));
    EXPECT_TRUE(clients.hears[0].empty());
}

TEST_F(SharedLineTest, WantsToLookOftenEnoughToTellHowOldAMessageIs) {
    look();
    EXPECT_EQ(line.next_turn(now), SharedLine::kBetweenLooks);
    EXPECT_LT(SharedLine::kBetweenLooks, SharedLine::kLongestUnread);
}

TEST_F(SharedLineTest, WhatAClientLeftBehindIsDropped) {
    for (int i = 0; i < 4; ++i) {
        const Bytes refused = write_of(16);
        clients.sends[0].insert(clients.sends[0].end(), refused.begin(), refused.end());
    }
    EXPECT_EQ(on_the_line(), write_of(16));
    clients.visits[0] = 3;  // another one came in its place
    clients.sends[1] = read_of(17);
    EXPECT_TRUE(on_the_line().empty()) << "the answer may be on its way";
    answer(bytes(mactalk::encode_accept()));
    EXPECT_TRUE(clients.hears[0].empty()) << "not for the new one";
    EXPECT_EQ(on_the_line(), read_of(17));
    answer(reply_of(17));
    EXPECT_TRUE(on_the_line().empty());
}

TEST_F(SharedLineTest, WhatIsNeverAnsweredKeepsNothing) {
    clients.sends[0] = bytes(mactalk::encode({.kind = Kind::reset, .address = 1}));
    clients.sends[1] = read_of(17);
    EXPECT_EQ(on_the_line().size(), 7U);
    EXPECT_EQ(on_the_line(), read_of(17));
}

TEST_F(SharedLineTest, SamplesOfEitherLengthEndWithASilence) {
    clients.sends[0] = bytes(mactalk::encode({.kind = Kind::read_samples, .address = 1}));
    clients.sends[1] = read_of(17);
    EXPECT_FALSE(on_the_line().empty());
    answer(bytes(mactalk::encode_samples(Bytes(16, 3))));
    EXPECT_TRUE(on_the_line().empty());
    now += 20ms;
    EXPECT_EQ(on_the_line(), read_of(17));
}

/// With one seat for all clients of the axis.
struct SeatedLineTest : SharedLineTest {
    Bytes seated() { return line_with_seat.to_line(now, {kGateway, kMotor}); }
    Bytes answered(const Bytes& answer) {
        line_with_seat.from_line(answer, now);
        return seated();
    }
    /// RESULT, 31: seat_taken, 22, of the register in bits 15..8, and the detail.
    static Bytes seat_taken(std::uint8_t reg, std::uint8_t detail = 0) {
        return reply_of(31, {22, reg, detail, 0});
    }

    faces::Seat seat;
    SharedLine line_with_seat{clients, &seat};
};

TEST_F(SeatedLineTest, OneClientOperatesAndAllReadAndStop) {
    clients.sends[0] = order(kRun);
    EXPECT_EQ(seated(), order(kRun));
    EXPECT_EQ(answered(bytes(mactalk::encode_accept())), Bytes());
    clients.sends[1] = order(kRun) + read_of(31);
    EXPECT_EQ(seated(), Bytes());
    EXPECT_EQ(clients.hears[1], seat_taken(48));
    clients.sends[1] = read_of(16);
    EXPECT_EQ(seated(), read_of(16));
    EXPECT_EQ(answered(reply_of(16)), Bytes());
    clients.sends[1] = order(kStop);
    EXPECT_EQ(seated(), order(kStop));
}

/// UPLOAD_BYTES (58) comes before every command of nanoctl, TABLE_POINTER (60) before reading a table back,
/// SET_POINT_POINTER (89) before reading what can be set.
TEST_F(SeatedLineTest, WhatOnlyPreparesNeedsNoSeat) {
    clients.sends[0] = order(kRun);
    EXPECT_EQ(seated(), order(kRun));
    EXPECT_EQ(answered(bytes(mactalk::encode_accept())), Bytes());
    for (const std::uint8_t reg : {std::uint8_t{58}, std::uint8_t{60}, std::uint8_t{89}}) {
        clients.sends[1] = write_of(reg);
        EXPECT_EQ(seated(), write_of(reg));
        EXPECT_EQ(answered(bytes(mactalk::encode_accept())), Bytes());
    }
}

TEST_F(SeatedLineTest, TheSeatIsFreeWhenItsClientHasLeft) {
    clients.sends[0] = order(kRun);
    EXPECT_EQ(seated(), order(kRun));
    EXPECT_EQ(answered(bytes(mactalk::encode_accept())), Bytes());
    clients.left[0] = true;
    clients.sends[1] = order(kRun);
    EXPECT_EQ(seated(), order(kRun));
}

TEST_F(SeatedLineTest, AnotherClientInThePlaceOperatesOnItsOwn) {
    clients.sends[0] = order(kRun);
    EXPECT_EQ(seated(), order(kRun));
    EXPECT_EQ(answered(bytes(mactalk::encode_accept())), Bytes());
    clients.visits[0] = 3;
    EXPECT_EQ(seated(), Bytes());
    EXPECT_EQ(seat.holder(), nullptr);
}

TEST_F(SeatedLineTest, PersonsWaitWhileThePlantOperates) {
    EXPECT_EQ(seat.take({faces::Seat::new_number(), faces::Side::plant, "PLC"},
                        base::Instant(std::chrono::duration_cast<base::Microseconds>(now))),
              faces::Seat::Verdict::granted);
    clients.sends[0] = order(kRun) + read_of(31);
    EXPECT_EQ(seated(), Bytes());
    EXPECT_EQ(clients.hears[0], seat_taken(48));
    clients.sends[0] = order(kSafe);
    EXPECT_EQ(seated(), order(kSafe));
}

/// A port that asks for a password. PASSWORD_STATE is 10, PASSWORD 11, no_password 30 (REGISTERS.md).
struct GuardedLineTest : SharedLineTest {
    Bytes guarded() { return line_with_password.to_line(now, {kGateway, kMotor}); }
    Bytes hears(std::size_t client) { return std::exchange(clients.hears[client], {}); }
    static Bytes password(std::string text) {
        text.resize((text.size() + 3) / 4 * 4, '\0');
        return bytes(mactalk::encode_long_write(kGateway, 11, Bytes(text.begin(), text.end())));
    }
    static Bytes no_password(std::uint8_t reg) { return reply_of(31, {30, reg, 0, 0}); }
    static Bytes state(std::uint8_t value) { return reply_of(10, {value, 0, 0, 0}); }
    static const inline Bytes kAccept = bytes(mactalk::encode_accept());

    SharedLine line_with_password{clients, nullptr, "correct horse"};
};

TEST_F(GuardedLineTest, WithoutItOnlyReadsStopsAndWhatPrepares) {
    for (const Bytes& message : {read_of(16), order(kStop), order(kSafe), order(kHold), write_of(58)}) {
        clients.sends[0] = message;
        EXPECT_EQ(guarded(), message);
        line_with_password.from_line(kAccept, now);
        now += 2s;
        EXPECT_EQ(guarded(), Bytes());
    }
    clients.hears[0].clear();
    const Bytes of_motor =
        bytes(mactalk::encode({.kind = Kind::write, .address = kMotor, .reg = 2, .length = 2, .value = 1}));
    const Bytes motor_reset = bytes(mactalk::encode({.kind = Kind::reset, .address = kMotor}));
    for (const auto& [message, reg] :
         {std::pair{order(kRun), 48}, {write_of(200), 200}, {of_motor, 2}, {motor_reset, 0}}) {
        clients.sends[0] = message + read_of(31);
        EXPECT_EQ(guarded(), Bytes());
        EXPECT_EQ(hears(0), no_password(static_cast<std::uint8_t>(reg)));
    }
}

TEST_F(GuardedLineTest, WithoutItHowLongAMessageWaitedDoesNotMatter) {
    clients.sends[1] = read_of(16);
    EXPECT_EQ(guarded(), read_of(16));
    clients.sends[0] = order(kRun) + read_of(31);
    EXPECT_EQ(guarded(), Bytes());
    now += 2s;
    EXPECT_EQ(guarded(), Bytes());
    EXPECT_EQ(hears(0), no_password(48));
}

TEST_F(GuardedLineTest, WhoHasGivenItOperatesUntilHeLeaves) {
    clients.sends[0] = read_of(10);
    EXPECT_EQ(guarded(), Bytes());
    EXPECT_EQ(hears(0), state(1));
    clients.sends[0] = password("correct horse");
    EXPECT_EQ(guarded(), Bytes()) << "it never reaches the gateway";
    EXPECT_EQ(hears(0), kAccept);
    clients.sends[0] = read_of(10);
    EXPECT_EQ(guarded(), Bytes());
    EXPECT_EQ(hears(0), state(2));
    clients.sends[1] = order(kRun) + read_of(31);
    EXPECT_EQ(guarded(), Bytes());
    EXPECT_EQ(hears(1), no_password(48)) << "it is the other client's";
    clients.sends[0] = order(kRun);
    EXPECT_EQ(guarded(), order(kRun));
    line_with_password.from_line(kAccept, now);
    clients.hears[0].clear();
    clients.visits[0] = 3;
    clients.sends[0] = order(kRun) + read_of(31);
    EXPECT_EQ(guarded(), Bytes());
    EXPECT_EQ(hears(0), no_password(48));
}

TEST_F(GuardedLineTest, AnotherOneIsNone) {
    clients.sends[0] = password("correct horse");
    EXPECT_EQ(guarded(), Bytes());
    EXPECT_EQ(hears(0), kAccept);
    unsigned wrong = 0;
    for (const char* other : {"correct hors", "correct horse battery", "Correct horse", "12345678", ""}) {
        clients.sends[0] = (*other == '\0' ? write_of(11) : password(other)) + read_of(31) + read_of(10);
        EXPECT_EQ(guarded(), Bytes());
        EXPECT_EQ(hears(0), state(1) + no_password(11)) << other;
        EXPECT_EQ(line_with_password.wrong_passwords(), ++wrong);
    }
    clients.sends[0] = order(kRun);
    EXPECT_EQ(guarded(), Bytes());
}

/// For another unit on the line, and where none is asked for, the numbers are anybody's.
TEST_F(GuardedLineTest, OnlyTheGatewaysRegistersAreMeant) {
    const Bytes of_motor = bytes(mactalk::encode({.kind = Kind::read, .address = kMotor, .reg = 10}));
    clients.sends[0] = of_motor;
    EXPECT_EQ(guarded(), of_motor);
    clients.sends[0] = read_of(10);
    EXPECT_EQ(on_the_line(), read_of(10));
}

}  // namespace
}  // namespace nplc::boards
