// Several clients of a user's port, without sockets and without a gateway: turns, stops, refusals, places.
#include "listener_bench.h"

namespace nplc::boards {
namespace {

TEST_F(ListenerTest, MessagesInPiecesDoNotMix) {
    const Bytes first = read_of(16);
    const Bytes second = read_of(17);
    for (std::size_t i = 0; i + 1 < first.size(); ++i) {
        send(0, {first[i]});
        send(1, {second[i]});
        EXPECT_EQ(handed(), Bytes());
    }
    send(0, {first.back()});
    send(1, {second.back()});
    EXPECT_EQ(handed(), first);
    EXPECT_EQ(handed(), Bytes()) << "until the first is answered";
    answer(reply_of(16));
    EXPECT_EQ(handed(), second);
    answer(reply_of(17));
    EXPECT_EQ(heard(0), reply_of(16));
    EXPECT_EQ(heard(1), reply_of(17));
}

TEST_F(ListenerTest, LongWritesPassAsTheyAre) {
    const Bytes message = bytes(mactalk::encode_long_write(kGateway, 61, Bytes(128, 0x11)));
    send(1, message);
    EXPECT_EQ(handed(), message);
}

TEST_F(ListenerTest, NoiseOfOneClientDoesNotReachTheOther) {
    send(0, {0x52, 0x52, 0x52, 0x80});
    send(1, read_of(5));
    EXPECT_EQ(handed(), read_of(5));
}

/// A line that doubles characters is common in the field.
TEST_F(ListenerTest, AStopIsTakenBehindStartBytesOfAnotherMessage) {
    send(0, Bytes{0x52, 0x52, 0x52} + order(kStop));
    EXPECT_EQ(handed(), order(kStop));
}

TEST_F(ListenerTest, ARefusedMessageKeepsNobodyWaitingAndItsClientIsToldWhyWhateverOthersWrite) {
    send(0, write_of(16));
    send(1, write_of(50));
    EXPECT_EQ(handed(), write_of(16));
    refuse(4, 16);
    EXPECT_EQ(handed(), write_of(50));
    answer(kAccept, 50 << 8);
    send(0, read_of(31));
    send(1, read_of(31));
    EXPECT_EQ(handed(), Bytes());
    EXPECT_EQ(heard(0), reply_of(31, {4, 16, 0, 0}));
    EXPECT_EQ(heard(1), kAccept + reply_of(31, {0, 50, 0, 0}));
}

/// Shows a client that a reset has been carried out.
TEST_F(ListenerTest, AfterARestartTheGatewaysResultCounts) {
    send(0, write_of(50));
    EXPECT_EQ(handed(), write_of(50));
    answer(kAccept, 50 << 8);
    send(0, write_of(51));
    EXPECT_EQ(handed(), write_of(51));
    listener.restarted();
    send(0, read_of(31));
    EXPECT_EQ(handed(), read_of(31));
}

TEST_F(ListenerTest, AMessageForNobodyKeepsNothing) {
    const Bytes wrong = bytes(mactalk::encode({.kind = Kind::read, .address = 77, .reg = 5}));
    send(0, wrong + write_of(16));
    EXPECT_EQ(handed(), write_of(16));
}

TEST_F(ListenerTest, ClientsTakeTurns) {
    send(0, write_of(50) + write_of(51) + write_of(52));
    EXPECT_EQ(handed(), write_of(50));
    send(1, read_of(17));
    EXPECT_EQ(handed(), write_of(51)) << "in the place of the one before, as on a serial line";
    answer(kAccept);
    EXPECT_EQ(handed(), read_of(17));
    answer(reply_of(17));
    EXPECT_EQ(handed(), write_of(52));
}

TEST_F(ListenerTest, WhatTakesLongIsWaitedForUntilOthersHaveWaitedLongEnough) {
    send(0, write_of(50));
    EXPECT_EQ(handed(), write_of(50));
    now += Listener::kLongestAnswer;
    EXPECT_EQ(handed(), Bytes()) << "nobody else waits";
    send(1, read_of(17));
    EXPECT_EQ(handed(), read_of(17));
}

TEST_F(ListenerTest, AReadThatItsClientHasNotWaitedForIsDropped) {
    send(0, write_of(50));
    EXPECT_EQ(handed(), write_of(50));
    send(1, read_of(16) + read_of(17));
    EXPECT_EQ(handed(), Bytes());
    send(1, read_of(18));
    EXPECT_EQ(handed(), Bytes());
    answer(kAccept);
    EXPECT_EQ(handed(), read_of(18));
    answer(reply_of(18));
    EXPECT_EQ(handed(), Bytes());
}

TEST_F(ListenerTest, WhoDoesNotReadIsNotAnsweredMore) {
    for (std::size_t unsent = 0; unsent < Client::kMuchUnsent; unsent += reply_of(16).size()) {
        send(0, read_of(16));
        EXPECT_EQ(handed(), read_of(16));
        answer(reply_of(16));
    }
    send(0, read_of(17));
    EXPECT_EQ(handed(), Bytes());
    EXPECT_NE(heard(0), Bytes());
    EXPECT_EQ(handed(), read_of(17));
}

TEST_F(ListenerTest, AStopEndsAnothersTurnAndGoesBeforeAllThatWaits) {
    for (const std::uint32_t command : {kStop, kSafe, kHold}) {
        send(0, write_of(16) + write_of(16));
        EXPECT_EQ(handed(), write_of(16));
        send(1, order(command));
        EXPECT_EQ(handed(), order(command));
        answer(kAccept);
        EXPECT_EQ(heard(1), kAccept);
        EXPECT_EQ(heard(0), Bytes());
        EXPECT_EQ(handed(), Bytes());
    }
}

TEST_F(ListenerTest, AStopIsTakenHoweverMuchItsClientSentBefore) {
    Bytes before;
    for (int i = 0; i < 40; ++i) before = before + write_of(16);
    send(0, before + order(kStop));
    EXPECT_EQ(handed(), order(kStop));
}

/// 300 of them kept a stopped gateway busy for 18 s.
TEST_F(ListenerTest, HoldsOfClientsThatComeAndGoAreCarriedOutOnce) {
    constexpr Listener::Id kFirst = 1000;
    for (Listener::Id i = 0; i < 300; ++i) {
        listener.connected(kFirst + i, {}, now);
        give(kFirst + i, order(kHold));
        listener.gone(kFirst + i, now);
    }
    EXPECT_EQ(handed(), order(kHold));
    refuse(6, 48);
    send(0, order(kRun));
    EXPECT_EQ(handed(), order(kRun));
}

TEST_F(ListenerTest, AllWhoAskForAStopHearItsAnswer) {
    send(0, order(kStop));
    send(1, order(kStop) + order(kStop));
    EXPECT_EQ(handed(), order(kStop));
    answer(kAccept);
    EXPECT_EQ(handed(), Bytes());
    EXPECT_EQ(heard(0), kAccept);
    EXPECT_EQ(heard(1), kAccept);
}

TEST_F(ListenerTest, AStopGoesBeforeAHold) {
    send(0, order(kHold));
    send(1, order(kStop));
    EXPECT_EQ(handed(), order(kStop));
    answer(kAccept);
    EXPECT_EQ(handed(), order(kHold));
}

TEST_F(ListenerTest, WhoHasStoppedAsksBeforeOthersWhetherItWasDone) {
    send(1, order(kStop));
    EXPECT_EQ(handed(), order(kStop));
    answer(kAccept);
    EXPECT_EQ(heard(1), kAccept);
    send(0, read_of(17));
    send(1, read_of(16));
    EXPECT_EQ(handed(), read_of(16));
    answer(reply_of(16));
    EXPECT_EQ(heard(1), reply_of(16));
    EXPECT_EQ(handed(), read_of(17));
    answer(reply_of(17));
    now += 2s;
    send(0, {});
    EXPECT_EQ(heard(0), reply_of(17));
    send(0, read_of(18));
    send(1, read_of(19));
    EXPECT_EQ(handed(), read_of(19)) << "its turn";
    answer(reply_of(19));
    EXPECT_EQ(handed(), read_of(18));
}

TEST_F(ListenerTest, WhatWasSentBeforeAStopIsRefusedAndItsClientIsToldWhy) {
    send(0, read_of(17));
    EXPECT_EQ(handed(), read_of(17));
    send(0, order(kRun));
    send(1, order(kRun) + order(kStop) + write_of(50));
    EXPECT_EQ(handed(), order(kStop));
    answer(kAccept);
    EXPECT_EQ(handed(), write_of(50)) << "it was sent after the stop";
    answer(kAccept);
    send(0, read_of(31));
    EXPECT_EQ(handed(), Bytes());
    EXPECT_EQ(heard(0), too_late(48));
    send(0, write_of(50));
    EXPECT_EQ(handed(), write_of(50));
    answer(kAccept, 50 << 8);
    send(0, read_of(31));
    EXPECT_EQ(handed(), Bytes());
    EXPECT_EQ(heard(0), kAccept + reply_of(31, {0, 50, 0, 0}));
}

TEST_F(ListenerTest, AWriteThatAStopCutShortIsNotTakenForDone) {
    send(0, order(kRun));
    EXPECT_EQ(handed(), order(kRun));
    send(1, order(kStop));
    EXPECT_EQ(handed(), order(kStop));
    answer(kAccept);
    send(0, read_of(31));
    EXPECT_EQ(handed(), Bytes());
    EXPECT_EQ(heard(0), too_late(48));
}

/// It may be stored: the gateway decides.
TEST_F(ListenerTest, AChangeOfSetPointsThatAStopCutShortIsNotSaidToBeLost) {
    constexpr std::uint8_t kSetPointWrite = 91;
    const Bytes change = bytes(mactalk::encode_long_write(kGateway, kSetPointWrite, Bytes(16, 1)));
    send(0, change);
    EXPECT_EQ(handed(), change);
    send(1, order(kStop));
    EXPECT_EQ(handed(), order(kStop));
    answer(kAccept);
    send(0, read_of(31));
    EXPECT_EQ(handed(), read_of(31));
}

TEST_F(ListenerTest, WhatMayHaveWaitedTooLongToBeReadIsRefusedButForReadsAndStops) {
    listener.looked(now);
    now += Listener::kLongestUnread;
    send(0, order(kRun));
    EXPECT_EQ(handed(), order(kRun)) << "just in time";
    answer(kAccept);
    EXPECT_EQ(heard(0), kAccept);
    now += Listener::kLongestUnread + 1ms;
    const Bytes motor =
        bytes(mactalk::encode({.kind = Kind::write, .address = kMotor, .reg = 2, .length = 2, .value = 2}));
    give(0, order(kRun) + motor + read_of(16));
    give(1, order(kStop));
    EXPECT_EQ(handed(), order(kStop));
    answer(kAccept);
    EXPECT_EQ(handed(), read_of(16));
    answer(reply_of(16));
    listener.looked(now);
    send(0, order(kRun));
    EXPECT_EQ(handed(), order(kRun)) << "the next one is fresh";
}

TEST_F(ListenerTest, WhatWaitsForOthersTooLongIsRefused) {
    send(0, write_of(16));
    EXPECT_EQ(handed(), write_of(16));
    send(1, order(kRun));
    EXPECT_EQ(handed(), Bytes());
    now += Listener::kLongestAnswer;
    send(1, {});
    EXPECT_EQ(handed(), Bytes());
    send(1, read_of(31));
    EXPECT_EQ(handed(), Bytes());
    EXPECT_EQ(heard(1), too_late(48));
}

TEST_F(ListenerTest, WhatIsOldStaysOldBehindMoreThanIsReadAtOnce) {
    listener.looked(now);
    now += Listener::kLongestUnread + 1ms;
    listener.received(client(0), read_of(16), false, now);
    EXPECT_EQ(handed(), read_of(16));
    answer(reply_of(16));
    EXPECT_EQ(heard(0), reply_of(16));
    now += 10ms;
    listener.received(client(0), order(kRun), true, now);
    EXPECT_EQ(handed(), Bytes()) << "it was sent with the others";
    listener.looked(now);
    send(0, order(kRun));
    EXPECT_EQ(handed(), order(kRun));
}

TEST_F(ListenerTest, WhatAClientSentThatHasLeftIsRefusedButForStops) {
    give(0, order(kRun));
    listener.left(client(0));
    EXPECT_EQ(handed(), Bytes());
    give(1, order(kRun) + order(kStop));
    listener.left(client(1));
    listener.looked(now);
    EXPECT_EQ(handed(), order(kStop));
}

TEST_F(ListenerTest, WhoIsNoMoreThereWhenItsTurnComesStartsNothing) {
    bool is_there = true;
    listener.ask_who_is_there([&](Listener::Id who) { return is_there || who != client(0); });
    send(0, order(kRun));
    is_there = false;
    EXPECT_EQ(handed(), Bytes());
    send(0, order(kStop));
    EXPECT_EQ(handed(), order(kStop));
    answer(kAccept);
    send(1, order(kRun));
    EXPECT_EQ(handed(), order(kRun));
}

TEST_F(ListenerTest, AClientThatSendsNoMoreIsAnsweredAndGoes) {
    give(0, read_of(16));
    listener.left(client(0));
    listener.looked(now);
    EXPECT_EQ(handed(), read_of(16));
    answer(reply_of(16));
    listener.looked(now);
    EXPECT_EQ(listener.take_dropped(), std::vector<Listener::Id>());
    EXPECT_EQ(heard(0), reply_of(16));
    listener.looked(now);
    EXPECT_EQ(listener.take_dropped(), std::vector<Listener::Id>{client(0)});
}

TEST_F(ListenerTest, AStopIsCarriedOutThoughItsClientHasGone) {
    give(0, order(kStop));
    listener.gone(client(0), now);
    EXPECT_EQ(handed(), order(kStop));
    answer(kAccept);
    EXPECT_EQ(handed(), Bytes());
}

TEST_F(ListenerTest, WantsToLookOftenEnoughToTellHowOldAMessageIs) {
    listener.looked(now);
    EXPECT_EQ(listener.next_look(now), now + Listener::kBetweenLooks);
    EXPECT_LT(Listener::kBetweenLooks, Listener::kLongestUnread);
    give(0, read_of(16));
    EXPECT_EQ(listener.next_look(now), now);
}

TEST_F(ListenerTest, OthersWaitOnlyBrieflyForTheAnswerToAClientThatHasGone) {
    send(0, write_of(16));
    EXPECT_EQ(handed(), write_of(16));
    send(1, read_of(17));
    listener.gone(client(0), now);
    EXPECT_EQ(handed(), Bytes());
    now += 150ms;
    EXPECT_EQ(handed(), read_of(17));
}

/// With one operator's seat for all clients of the axis.
struct WithSeat {
    faces::Seat seat{};
};
struct SeatedListenerTest : WithSeat, ListenerTest {
    SeatedListenerTest() : ListenerTest({.name = "clients", .operators = &seat}) {}
    /// RESULT, 31: seat_taken, 22, of the register in bits 15..8, and the detail.
    static Bytes seat_taken(std::uint8_t reg, std::uint8_t detail = 0) {
        return reply_of(31, {22, reg, detail, 0});
    }
    void operate(std::size_t who) {
        send(who, order(kRun));
        EXPECT_EQ(handed(), order(kRun));
        answer(kAccept);
        EXPECT_EQ(heard(who), kAccept);
    }
};

TEST_F(SeatedListenerTest, OneClientOperatesAndAllReadAndStop) {
    operate(0);
    send(1, order(kRun));
    send(1, read_of(31));
    EXPECT_EQ(handed(), Bytes());
    EXPECT_EQ(heard(1), seat_taken(48));
    send(1, read_of(16));
    EXPECT_EQ(handed(), read_of(16));
    answer(reply_of(16));
    EXPECT_EQ(heard(1), reply_of(16));
    send(1, order(kStop));
    EXPECT_EQ(handed(), order(kStop));
}

/// UPLOAD_BYTES (58) comes before every command of nanoctl, TABLE_POINTER (60) before reading a table back,
/// SET_POINT_POINTER (89) before reading what can be set.
TEST_F(SeatedListenerTest, WhatOnlyPreparesNeedsNoSeat) {
    operate(0);
    for (const std::uint8_t reg : {std::uint8_t{58}, std::uint8_t{60}, std::uint8_t{89}}) {
        send(1, write_of(reg));
        EXPECT_EQ(handed(), write_of(reg));
        answer(kAccept);
        EXPECT_EQ(heard(1), kAccept);
    }
}

TEST_F(SeatedListenerTest, TheSeatIsFreeWhenItsClientHasLeft) {
    operate(0);
    listener.left(client(0));
    operate(1);
    listener.gone(client(1), now);
    EXPECT_EQ(seat.holder(), nullptr);
}

/// OPERATOR is 12, _PEER 13, _LEFT 14, OPERATE 15 (REGISTERS.md): 1 takes, 2 takes over, 3 gives back.
struct OperatingListenerTest : SeatedListenerTest {
    static constexpr Listener::Id kMine = 11;
    static constexpr Listener::Id kAlsoMine = 12;
    static constexpr Listener::Id kOthers = 13;

