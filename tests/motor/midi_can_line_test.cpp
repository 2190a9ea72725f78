// The CAN link against frames written down from 003 §V and §VII by hand, and against everything that can come
// instead.

#include "midi_can_fixture.h"

namespace nplc::motor {
namespace {

TEST_F(MidiCanLineTest, TheManualsFrames) {
    run();
    EXPECT_EQ(bus.take(), Frames{kRun});
    EXPECT_EQ(heard(kRunTaken).kind, Kind::accepted);
    ask();
    EXPECT_EQ(bus.take(), Frames{kAskStatus});
    const MidiOutcome status = heard("585 42 01 20 00 08 04 00 80");
    EXPECT_EQ(status.kind, Kind::value);
    EXPECT_EQ(status.value, 0x0804'0080U);
    link.begin({.is_query = true, .number = midi::GET_RAM, .sub_index = midi::kImaxAddress}, now);
    EXPECT_EQ(bus.take(), Frames{"605 40 08 20 AF 00 00 00 00"});
    EXPECT_EQ(heard("585 42 08 20 00 80 00 00 00").value, 0x8000'0000U);  // 003 leaves the sub-index open
    EXPECT_FALSE(link.busy());
}

TEST_F(MidiCanLineTest, RefusalsWithAnyAbortCode) {
    run();
    EXPECT_EQ(heard("585 80 15 20 00 00 00 00 00").kind, Kind::refused);
    run();
    EXPECT_EQ(heard("585 80 15 20 00 22 00 00 08").kind, Kind::refused);
    ask();
    EXPECT_EQ(heard("585 80 01 20 00 00 00 02 06").kind, Kind::refused);
}

TEST_F(MidiCanLineTest, WhatIsNoAnswerToThis) {
    run();
    for (const char* other :
         {"586 60 15 20 00 00 00 00 00", "581 60 15 20 00 00 00 00 00", "585 60 16 20 00 00 00 00 00",
          "585 60 15 21 00 00 00 00 00", "585 60 15 20 01 00 00 00 00", "585 60 15 20 00 00 00 00", "585 60",
          "585", "585 42 15 20 00 00 00 00 00", "585 23 15 20 00 00 F6 03 20", "585 00 15 20 00 00 00 00 00",
          "605 60 15 20 00 00 00 00 00", "085 00 10 00 00 00 00 00 00", "080", "7E4 11 00 00 00 00 00 00 00",
          "704 00", "705 05"})
        EXPECT_EQ(heard(other).kind, Kind::none) << other;
    ports::CanFrame wrong_format = can_frame(kRunTaken);
    wrong_format.extended = true;
    bus.received.push_back(wrong_format);
    wrong_format.extended = false;
    wrong_format.remote = true;
    bus.received.push_back(wrong_format);
    EXPECT_EQ(link.poll(now).kind, Kind::none);
    EXPECT_FALSE(link.take_boot());
    EXPECT_EQ(at_the_deadline(), Kind::unclear);
    ask();
    EXPECT_EQ(heard("585 60 01 20 00 00 00 00 00").kind, Kind::none);
    EXPECT_EQ(at_the_deadline(), Kind::unclear);
}

TEST_F(MidiCanLineTest, SilenceEndsInBoundedTime) {
    run();
    EXPECT_EQ(link.next_poll(now), now + 100ms);
    EXPECT_EQ(at_the_deadline(), Kind::unclear);
    EXPECT_FALSE(link.busy());
    EXPECT_EQ(bus.take(), Frames{kRun}) << "once";
}

TEST_F(MidiCanLineTest, ALateAnswerIsNobodys) {
    run();
    EXPECT_EQ(at_the_deadline(), Kind::unclear);
    hear(kRunTaken);
    ask();
    EXPECT_EQ(heard("585 42 01 20 00 00 00 00 00").kind, Kind::value);
    run();
    EXPECT_EQ(at_the_deadline(), Kind::unclear);
    hear(kRunTaken);
    run();
    EXPECT_EQ(link.poll(now).kind, Kind::none) << "it came before the second was sent";
    EXPECT_EQ(heard(kRunTaken).kind, Kind::accepted);
}

TEST_F(MidiCanLineTest, AFrameThatThePortDoesNotTakeNeverReachedTheModule) {
    bus.takes = false;
    run();
    EXPECT_EQ(link.poll(now).kind, Kind::none) << "its queue may be full";
    for (int i = 0; i < 99; ++i) {
        EXPECT_LE(link.next_poll(now), now + 1ms);
        now += 1ms;
        EXPECT_EQ(link.poll(now).kind, Kind::none);
    }
    EXPECT_EQ(at_the_deadline(), Kind::not_taken);
    bus.takes = true;
    EXPECT_EQ(link.poll(now).kind, Kind::none);
    EXPECT_EQ(bus.take(), Frames{}) << "not delivered late";
    bus.state_now = ports::CanState::bus_off;
    run();
    hear(kRunTaken);
    EXPECT_EQ(link.poll(now).kind, Kind::not_taken) << "another master's";
    EXPECT_EQ(bus.take(), Frames{});
    EXPECT_EQ(bus.restarts, 1U);
}

TEST_F(MidiCanLineTest, AFullQueueCostsTimeOnly) {
    bus.takes = false;
    run();
    now += 90ms;
    EXPECT_EQ(link.poll(now).kind, Kind::none);
    bus.takes = true;
    now += 1ms;
    EXPECT_EQ(link.poll(now).kind, Kind::none);
    EXPECT_EQ(bus.take(), Frames{kRun});
    now += 90ms;
    EXPECT_EQ(heard(kRunTaken).kind, Kind::accepted) << "the answer has its whole time";
}

// SAFETY: outputs are safe 10 ms after it is known.
TEST_F(MidiCanLineTest, ABusThatGoesDownIsKnownAtOnce) {
    for (const auto state : {ports::CanState::down, ports::CanState::bus_off}) {
        bus.state_now = ports::CanState::active;
        run();
        EXPECT_EQ(link.poll(now).kind, Kind::none);
        EXPECT_EQ(link.trouble(), BusFault::none);
        bus.state_now = state;
        EXPECT_EQ(link.poll(now).kind, Kind::unclear);
        EXPECT_EQ(link.trouble(), BusFault::no_bus);
        bus.state_now = ports::CanState::active;
        EXPECT_EQ(link.poll(now).kind, Kind::none);
        EXPECT_EQ(link.trouble(), BusFault::none) << "with no message under way too";
        bus.take();
    }
}

TEST_F(MidiCanLineTest, AfterABootUpNothingIsSentBeforeItWasTold) {
    hear(kBoot);
    run();
    EXPECT_EQ(bus.take(), Frames{});
    EXPECT_EQ(link.poll(now).kind, Kind::not_taken);
    EXPECT_TRUE(link.take_boot());
    EXPECT_FALSE(link.take_boot());
    run();
    EXPECT_EQ(bus.take(), Frames{kRun});
}

// Requests of other masters too: the module answers them as well.
TEST_F(MidiCanLineTest, OnlyTheModulesOwnFramesComeIn) {
    ASSERT_EQ(bus.filters.size(), 3U);
    EXPECT_EQ(bus.filters[2].id, 0x605U);
    EXPECT_EQ(bus.filters[0].id, 0x585U);
    EXPECT_EQ(bus.filters[1].id, 0x705U);
    for (const ports::CanFilter& filter : bus.filters) {
        EXPECT_EQ(filter.mask, 0x7FFU);
        EXPECT_FALSE(filter.extended);
    }
}

}  // namespace
}  // namespace nplc::motor
