// Why a MIDI drive does not move, as reported by the gateway that controls it.
#include "causes/midi_why.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "causes/codes.h"
#include "faces/axis_loop.h"
#include "faces/midi_watch.h"
#include "program.h"
#include "registers/gateway.h"
#include "sim/world.h"

namespace nplc::faces {
namespace {

namespace gw = registers::gateway;
using causes::GatewayState;
using causes::MidiState;
using gw::DriveFault;
using registers::midi::Model;
using namespace std::chrono_literals;

constexpr std::uint32_t kRunning = 2;
constexpr GatewayState kRuns{.status = kRunning | gw::kLinkDelivers};

MidiState healthy() {
    return {.model = Model::mac34_1,
            .torque = 128,
            .most_torque = 128,
            .period = 80,
            .driver = causes::MidiDriver{}};
}

std::string first(const MidiState& drive, const GatewayState& gateway = kRuns) {
    return causes::why(drive, gateway).front().code;
}

bool has(const MidiState& drive, std::string_view code, const GatewayState& gateway = kRuns) {
    const auto all = causes::why(drive, gateway);
    return std::any_of(all.begin(), all.end(), [&](const causes::Finding& one) { return one.code == code; });
}

TEST(MidiWhyOfAGateway, ItsSequenceIsTheCause) {
    EXPECT_EQ(first(healthy()), "gateway_runs");
    EXPECT_EQ(first(healthy(), {.status = gw::kLinkDelivers}), "gateway_stopped");
    EXPECT_EQ(first(healthy(), {.status = gw::kLinkDelivers | gw::kSafe, .safe_reason = 2}), "gateway_safe");
}

TEST(MidiWhyOfAGateway, WithoutALineNothingElseIsKnown) {
    MidiState drive = healthy();
    drive.status = registers::midi::kThermalTrip;
    drive.torque = 0;
    drive.turns = true;
    EXPECT_EQ(first(drive, {.status = kRunning}), "gateway_link_down");
    EXPECT_FALSE(has(drive, "motor_hot", {.status = kRunning}));
    EXPECT_FALSE(has(drive, "torque_zero", {.status = kRunning}));
    drive.driver->fault = DriveFault::several;
    EXPECT_EQ(first(drive, {.status = kRunning}), "same_address");
}

TEST(MidiWhyOfAGateway, EveryFaultOfItsDriverIsACause) {
    for (unsigned fault = 1; fault <= static_cast<unsigned>(DriveFault::jumped); ++fault) {
        MidiState drive = healthy();
        drive.driver->fault = static_cast<DriveFault>(fault);
        if (drive.driver->fault == DriveFault::tripped) drive.status = registers::midi::kEncoderTrip;
        const auto all = causes::why(drive, kRuns);
        EXPECT_EQ(all.front().severity, causes::Severity::stops) << fault;
        EXPECT_NE(causes::number_of(all.front().code), 0) << all.front().code;
    }
}

TEST(MidiWhyOfAGateway, AMotionIsToldFirst) {
    MidiState drive = healthy();
    drive.turns = true;
    EXPECT_EQ(first(drive), "moves");
    drive.turns = false;
    drive.is_stuck = true;
    EXPECT_EQ(first(drive), "does_not_follow");
    drive.is_stuck = false;
    drive.driver->is_at_target = true;
    EXPECT_EQ(first(drive), "at_target");
    drive.driver->has_no_speed = true;
    EXPECT_EQ(first(drive), "velocity_zero");
    drive.torque = 0;
    EXPECT_EQ(first(drive), "torque_zero");
    drive.torque.reset();
    EXPECT_FALSE(has(drive, "torque_zero")) << "nobody knows";
}

/// Where a remedy names the module's own tool, it says that the line is the gateway's.
TEST(MidiWhyOfAGateway, ALineHasOneMaster) {
    MidiState drive = healthy();
    drive.torque = 0;
    EXPECT_NE(causes::why(drive, kRuns).front().remedy.find("stop the gateway"), std::string::npos);
    EXPECT_EQ(causes::why(drive).front().remedy.find("stop the gateway"), std::string::npos);
}

class MidiMachine : public testing::Test {
  protected:
    MidiMachine() { options_.drive = sim::VirtualDriveOptions{.model = registers::find_drive("MAC34-1")}; }

    /// The first cause, once it is the wanted one; the last one seen after 20 s.
    std::string wait_for(std::string_view wanted) {
        std::string seen;
        const sim::Time end = world().now() + 20s;
        while (world().now() < end && seen != wanted) {
            world().step(world().now() + 10ms);
            const auto drive = watch_.look(world().any_driver(), world().instant());
            if (!drive) return "no MIDI drive";
            std::uint32_t status = kRunning;
            if (motor::link_is_usable(world().driver().link())) status |= gw::kLinkDelivers;
            seen = first(*drive, {.status = status});
        }
        return seen;
    }
    sim::World& world() {
        if (!world_) world_.emplace(sim::load_program(MENDING).table, options_);
        return *world_;
    }

    sim::WorldOptions options_;
    std::optional<sim::World> world_;
    MidiWatch watch_;
};

TEST_F(MidiMachine, MovesAndIsHeldAndTrips) {
    ASSERT_EQ(world().drive()->act(sim::action::StopMotor{.above = true, .counts = 1'000}), "");
    EXPECT_EQ(wait_for("moves"), "moves");
    EXPECT_EQ(wait_for("does_not_follow"), "does_not_follow");
    ASSERT_EQ(world().drive()->act(sim::action::FreeMotor{}), "");
    EXPECT_EQ(wait_for("moves"), "moves");
    ASSERT_EQ(world().drive()->act(sim::action::MotorSupply{.volts = 10}), "");
    EXPECT_EQ(wait_for("supply_interrupted"), "supply_interrupted");
    world().drive()->cut(true);
    EXPECT_EQ(wait_for("gateway_link_down"), "gateway_link_down");
}

/// As the plant's command 33 does.
TEST_F(MidiMachine, AnErrorIsClearedByAFace) {
    AxisModel model("x");
    AxisLoop loop(model, {});
    Bell bell([] {});
    const auto plc = model.join(Side::plant, "PLC", bell);
    const auto tell = [&](const Command& command) {
        EXPECT_TRUE(plc->submit(command));
        std::optional<Completion> ended;
        while (!ended) {
            world().step(world().now() + 1ms);
            loop.poll(world().controller(), world().instant(), world().instant(), &world().any_driver());
            ended = plc->take();
        }
        return ended->result;
    };
    EXPECT_EQ(wait_for("moves"), "moves");
    EXPECT_EQ(tell(Command::reset_error(world().instant())), Result::not_allowed)
        << "while the sequence runs";
    EXPECT_EQ(tell(Command::of(gw::Command::stop, world().instant())), Result::done);
    ASSERT_EQ(world().drive()->act(sim::action::MotorSupply{.volts = 10}), "");
    EXPECT_EQ(wait_for("supply_interrupted"), "supply_interrupted");
    ASSERT_EQ(world().drive()->act(sim::action::MotorSupply{.volts = 48}), "");
    EXPECT_EQ(tell(Command::reset_error(world().instant())), Result::done);
    EXPECT_EQ(wait_for("gateway_runs"), "gateway_runs")
        << "the state that wait_for() names: nothing else is found";
    EXPECT_FALSE(world().driver().error());
}

TEST_F(MidiMachine, OfAnotherDriveItKnowsNothing) {
    options_.drive.reset();
    EXPECT_FALSE(watch_.look(world().any_driver(), world().instant()));
}

}  // namespace
}  // namespace nplc::faces
