#include <gtest/gtest.h>

#include "midi_client/master.h"
#include "midi_client/v24_link.h"
#include "sim/midi_ends.h"
#include "sim_wire.h"

namespace nplc::midi_client {
namespace {

namespace midi = registers::midi;

class ModuleUnit final : public mactalk_client::Unit {
  public:
    void receive(std::uint8_t byte, bool framing_error, base::Instant now) override {
        poll(now);
        end.receive(byte, framing_error);
    }
    std::optional<std::uint8_t> transmit(base::Instant now) override {
        poll(now);
        return end.transmit();
    }
    void poll(base::Instant now) override { module.advance(sim::Time(now.time_since_epoch())); }

    sim::MidiModule module{midi::Model::mac34_1};
    sim::MidiV24End end{module};
};

/// 2 % of the characters lost, damaged or with framing errors: every value read is right, and every order
/// that counts as carried out was.
TEST(Noise, ValuesAreRightAndOrdersAreWhatTheySay) {
    unsigned doubtful = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        ModuleUnit unit;
        mactalk_client::SimWire wire(unit, 38'400, seed);
        V24Link link(wire, {.patience = base::Milliseconds{30}});
        Master master(link, 30);
        wire.set_faults({.drop = 0.007, .damage = 0.007, .framing = 0.006});
        std::int32_t tolerance = 0;
        for (std::int32_t i = 0; i < 100; ++i) {
            const Answer answer = master.try_command(0, midi::TOLERANCE, static_cast<std::uint32_t>(i));
            if (answer.kind == Answer::Kind::accepted) {
                ASSERT_EQ(unit.module.memory().tolerance, i);
                tolerance = i;
            } else {
                ++doubtful;
                tolerance = unit.module.memory().tolerance;
            }
            ASSERT_EQ(master.query(0, midi::GET_SETTINGS) & 0xFF, static_cast<std::uint32_t>(tolerance));
        }
    }
    EXPECT_GT(doubtful, 0u) << "the line was too good to test anything";
}

/// After any noise the next message is understood.
TEST(Noise, InStepWithinOneFrame) {
    ModuleUnit unit;
    mactalk_client::SimWire wire(unit, 38'400, 1);
    V24Link link(wire);
    Master master(link, 1);
    for (const std::vector<std::uint8_t>& noise : std::vector<std::vector<std::uint8_t>>{
             {0x02}, {0x02, '0', '1', '4', '0', '0'}, {0x06, 0x13}, {0xFF, 0x00, 0x55}, {0x02, 0x02, 0x03}}) {
        wire.write(noise);
        EXPECT_EQ(master.query(0, midi::GET_RELEASE), 0x704u);
    }
}

}  // namespace
}  // namespace nplc::midi_client
