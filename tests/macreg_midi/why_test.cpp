#include "macreg/midi/why.h"

#include <gtest/gtest.h>

#include "midi_client/v24_link.h"
#include "rack_wire.h"

namespace nplc::macreg::midi {
namespace {

class MidiWhy : public testing::Test {
  protected:
    sim::MidiModule& unit() { return wire.rack.module(0); }
    std::vector<Finding> findings() { return why(read_condition(module)); }
    std::string first() { return findings().front().code; }
    void order(std::uint8_t number, std::int32_t value) {
        ASSERT_TRUE(unit().execute(number, 0, *reg::pack(*reg::find_command(number), value)));
    }

    midi_client::RackWire wire{{{reg::Model::mac34_1, 0}}};
    midi_client::V24Link link{wire};
    midi_client::Master master{link};
    Module module{master, 0, reg::Model::mac34_1};
};

TEST_F(MidiWhy, NothingKeepsIt) {
    const auto all = findings();
    ASSERT_EQ(all.size(), 1u);
    EXPECT_EQ(all[0].code, "waits");
    EXPECT_EQ(all[0].severity, Severity::tells);
}

TEST_F(MidiWhy, EveryFault) {
    unit().overload_amplifier();
    EXPECT_EQ(first(), "amplifier_trip");
    EXPECT_NE(findings()[0].remedy.find("`macreg midi reset`"), std::string::npos);
    module.order(reg::RESET);
    link.pause(std::chrono::seconds{3});
    EXPECT_EQ(first(), "waits") << "the remedy mends it";
    unit().connect_encoder(false);
    EXPECT_EQ(first(), "no_encoder");
    unit().connect_encoder(true);
    unit().set_temperature(96'000);
    EXPECT_EQ(findings()[0].severity, Severity::stops);
    EXPECT_EQ(first(), "motor_hot");
}

TEST_F(MidiWhy, Supply) {
    unit().set_supply(20'000);
    EXPECT_EQ(first(), "under_voltage");
    unit().set_supply(90'000);
    EXPECT_EQ(first(), "over_voltage");
    unit().set_supply(48'000);
    EXPECT_EQ(findings()[0].code, "over_voltage_kept");
    unit().set_supply(10'000);
    EXPECT_EQ(first(), "supply_interrupted");
}

TEST_F(MidiWhy, EndStops) {
    unit().set_input(sim::MidiModule::Input::upper_stop, true);
    EXPECT_EQ(first(), "waits") << "they do not act";
    order(reg::END_STOPS, 9);
    EXPECT_EQ(first(), "at_upper_input");
    unit().set_input(sim::MidiModule::Input::upper_stop, false);
    order(reg::UPPER_STOP, -10);
    EXPECT_EQ(first(), "above_upper_stop");
    order(reg::LOWER_STOP, 10);
    EXPECT_EQ(first(), "stops_crossed");
}

TEST_F(MidiWhy, TorqueAndShaft) {
    order(reg::TORQUE, 10);
    EXPECT_EQ(first(), "torque_small");
    order(reg::TORQUE, 0);
    EXPECT_EQ(first(), "torque_zero");
    order(reg::TORQUE, 128);
    unit().hold_shaft(true);
    order(reg::GO_TO, 500);
    link.pause(std::chrono::seconds{1});
    EXPECT_EQ(first(), "does_not_follow");
    unit().hold_shaft(false);
    EXPECT_EQ(first(), "moves");
}

}  // namespace
}  // namespace nplc::macreg::midi
