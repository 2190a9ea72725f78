#include "midi_rack.h"

#include <gtest/gtest.h>

#include <deque>

namespace nplc::sim {
namespace {

using Model = registers::midi::Model;
using std::chrono::milliseconds;
using std::chrono::seconds;

class Port final : public ports::CanPort {
  public:
    bool write(const ports::CanFrame& frame) override {
        if (room == 0) return false;
        --room;
        sent.push_back(frame);
        return true;
    }
    bool read(ports::CanFrame& frame) override {
        if (arrived.empty()) return false;
        frame = arrived.front();
        arrived.pop_front();
        return true;
    }
    bool filter(std::span<const ports::CanFilter>) override { return true; }
    ports::CanState state() override { return state_now; }
    ports::CanFaults faults() override { return {}; }
    bool restart() override {
        ++restarts;
        return true;
    }

    std::deque<ports::CanFrame> arrived;
    std::vector<ports::CanFrame> sent;
    int room = 100;
    int restarts = 0;
    ports::CanState state_now = ports::CanState::active;
};

// 003 §VII 13h, 00h: to 1000 (03E8h), and where it is.
const ports::CanFrame kGo{.id = 0x602, .length = 8, .data = {0x23, 0x13, 0x20, 0, 0, 0, 0x03, 0xE8}};
const ports::CanFrame kWhere{.id = 0x602, .length = 8, .data = {0x40, 0x00, 0x20, 0, 0, 0, 0, 0}};

TEST(MidiCanRack, ModulesOnAPort) {
    Port port;
    MidiCanRack rack({{Model::mac34_1, 1}, {Model::mac34_2, 2}}, port);
    rack.advance(milliseconds{1});
    ASSERT_EQ(port.sent.size(), 2u);
    EXPECT_EQ(port.sent[0], (ports::CanFrame{.id = 0x701, .length = 1}));
    EXPECT_EQ(port.sent[1], (ports::CanFrame{.id = 0x702, .length = 1}));
    port.arrived = {kGo};
    rack.advance(seconds{1});
    rack.advance(seconds{2});
    port.arrived = {kWhere};
    rack.advance(seconds{2});
    ASSERT_EQ(port.sent.size(), 4u);
    EXPECT_EQ(port.sent[2], (ports::CanFrame{.id = 0x582, .length = 8, .data = {0x60, 0x13, 0x20}}));
    EXPECT_EQ(port.sent[3],
              (ports::CanFrame{.id = 0x582, .length = 8, .data = {0x42, 0, 0x20, 0, 0, 0, 0x03, 0xE8}}));
    EXPECT_EQ(rack.module(0).position(), 0);
}

TEST(MidiCanRack, ExtendedAndRemoteFramesAreNotForIt) {
    Port port;
    MidiCanRack rack({{Model::mac34_1, 2}}, port);
    ports::CanFrame extended = kGo;
    extended.extended = true;
    ports::CanFrame remote = kGo;
    remote.remote = true;
    port.arrived = {extended, remote};
    rack.advance(milliseconds{1});
    EXPECT_FALSE(rack.module(0).moving());
    EXPECT_EQ(port.sent.size(), 1u);
}

TEST(MidiCanRack, AFullPortMakesAnswersWaitAndABusOffDropsThem) {
    Port port;
    port.room = 0;
    MidiCanRack rack({{Model::mac34_1, 2}}, port);
    port.arrived = {kWhere};
    rack.advance(milliseconds{1});
    port.room = 100;
    rack.advance(milliseconds{2});
    EXPECT_EQ(port.sent.size(), 2u);
    port.state_now = ports::CanState::bus_off;
    port.room = 0;
    port.arrived = {kWhere};
    for (int i = 1; i <= 2'500; ++i) rack.advance(milliseconds{2 + i});
    EXPECT_EQ(port.restarts, 3);  // once a second
    port.state_now = ports::CanState::active;
    port.room = 100;
    rack.advance(seconds{3});
    EXPECT_EQ(port.sent.size(), 2u);
}

}  // namespace
}  // namespace nplc::sim
