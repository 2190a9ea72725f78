// Two modules at one address (000 §IV: addresses are distinct): nothing that moves is sent, and what moves is
// stopped.

#include <gtest/gtest.h>

#include "bus_can.h"
#include "midi_client/can_link.h"
#include "midi_client/player.h"
#include "midi_client/v24_link.h"
#include "scripted_wire.h"

namespace nplc::midi_client {
namespace {

namespace midi = registers::midi;

class TwoAtOneAddress : public testing::Test {
  protected:
    BusCan can{{1, 1, 2}};
    CanLink link{can};
    Master master{link, 3};

    bool moved() const {
        return std::any_of(can.modules.begin(), can.modules.end(),
                           [](const sim::MidiModule& one) { return one.moving() || one.position() != 0; });
    }
};

TEST_F(TwoAtOneAddress, AreFoundBeforeAnythingMoves) {
    EXPECT_THROW(master.expect_alone(1), SameAddress);
    EXPECT_NO_THROW(master.expect_alone(2));
    EXPECT_THROW(go_together(master, {{1, 100}, {2, 100}}), NotPlayed);
    Plan plan = plan_path({2, 1}, {{0, {0, 0}}, {8'000'000, {500, 500}}}).plan;
    EXPECT_THROW(play(master, plan), std::runtime_error);
    EXPECT_FALSE(moved());
}

TEST_F(TwoAtOneAddress, TheMessageSaysWhatToDo) {
    try {
        master.expect_alone(1);
        FAIL();
    } catch (const SameAddress& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("more than one module answers to address 1"), std::string::npos) << text;
        EXPECT_NE(text.find("macreg midi address set"), std::string::npos) << text;
    }
}

TEST_F(TwoAtOneAddress, OneThatJoinsOnTheWayEndsTheMove) {
    can.loses = [&](std::size_t module, const BusCan::Frame&) {
        return module == 1 && can.modules[0].position() < 1'000;
    };
    master.expect_alone(1);
    try {
        go_together(master, {{1, 1'000'000}});
        FAIL();
    } catch (const NotPlayed& error) {
        EXPECT_NE(std::string(error.what()).find("more than one module"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(can.modules[0].moving());
}

// Each request that came is answered once; the answers come after the next request.
TEST_F(TwoAtOneAddress, LateAnswersAreNoSecondModule) {
    can.modules[1].power_off();
    std::deque<BusCan::Frame> held;
    bool holds = true;
    can.master_misses = [&](const BusCan::Frame& frame) {
        if (holds) held.push_back(frame);
        return holds;
    };
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(master.try_query(1, midi::GET_POSITION).kind, Answer::Kind::silence);
    holds = false;
    for (const BusCan::Frame& frame : held) can.tell(frame);
    EXPECT_EQ(master.position(1), 0);
    EXPECT_NO_THROW(master.expect_alone(1));
}

// Another master on the bus is answered too, at the same address.
TEST_F(TwoAtOneAddress, AnswersToAnotherMasterAreNoSecondModule) {
    can.modules[1].power_off();
    for (int i = 0; i < 20; ++i) {
        can.tell({.id = 0x601, .length = 8, .data = {0x40, 0x01, 0x20}});
        can.tell({.id = 0x581, .length = 8, .data = {0x42, 0x01, 0x20}});
        EXPECT_EQ(master.position(1), 0);
    }
    EXPECT_NO_THROW(master.expect_alone(1));
}

TEST(TwoOnALine, AnswerOneAfterTheOther) {
    // GET_RELEASE 24h of module 0: 7.4; Ack, Xoff, the reply, Xon (000 §III.2, §VI 24h).
    const std::string answer =
        "\x06\x13\x02"
        "011"
        "00"
        "4"
        "00000704"
        "1F"
        "\x03\x1A";
    std::vector<std::uint8_t> twice(answer.begin(), answer.end());
    twice.insert(twice.end(), answer.begin(), answer.end());
    ScriptedWire wire;
    for (int i = 0; i < 6; ++i) wire.script.push_back({.bytes = twice});
    V24Link link(wire);
    Master master(link, 3);
    EXPECT_THROW(master.expect_alone(0), SameAddress);
    ScriptedWire quiet;
    for (int i = 0; i < 6; ++i) quiet.script.push_back({.bytes = {answer.begin(), answer.end()}});
    V24Link other(quiet);
    Master alone(other, 3);
    EXPECT_NO_THROW(alone.expect_alone(0));
    EXPECT_EQ(quiet.sent.size(), 1u);
}

}  // namespace
}  // namespace nplc::midi_client