    OperatingListenerTest() {
        for (const auto& [id, uid] : {std::pair{kMine, 1000U}, {kAlsoMine, 1000U}, {kOthers, 1001U}}) {
            const std::string user = "uid " + std::to_string(uid);
            listener.connected(id,
                               {.name = user + " at clients",
                                .way = registers::gateway::OperatorWay::unix_socket,
                                .peer = uid,
                                .user = user},
                               now);
        }
    }
    static Bytes operate_write(std::uint32_t what) {
        return bytes(mactalk::encode(
            {.kind = Kind::write, .address = kGateway, .reg = 15, .length = 4, .value = what}));
    }
    /// The answer that a client gets to a message that is not for the gateway.
    Bytes told(Listener::Id who, const Bytes& message) {
        send(who, message);
        EXPECT_EQ(handed(), Bytes());
        return heard(who);
    }
    /// The same of one that is.
    void is_carried_out(Listener::Id who, const Bytes& message) {
        send(who, message);
        EXPECT_EQ(handed(), message);
        answer(kAccept);
        EXPECT_EQ(heard(who), kAccept);
    }
};

TEST_F(OperatingListenerTest, AUsersClientsAreOneOperatorAndOthersAreToldWho) {
    EXPECT_EQ(told(kOthers, read_of(12)), reply_of(12)) << "nobody";
    is_carried_out(kMine, order(kRun));
    is_carried_out(kAlsoMine, write_of(50));
    EXPECT_EQ(told(kOthers, write_of(50)), Bytes()) << "a foreign client just gets no accept";
    EXPECT_EQ(told(kOthers, read_of(31)), seat_taken(50));
    EXPECT_EQ(told(kOthers, read_of(12)), reply_of(12, {1, 0, 0, 0}));
    EXPECT_EQ(told(kOthers, read_of(13)), reply_of(13, {0xE8, 0x03, 0, 0})) << "1000";
    EXPECT_EQ(told(kAlsoMine, read_of(12)), reply_of(12, {1, 1, 0, 0})) << "it is you";
    now += 3s;
    EXPECT_EQ(told(kOthers, read_of(14)), reply_of(14, {7, 0, 0, 0})) << "of 10";
    now += 7s;
    EXPECT_EQ(told(kOthers, read_of(12)), reply_of(12)) << "it was silent for too long";
}

TEST_F(OperatingListenerTest, TheLeaseEndsWithItsLastConnection) {
    is_carried_out(kMine, order(kRun));
    is_carried_out(kAlsoMine, order(kRun));
    listener.gone(kMine, now);
    EXPECT_EQ(told(kOthers, order(kRun)), Bytes());
    listener.gone(kAlsoMine, now);
    is_carried_out(kOthers, order(kRun));
}

TEST_F(OperatingListenerTest, ItIsGivenBackAndTakenOver) {
    EXPECT_EQ(told(kMine, operate_write(1)), kAccept);
    EXPECT_EQ(told(kOthers, operate_write(1)), Bytes());
    EXPECT_EQ(told(kOthers, operate_write(3)), Bytes()) << "it is not its own";
    EXPECT_EQ(told(kOthers, operate_write(2)), kAccept);
    EXPECT_EQ(told(kMine, order(kRun)), Bytes());
    EXPECT_EQ(told(kMine, read_of(31)), seat_taken(48, 3)) << "taken over";
    EXPECT_EQ(told(kMine, read_of(12)), reply_of(12, {1, 2, 0, 0}));
    EXPECT_EQ(told(kOthers, operate_write(3)), kAccept);
    is_carried_out(kMine, order(kRun));
    EXPECT_EQ(told(kMine, operate_write(9)), Bytes());
    EXPECT_EQ(told(kMine, read_of(31)), reply_of(31, {4, 15, 0, 0})) << "bad_value";
}

/// FORCE_IN is 49, FORCE_OUT 50.
TEST_F(OperatingListenerTest, EverybodyWatchesStopsAndEndsForces) {
    is_carried_out(kMine, order(kRun));
    is_carried_out(kOthers, read_of(16));
    for (const std::uint8_t reg : {std::uint8_t{49}, std::uint8_t{50}}) {
        const auto force = [reg](std::uint32_t value) {
            return bytes(mactalk::encode(
                {.kind = Kind::write, .address = kGateway, .reg = reg, .length = 4, .value = value}));
        };
        is_carried_out(kOthers, force(0));
        EXPECT_EQ(told(kOthers, force(0x0101)), Bytes());
    }
    for (const std::uint32_t stop : {kStop, kSafe, kHold}) is_carried_out(kOthers, order(stop));
}

TEST_F(SeatedListenerTest, PersonsWaitWhileThePlantOperates) {
    const faces::Sitter plc{faces::Seat::new_number(), faces::Side::plant, "PLC"};
    EXPECT_EQ(seat.take(plc, now), faces::Seat::Verdict::granted);
    send(0, order(kRun));
    send(0, read_of(31));
    EXPECT_EQ(handed(), Bytes());
    EXPECT_EQ(heard(0), seat_taken(48));
    send(0, order(kSafe));
    EXPECT_EQ(handed(), order(kSafe));
    seat.leave(plc.number);
}

/// A port that asks for a password. PASSWORD_STATE is 10, PASSWORD 11, no_password 30 (REGISTERS.md).
struct GuardedListenerTest : ListenerTest {
    GuardedListenerTest() : ListenerTest({.name = "clients", .password = "correct horse"}) {}
    static Bytes password(std::string text) {
        text.resize((text.size() + 3) / 4 * 4, '\0');
        return bytes(mactalk::encode_long_write(kGateway, 11, Bytes(text.begin(), text.end())));
    }
    static Bytes no_password(std::uint8_t reg) { return reply_of(31, {30, reg, 0, 0}); }
    static Bytes state(std::uint8_t value) { return reply_of(10, {value, 0, 0, 0}); }
    /// The answers that the client gets to messages of which none is for the gateway.
    Bytes told(std::size_t who, const std::vector<Bytes>& messages) {
        Bytes all;
        for (const Bytes& message : messages) {
            send(who, message);
            EXPECT_EQ(handed(), Bytes());
            all = all + heard(who);
        }
        return all;
    }
};

TEST_F(GuardedListenerTest, WithoutItOnlyReadsStopsAndWhatPrepares) {
    for (const Bytes& message : {read_of(16), order(kStop), order(kSafe), order(kHold), write_of(58)}) {
        send(0, message);
        EXPECT_EQ(handed(), message);
        answer(kAccept);
        EXPECT_EQ(heard(0), kAccept);
    }
    const Bytes of_motor =
        bytes(mactalk::encode({.kind = Kind::write, .address = kMotor, .reg = 2, .length = 2, .value = 1}));
    const Bytes motor_reset = bytes(mactalk::encode({.kind = Kind::reset, .address = kMotor}));
    for (const auto& [message, reg] :
         {std::pair{order(kRun), 48}, {write_of(200), 200}, {of_motor, 2}, {motor_reset, 0}})
        EXPECT_EQ(told(0, {message, read_of(31)}), no_password(static_cast<std::uint8_t>(reg)));
}

TEST_F(GuardedListenerTest, WhoHasGivenItOperates) {
    EXPECT_EQ(told(0, {read_of(10), password("correct horse"), read_of(10)}), state(1) + kAccept + state(2))
        << "it never reaches the gateway";
    EXPECT_EQ(told(1, {order(kRun), read_of(31)}), no_password(48)) << "it is the other client's";
    send(0, order(kRun));
    EXPECT_EQ(handed(), order(kRun));
}

TEST_F(GuardedListenerTest, AnotherOneIsNone) {
    EXPECT_EQ(told(0, {password("correct horse")}), kAccept);
    unsigned wrong = 0;
    for (const char* other : {"correct hors", "correct horse battery", "Correct horse", "12345678", ""}) {
        const Bytes given = *other == '\0' ? write_of(11) : password(other);
        EXPECT_EQ(told(0, {given, read_of(31), read_of(10)}), no_password(11) + state(1)) << other;
        EXPECT_EQ(listener.wrong_passwords(), ++wrong);
    }
    EXPECT_EQ(told(0, {order(kRun)}), Bytes());
}

/// For another unit on the line, and without a password, the numbers have no special meaning.
TEST_F(GuardedListenerTest, OnlyTheGatewaysRegistersAreMeant) {
    const Bytes of_motor = bytes(mactalk::encode({.kind = Kind::read, .address = kMotor, .reg = 10}));
    send(0, of_motor);
    EXPECT_EQ(handed(), of_motor);
}

TEST_F(ListenerTest, WithoutAPasswordItsNumbersAreTheGateways) {
    send(0, read_of(10));
    EXPECT_EQ(handed(), read_of(10));
}

/// Three places.
struct CrowdedListenerTest : ListenerTest {
    CrowdedListenerTest() : ListenerTest({.name = "clients", .places = 3}) {
        listener.gone(client(0), now);
        listener.gone(client(1), now);
    }
    /// The client that is dropped for a new one; 0: none.
    Listener::Id come(Listener::Id who) {
        listener.connected(who, {}, now);
        const auto dropped = listener.take_dropped();
        EXPECT_LE(dropped.size(), 1U);
        return dropped.empty() ? 0 : dropped.front();
    }
    void speak(Listener::Id who) {
        give(who, read_of(16));
        EXPECT_EQ(handed(), read_of(16));
        answer({});
    }
};

TEST_F(CrowdedListenerTest, WhoWasHeardTheLongestAgoGoes) {
    for (const Listener::Id who : {11U, 12U, 13U}) EXPECT_EQ(come(who), 0U);
    for (const Listener::Id who : {12U, 13U, 11U}) speak(who);
    EXPECT_EQ(come(14), 12U);
    speak(14);
    speak(13);
    EXPECT_EQ(come(15), 11U);
}

TEST_F(CrowdedListenerTest, ANewcomerHasTimeForItsFirstMessage) {
    for (const Listener::Id who : {11U, 12U, 13U}) EXPECT_EQ(come(who), 0U);
    speak(13);
    EXPECT_EQ(come(14), 13U) << "the others may be about to speak";
    EXPECT_EQ(come(15), 11U) << "a newcomer is always taken";
    speak(14);
    now += Listener::kFirstMessage;
    EXPECT_EQ(come(16), 12U) << "it has said nothing for too long";
}

TEST_F(CrowdedListenerTest, WhoFloodsGoesFirst) {
    for (const Listener::Id who : {11U, 12U, 13U}) EXPECT_EQ(come(who), 0U);
    speak(11);
    for (int i = 0; i < 5; ++i) give(13, Bytes(4096, 'x'));
    speak(12);
    EXPECT_EQ(listener.readable(13, now), 0U);
    EXPECT_EQ(come(14), 13U);
}

TEST_F(CrowdedListenerTest, WhoDoesNotReadGoesBeforeWhoSaysNothing) {
    for (const Listener::Id who : {11U, 12U, 13U}) EXPECT_EQ(come(who), 0U);
    give(12, read_of(16));
    EXPECT_EQ(handed(), read_of(16));
    answer(reply_of(16));
    now += 1s;
    EXPECT_EQ(come(14), 12U);
}

TEST_F(CrowdedListenerTest, WhoWaitsForTheAnswerOfAStopStays) {
    for (const Listener::Id who : {11U, 12U, 13U}) EXPECT_EQ(come(who), 0U);
    give(12, order(kStop));
    EXPECT_EQ(come(14), 11U);
    EXPECT_EQ(come(15), 13U);
    EXPECT_EQ(come(16), 14U);
    EXPECT_EQ(handed(), order(kStop));
    answer(kAccept);
    const auto unsent = listener.unsent(12);
    EXPECT_EQ(Bytes(unsent.begin(), unsent.end()), kAccept);
}

}  // namespace
}  // namespace nplc::boards
