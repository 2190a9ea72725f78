#include "macreg/midi/module.h"

#include <gtest/gtest.h>

#include "midi_client/v24_link.h"
#include "rack_wire.h"

namespace nplc::macreg::midi {
namespace {

class MidiModuleTest : public testing::Test {
  protected:
    sim::MidiModule& unit() { return wire.rack.module(0); }

    midi_client::RackWire wire{{{reg::Model::mac34_1, 0}}};
    midi_client::V24Link link{wire};
    midi_client::Master master{link};
    Module module{master, 0, reg::Model::mac34_1};
};

TEST_F(MidiModuleTest, EveryParameterIsWrittenAndReadBack) {
    for (const Parameter& one : parameters()) {
        if (!one.command || !one.query) continue;
        const ChangeResult outcome = module.change(one, 1);
        EXPECT_TRUE(outcome.taken) << one.name;
        EXPECT_EQ(outcome.after, 1) << one.name;
        EXPECT_EQ(module.read_all().raw(one), 1) << one.name;
    }
    EXPECT_EQ(unit().memory().period, 1);
    EXPECT_EQ(unit().memory().ramp, 1);
    EXPECT_EQ(unit().memory().unstall, 1);
    EXPECT_EQ(unit().memory().torque, 1);
    EXPECT_EQ(unit().memory().stops, 1);
    EXPECT_EQ(unit().memory().tolerance, 1);
    EXPECT_EQ(unit().memory().upper_stop, 1);
    EXPECT_EQ(unit().memory().lower_stop, 1);
    EXPECT_TRUE(unit().memory().standby);
    EXPECT_TRUE(module.change(*find_parameter("REFERENCE"), 1).taken);
}

TEST_F(MidiModuleTest, RefusalsAreExplained) {
    module.order(reg::RUN, 800);
    const ChangeResult outcome = module.change(*find_parameter("SPEED"), 100);
    EXPECT_FALSE(outcome.taken);
    EXPECT_EQ(outcome.why, "it is refused while the axis moves; `macreg midi stop` stops it");
    module.order(reg::EMERGENCY_STOP);
    EXPECT_EQ(module.refusal(reg::TORQUE, 0x81), "the most is 128 (IMAX)");
    module.order(reg::SEGMENT, 0x7FFF'1000);
    EXPECT_THROW(module.order(reg::STOP), midi_client::Refused);
    EXPECT_NE(module.refusal(reg::STOP, 0).find("--emergency"), std::string::npos);
    unit().overload_amplifier();
    try {
        module.order(reg::GO_TO, 5);
        FAIL();
    } catch (const midi_client::Refused& error) {
        EXPECT_EQ(
            std::string(error.what()).find("address 0 refuses GO_TO: the module has a fault (tripped: amp"),
            0u)
            << error.what();
    }
}

}  // namespace
}  // namespace nplc::macreg::midi
