#include "midi_client/player.h"

#include <gtest/gtest.h>

#include "bus_can.h"
#include "midi_client/can_link.h"
#include "midi_client/v24_link.h"
#include "rack_wire.h"

namespace nplc::midi_client {
namespace {

namespace midi = registers::midi;
using midi::Model;

constexpr std::int64_t kPlayerMs = 8'000;

/// Both axes to and fro, 50 ms a segment.
Plan zigzag(std::uint8_t first, std::uint8_t second, int corners = 40) {
    std::vector<Waypoint> path{{0, {0, 0}}};
    for (int i = 1; i <= corners; ++i) path.push_back({i * 50 * kPlayerMs, {i % 2 * 500, 100 * i}});
    return plan_path({first, second}, path).plan;
}

std::string told(const std::function<void()>& what) {
    try {
        what();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return {};
}

class OnALine : public testing::Test {
  protected:
    sim::MidiModule& module(std::size_t i) { return wire.rack.module(i); }
    void expect_standing() {
        wire.rack.advance(wire.rack.now() + std::chrono::milliseconds{50});
        EXPECT_FALSE(module(0).moving());
        EXPECT_FALSE(module(1).moving());
        EXPECT_EQ(module(0).waiting_segments(), 0);
        EXPECT_EQ(module(1).waiting_segments(), 0);
    }
    /// Calls it when the plan is half done.
    void in_the_middle(const std::function<void()>& what) {
        wire.on_step = [this, what, done = false]() mutable {
            if (done || module(1).position() < 2000) return;
            done = true;
            what();
        };
    }

    RackWire wire{{{Model::mac34_1, 0}, {Model::mac34_1, 1}}};
    V24Link link{wire};
    Master master{link};
};

TEST_F(OnALine, EndsAtTheIncrement) {
    play(master, zigzag(0, 1));
    EXPECT_EQ(module(0).position(), 0);
    EXPECT_EQ(module(1).position(), 4000);
    play(master, zigzag(0, 1, 41));
    EXPECT_EQ(module(0).position(), 500);
    EXPECT_EQ(module(1).position(), 8100);
    expect_standing();
}

TEST_F(OnALine, BothBeginInTheSameTick) {
    bool moved[2] = {};
    wire.on_step = [&] {
        moved[0] = moved[0] || module(0).position() != 0;
        moved[1] = moved[1] || module(1).position() != 0;
        EXPECT_EQ(moved[0], moved[1]);
    };
    play(master, plan_path({0, 1}, {{0, {0, 0}}, {500 * kPlayerMs, {5000, -5000}}}).plan);
}

TEST_F(OnALine, ASignalStopsAll) {
    bool goes_on = true;
    in_the_middle([&] { goes_on = false; });
    EXPECT_THROW(play(master, zigzag(0, 1), {.goes_on = [&] { return goes_on; }}), Interrupted);
    EXPECT_LT(module(1).position(), 2500);
    expect_standing();
}

TEST_F(OnALine, AFaultOfOneStopsTheOther) {
    in_the_middle([&] { module(0).overload_amplifier(); });
    const std::string why = told([&] { play(master, zigzag(0, 1)); });
    EXPECT_NE(why.find("axis 0 stopped: tripped: amplifier"), std::string::npos) << why;
    EXPECT_LT(module(1).position(), 3500);
    expect_standing();
}

TEST_F(OnALine, ASlowComputerIsNoticed) {
    in_the_middle([&] { wire.hold_back = std::chrono::milliseconds{400}; });
    EXPECT_NE(told([&] { play(master, zigzag(0, 1)); }), "");
    wire.hold_back = {};
    expect_standing();
}

TEST_F(OnALine, AModuleThatGoesSilentStopsTheOther) {
    in_the_middle([&] { module(1).power_off(); });
    const std::string why = told([&] { play(master, zigzag(0, 1)); });
    EXPECT_NE(why.find("no clear answer from axis 1"), std::string::npos) << why;
    EXPECT_NE(why.find("STILL MOVING, perhaps: no answer to the stop from axis 1"), std::string::npos) << why;
    expect_standing();
}

TEST_F(OnALine, WhatTheLineCannotFeedIsRefusedBeforeAnythingIsSent) {
    std::vector<Waypoint> path{{0, {0, 0}}};
    for (int i = 1; i < 100; ++i) path.push_back({i * 5 * kPlayerMs, {i * 50, i * 50}});
    EXPECT_NE(told([&] {
                  play(master, plan_path({0, 1}, path).plan);
              }).find("would run out"),
              std::string::npos);
    EXPECT_FALSE(module(0).powered());
}

TEST_F(OnALine, WithoutAddress00ThereIsNoCommonStart) {
    RackWire other({{Model::mac34_1, 1}, {Model::mac34_1, 2}});
    V24Link other_link(other);
    Master other_master(other_link);
    const std::string why = told([&] { play(other_master, zigzag(1, 2)); });
    EXPECT_NE(why.find("one of them must have address 0 (000 §IV)"), std::string::npos) << why;
    EXPECT_EQ(other.rack.module(0).position(), 0);
    EXPECT_EQ(other.rack.module(1).position(), 0);
}

TEST_F(OnALine, AnAxisThatMovesAlreadyIsFoundBeforeAnythingElseTurns) {
    master.command(1, midi::GO_TO, 1'000'000);
    const std::string why = told([&] { play(master, zigzag(0, 1)); });
    EXPECT_NE(why.find("axis 1 refuses segments"), std::string::npos) << why;
    EXPECT_EQ(module(0).position(), 0);
    expect_standing();
}

TEST_F(OnALine, MovesThatBeginTogether) {
    bool moved[2] = {};
    wire.on_step = [&] {
        moved[0] = moved[0] || module(0).position() != 0;
        moved[1] = moved[1] || module(1).position() != 0;
        EXPECT_EQ(moved[0], moved[1]);
    };
    go_together(master, {{0, 3000}, {1, -4000}});
    EXPECT_EQ(module(0).position(), 3000);
    EXPECT_EQ(module(1).position(), -4000);
}

TEST_F(OnALine, AMoveThatIsHeldIsGivenUp) {
    module(1).hold_shaft(true);
    const std::string why = told([&] { go_together(master, {{0, 3000}, {1, 4000}}); });
    EXPECT_NE(why.find("axis 1 stands at 0 increments and does not reach 4000"), std::string::npos) << why;
    expect_standing();
}

class OnABus : public testing::Test {
  protected:
    OnABus() { link.pause(base::Milliseconds{10}); }  // the first boot-ups

    /// As a module that is back before a request to it times out.
    void boots(std::uint8_t address) {
        can.tell({.id = static_cast<std::uint16_t>(0x700 + address), .length = 1});
    }
    void sync_every(int milliseconds) {
        can.on_step = [this, period = base::Milliseconds{milliseconds}, next = can.now()]() mutable {
            if (can.now() < next) return;
            next += period;
            for (sim::MidiModule& module : can.modules) module.sync();
            can.tell({.id = 0x080});
        };
    }
    void expect_standing() {
        link.pause(base::Milliseconds{50});
        for (const sim::MidiModule& module : can.modules) {
            EXPECT_FALSE(module.moving());
            EXPECT_EQ(module.waiting_segments(), 0);
        }
    }
    std::size_t count(std::uint16_t id, std::uint8_t number) const {
        std::size_t times = 0;
        for (const ports::CanFrame& frame : can.sent) times += frame.id == id && frame.data[1] == number;
        return times;
    }

    BusCan can{{1, 2}};
    CanLink link{can};
    Master master{link};
};

// 003 §V.8: on CAN address 0 is every module; on V24 it is a module's.
TEST_F(OnABus, NoAxisIsAllModules) {
    const std::string words = "axis 0: that is the address of all modules";
    EXPECT_EQ(told([&] { go_together(master, {{1, 3000}, {0, -4000}}); }), words);
    EXPECT_EQ(told([&] { play(master, zigzag(0, 1)); }), words);
    EXPECT_TRUE(can.sent.empty());
}

TEST_F(OnABus, AModuleThatStartsAnewOnItsPathGetsNoFurtherSegment) {
    std::size_t segments = 0;
    can.on_step = [&] {
        if (segments != 0 || can.modules[1].position() < 2000) return;
        segments = count(0x602, midi::SEGMENT);
        boots(2);
    };
    const std::string why = told([&] { play(master, zigzag(1, 2)); });
    EXPECT_NE(why.find("axis 2 started anew by itself"), std::string::npos) << why;
    EXPECT_EQ(count(0x602, midi::SEGMENT), segments);
    expect_standing();
}

// 10h is forgotten, and 13h alone would begin at once.
TEST_F(OnABus, AModuleThatStartsAnewBetweenTheTwoFramesOfAPreparedMove) {
    can.loses = [&](std::size_t module, const BusCan::Frame& frame) {
        if (module == 1 && frame.id == 0x602 && frame.data[1] == midi::WAIT_SYNC) boots(2);
        return false;
    };
    const std::string why = told([&] { go_together(master, {{1, 3000}, {2, -4000}}); });
    EXPECT_NE(why.find("axis 2 started anew by itself"), std::string::npos) << why;
    EXPECT_EQ(count(0x602, midi::GO_TO), 0u);
    EXPECT_EQ(std::count(can.sent.begin(), can.sent.end(), ports::CanFrame{.id = 0x080}), 0);
    link.synchronise();  // another master's
    expect_standing();
    EXPECT_EQ(can.modules[0].position(), 0);
}

TEST_F(OnABus, AModuleThatStartsAnewOnItsWay) {
    can.on_step = [&, told_already = false]() mutable {
        if (told_already || can.modules[1].position() > -500) return;
        told_already = true;
        boots(2);
    };
    const std::string why = told([&] { go_together(master, {{1, 30'000}, {2, -4000}}); });
    EXPECT_NE(why.find("axis 2 started anew by itself"), std::string::npos) << why;
    EXPECT_LT(can.modules[0].position(), 30'000);
    expect_standing();
}

// So short a move that it would be within the widest tolerance.
TEST_F(OnABus, ALostSyncIsNoticed) {
    can.loses = [](std::size_t module, const BusCan::Frame& frame) {
        return module == 1 && frame.id == 0x080;
    };
    const std::string why = told([&] { go_together(master, {{1, 200}, {2, -200}}); });
    EXPECT_NE(why.find("axis 2 stands at 0 increments and does not reach -200"), std::string::npos) << why;
    can.loses = {};
    link.synchronise();
    expect_standing();
    EXPECT_EQ(can.modules[1].position(), 0);
}

TEST(OnABusOnce, AModuleThatMissedTheCommonStartIsFoundBeforeAnythingTurns) {
    BusCan can({1, 2});
    CanLink link(can);
    Master master(link);
    can.loses = [](std::size_t module, const BusCan::Frame& frame) {
        return module == 1 && frame.id == 0x600;
    };
    const std::string why = told([&] { play(master, zigzag(1, 2)); });
    EXPECT_NE(why.find("axis 2 did not take part in the common start"), std::string::npos) << why;
    EXPECT_EQ(can.modules[0].position(), 0);
    EXPECT_EQ(can.modules[1].position(), 0);
}

TEST(OnABusOnce, MovesThatBeginTogetherBySync) {
    BusCan can({1, 2, 3});
    CanLink link(can);
    Master master(link);
    link.pause(base::Milliseconds{10});
    go_together(master, {{1, 3000}, {3, -4000}});
    EXPECT_EQ(can.modules[0].position(), 3000);
    EXPECT_EQ(can.modules[1].position(), 0);
    EXPECT_EQ(can.modules[2].position(), -4000);
    // 003 §V.4: 080h without data, once.
    EXPECT_EQ(std::count(can.sent.begin(), can.sent.end(), ports::CanFrame{.id = 0x080}), 1);
}

// 003 §V.4: it would start each axis as soon as it is prepared.
TEST_F(OnABus, APlantsSyncLetsNoMovesBeginTogether) {
    for (const int period : {10, 100}) {
        sync_every(period);
        const std::string why = told([&] { go_together(master, {{1, 3000}, {2, -4000}}); });
        EXPECT_NE(why.find("another master on the bus sends SYNC"), std::string::npos) << why;
        EXPECT_EQ(count(0x601, midi::GO_TO), 0u);
    }
    can.on_step = {};
    expect_standing();
    EXPECT_EQ(can.modules[0].position(), 0);
}

TEST_F(OnABus, ARareSyncBetweenThePreparationsStopsAll) {
    can.loses = [&](std::size_t module, const BusCan::Frame& frame) {
        if (module == 1 && frame.id == 0x602 && frame.data[1] == midi::GO_TO) can.tell({.id = 0x080});
        return false;
    };
    const std::string why = told([&] { go_together(master, {{1, 30'000}, {2, -30'000}}); });
    EXPECT_NE(why.find("another master on the bus sends SYNC"), std::string::npos) << why;
    expect_standing();
}

// 003 §V.4: what a plant sends for others starts what 10h has prepared, and nothing else: segments have their
// own times.
TEST_F(OnABus, APlantsSyncLeavesSegmentsAlone) {
    sync_every(10);
    play(master, zigzag(1, 2));
    EXPECT_EQ(can.modules[0].position(), 0);
    EXPECT_EQ(can.modules[1].position(), 4'000);
}

}  // namespace
}  // namespace nplc::midi_client
