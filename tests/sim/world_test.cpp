#include "sim/world.h"

#include <gtest/gtest.h>

#include <deque>
#include <vector>

#include "sequencer/term.h"
#include "tables.h"

namespace nplc::sim {
namespace {

using namespace std::chrono_literals;
using sequencer::Term;

// FastMAC, 001 §5.2.1.4: position mode 10, P register 00xxx; P1 is 40h, P2 41h; command mode 11, number 01h
// is 61h.
constexpr std::uint8_t kPositionP1 = 0x40;
constexpr std::uint8_t kResetError = 0x61;
constexpr std::int32_t kTarget = 8192;  // two revolutions

Term term(std::uint8_t step, std::uint8_t input, std::uint8_t care, std::uint8_t next, std::uint8_t outputs) {
    Term result;
    result.condition = {
        .step = step, .needs_counter_zero = false, .needs_timer_zero = false, .input = input, .care = care};
    result.fast.next_step = next;
    result.fast.outputs = outputs;
    return result;
}

Term write(std::uint8_t step, std::uint8_t reg, bool longword, std::uint16_t value) {
    Term result = term(step, 0, 0, 0, 0);
    result.is_flex = true;
    result.flex = {.reg = reg, .longword = longword, .low_word = value, .high_word = 0};
    return result;
}

/// Step 0 writes P1, V1 and A1; step 1 waits for IN0; step 2 goes to P1 with OUT0 and waits for INPOS; step 3
/// has OUT1. An error leads to step 4, where IN1 acknowledges and leads to step 5.
std::vector<std::uint8_t> table() {
    const std::vector<Term> terms{
        write(0, registers::P1, true, kTarget),
        write(0, registers::V1, false, 2000),
        write(0, registers::A1, false, 80),
        with_command(term(0, 0, 0, 1, 0), 0x08),        // INIT(V1)
        with_command(term(1, 0x01, 0x01, 2, 1), 0x10),  // INIT(A1)
        with_command(term(2, 0, 0x40, 6, 1), kPositionP1),
        term(6, 0x40, 0x40, 3, 2),
        term(1, 0x80, 0, 4, 8),
        term(2, 0x80, 0, 4, 8),
        term(3, 0x80, 0, 4, 8),
        term(6, 0x80, 0, 4, 8),
        with_command(term(4, 0x82, 0x02, 5, 8), kResetError),
    };
    return table_of(terms);
}

class WorldRun : public testing::Test {
  protected:
    explicit WorldRun(const WorldOptions& options = {}) : world_(table(), options) {}

    void run_to(Time time) {
        while (world_.now() < time) world_.step(time);
    }
    /// False when it has not come true by `limit`.
    template <class Condition>
    bool run_until(Condition condition, Time limit) {
        while (world_.now() < limit) {
            world_.step(limit);
            if (condition()) return true;
        }
        return false;
    }
    std::uint8_t step() const { return world_.gateway().state().step; }

    World world_;
};

TEST_F(WorldRun, TimeStopsExactlyAtTheLimit) {
    run_to(Time(12'345'678));
    EXPECT_EQ(world_.now(), Time(12'345'678));
    run_to(Time(12'345'679));
    EXPECT_EQ(world_.now(), Time(12'345'679));
}

TEST_F(WorldRun, TheMotorsLineIsFullWithoutPause) {
    run_to(1s);
    // 19200 baud, 10 bits: 1920 characters end in a second, one more is under way.
    EXPECT_EQ(world_.line().from_motor().counters().delivered, 1920U);
    EXPECT_EQ(world_.line().from_motor().counters().sent, 1921U);
    EXPECT_EQ(world_.line().overruns(), 0U);
}

TEST_F(WorldRun, ASequenceMovesTheMotor) {
    ASSERT_TRUE(run_until([&] { return step() == 1; }, 1s));
    EXPECT_EQ(world_.board().outputs(), 0);
    world_.set_input(0, true);
    ASSERT_TRUE(run_until([&] { return step() == 3; }, 3s)) << "step " << int{step()};
    EXPECT_EQ(world_.board().outputs(), 2);
    run_to(world_.now() + 500ms);
    EXPECT_NEAR(world_.mac().p_ist(), kTarget, 2);
}

// A stop in the way, then gone: a move of two revolutions (8192 counts) gets as far as 5000.
TEST_F(WorldRun, AStopHoldsTheShaft) {
    world_.act(action::StopMotor{.above = true, .counts = 5000});
    world_.set_input(0, true);
    run_to(2s);
    EXPECT_EQ(world_.take_snapshot().shaft, 5000);
    EXPECT_GT(world_.take_snapshot().torque, 0);
    world_.act(action::FreeMotor{});
    EXPECT_TRUE(run_until([&] { return step() == 3; }, 5s));
}

// A jam, wherever the shaft is: it is not thrown to the place named.
TEST_F(WorldRun, AStopThatTheShaftIsBeyondHoldsItWhereItIs) {
    world_.set_input(0, true);
    ASSERT_TRUE(run_until([&] { return world_.mac().p_ist() > 1000; }, 2s));
    const std::int32_t jammed_at = world_.mac().p_ist();
    world_.act(action::StopMotor{.above = true, .counts = -500});
    run_to(world_.now() + 1s);
    EXPECT_NEAR(world_.mac().p_ist(), jammed_at, 1);
}

// 512 of torque a revolution of 4096 counts are 1/8 a count.
TEST_F(WorldRun, ASpringGivesWay) {
    world_.act(action::StopMotor{.above = true, .counts = 0, .torque_per_count = 512.0 / 4096});
    world_.act(action::LoadMotor{100});
    run_to(5s);
    // 100 of torque, less 5 of friction, at 1/8 a count
    EXPECT_NEAR(static_cast<double>(world_.take_snapshot().shaft), 760, 16);
}

TEST_F(WorldRun, TheAnalogueInputHasASensorOrAVoltage) {
    const auto aninp = [&] {
        run_to(world_.now() + 5ms);
        return world_.mac().read(registers::ANINP);
    };
    world_.act(action::MotorSensor{.on_above = false, .counts = 100});
    EXPECT_EQ(aninp(), 1023);
    world_.act(action::MotorSensor{.on_above = true, .counts = 100});
    EXPECT_EQ(aninp(), 0);
    world_.act(action::MotorAnalogue{-5});
    EXPECT_EQ(aninp(), -511);
}

// MAC140's pins carry FastMAC; a MAC800 counts 77,000 / 770 Hz = 100 a sample.
TEST_F(WorldRun, PulsesReachOnlyAMotorWithAnInputForThem) {
    world_.act(action::MotorPulses{77'000});
    run_to(100ms);
    EXPECT_EQ(world_.mac().read(registers::V_EXT), 0);
    WorldOptions options;
    options.motor = registers::Model::mac800;
    World big(table(), options);
    big.act(action::MotorPulses{77'000});
    while (big.now() < 20ms) big.step(20ms);
    constexpr std::uint8_t kVExt = 163;
    EXPECT_NEAR(big.mac().read(kVExt), 100, 1);
}

// 24 V / 53.7 mV = 447 (001 §3.2.151).
TEST_F(WorldRun, TheSupplyCanSag) {
    world_.act(action::MotorSupply{.volts = 24});
    run_to(500ms);
    EXPECT_NEAR(world_.mac().read(151), 447, 2);
}

// 004: ERR_STAT bits 8, 15 and 17; the encoder is whole again after power off and on.
TEST_F(WorldRun, AMac800FeelsItsSurroundings) {
    WorldOptions options;
    options.motor = registers::Model::mac800;
    World big(table(), options);
    const auto err_stat_after = [&big](Time time) {
        const Time end = big.now() + time;
        while (big.now() < end) big.step(end);
        return big.mac().read(registers::ERR_STAT);
    };
    EXPECT_EQ(err_stat_after(20ms) & 0x2BB8F, 0);
    big.act(action::MotorTemperature{120});
    EXPECT_EQ(err_stat_after(20ms) & 0x2BB8F, 1 << 8);
    big.act(action::MotorSupply{.volts = 12, .logic = true});
    EXPECT_EQ(err_stat_after(20ms) & 0x2BB8F, 1 << 8 | 1 << 17);
    big.act(action::BreakEncoder{});
    EXPECT_EQ(err_stat_after(20ms) & 0x2BB8F, 1 << 8 | 1 << 15 | 1 << 17);
    big.act(action::MotorTemperature{25});
    big.act(action::MotorSupply{.volts = 24, .logic = true});
    big.power_motor(false);
    big.power_motor(true);
    EXPECT_EQ(err_stat_after(20ms) & 0x2BB8F, 0);
}

// 004: ERR_STAT bits; 001 §5.2.1.6: the status byte's error bit tells of bits 0 to 3 only.
TEST_F(WorldRun, AFaultOfAMac800IsSaidInGearModeToo) {
    const auto note_after = [](const action::OnMotor& what) {
        WorldOptions options;
        options.motor = registers::Model::mac800;
        World big(table(), options);
        const auto pass = [&big](Time time) {
            const Time end = big.now() + time;
            while (big.now() < end) big.step(end);
        };
        pass(50ms);
        big.mac().write(registers::MODE_REG, 3);  // GP_MODE
        big.act(action::MotorPulses{40'000});
        pass(200ms);
        EXPECT_EQ(big.motor_note(), "");
        big.act(what);
        pass(300ms);
        EXPECT_EQ(big.mac().mode(), 0) << "passive";
        const std::string note = big.motor_note();
        EXPECT_NE(note.find("no ERROR for the sequence"), std::string::npos) << note;
        big.power_motor(false);
        EXPECT_EQ(big.motor_note(), "");
        return note;
    };
    EXPECT_TRUE(note_after(action::MotorSupply{.volts = 500}).starts_with("OV_ERR: "));
    EXPECT_TRUE(note_after(action::MotorSupply{.volts = 10, .logic = true}).starts_with("U24V_ERR: "));
    EXPECT_TRUE(note_after(action::MotorTemperature{120}).starts_with("DEGC_ERR: "));
    EXPECT_TRUE(note_after(action::BreakEncoder{}).starts_with("INDEX_ERR: "));
}

// 001 §4.5.6: UV_GO_PASSIVE is bit 1 of UV_HANDLE, register 160. U_MIN_SUP is 152, in 53.7 mV: 16 V.
TEST_F(WorldRun, AMotorThatIsPassiveForUndervoltageIsSaid) {
    run_to(100ms);
    world_.mac().write(152, 300);
    world_.mac().write(160, 2);
    world_.mac().write(registers::MODE_REG, 2);
    world_.act(action::MotorSupply{.volts = 10});
    run_to(500ms);
    EXPECT_EQ(world_.mac().mode(), 0);
    EXPECT_TRUE(world_.motor_note().starts_with("UV_DETECT: ")) << world_.motor_note();
}

TEST_F(WorldRun, AnErrorThatTheSequenceSeesIsSaidToo) {
    run_to(100ms);
    world_.fail_motor();
    run_to(200ms);
    EXPECT_TRUE(world_.motor_note().starts_with("I2T_ERR: ")) << world_.motor_note();
    EXPECT_EQ(world_.motor_note().find("no ERROR"), std::string::npos);
}

TEST_F(WorldRun, WhatDoesNothingIsSaid) {
    std::vector<std::string> said;
    world_.on_log([&said](const std::string& text) { said.push_back(text); });
    world_.act(action::MotorPulses{5'000});
    EXPECT_TRUE(said.empty()) << "set up before the run begins";
    run_to(100ms);
    world_.power_motor(true);
    world_.power_motor(false);
    world_.fail_motor();
    world_.act(action::MotorSupply{.volts = 30});
    world_.power_motor(true);
    world_.gateway(action::Gateway::stop);
    world_.gateway(action::Gateway::stop);
    world_.gateway(action::Gateway::run);
    world_.gateway(action::Gateway::hold);
    world_.gateway(action::Gateway::step);
    ASSERT_EQ(said.size(), 7U);
    EXPECT_EQ(said[0], "motor power on: nothing follows: it has its supply already");
    EXPECT_EQ(said[1], "motor error: nothing follows: it has no supply (motor power off)");
    EXPECT_EQ(said[2], "motor supply: nothing follows: it has no supply (motor power off)");
    EXPECT_EQ(said[3], "gateway stop: the sequence is stopped already");
    EXPECT_TRUE(said[4].starts_with("gateway run: refused: ")) << "the motor has not confirmed the stop yet";
    EXPECT_EQ(said[5], "gateway hold: refused: the sequence does not run");
    EXPECT_TRUE(said[6].starts_with("gateway step: refused: "));
    run_to(400ms);
    EXPECT_EQ(world_.mac().err_stat() & 0x0F, 0U) << "the error of before is not kept for later";
}

// 004, MAN_NO_BRAKE: the output holds while the motor is passive, if a brake is built in. Less than the pull
// it does not hold.
TEST_F(WorldRun, AMac800CanHaveABrake) {
    WorldOptions options;
    options.motor = registers::Model::mac800;
    World big(table(), options);
    big.cut_line(true);  // the motor stays in INIT
    const auto turned_in = [&big](Time time) {
        const std::int64_t before = big.take_snapshot().shaft;
        const Time end = big.now() + time;
        while (big.now() < end) big.step(end);
        return big.take_snapshot().shaft - before;
    };
    big.act(action::MotorBrake{300});
    big.act(action::LoadMotor{100});
    EXPECT_EQ(turned_in(500ms), 0);
    big.act(action::MotorBrake{80});
    EXPECT_GT(turned_in(500ms), 10);
    big.act(action::MotorBrake{0});
    EXPECT_GT(turned_in(500ms), 100);
}

TEST_F(WorldRun, SnapshotsHandOverTheOrdersOnce) {
    ASSERT_TRUE(run_until([&] { return step() == 1; }, 1s));
    const Snapshot first = world_.take_snapshot();
    ASSERT_EQ(first.orders.size(), 4U);
    EXPECT_EQ(first.orders[0],
              (SentOrder{.is_register_write = true, .reg = registers::P1, .value = std::uint32_t{kTarget}}));
    EXPECT_EQ(first.orders[3], (SentOrder{.command = 0x08}));
    EXPECT_TRUE(first.link_up);
    EXPECT_TRUE(first.running);
    EXPECT_TRUE(world_.take_snapshot().orders.empty());
}

// The first scan gives four orders; each takes some milliseconds on the line.
TEST_F(WorldRun, OrdersAreOnTheirWayUntilTheyAreExecuted) {
    using Numbers = std::deque<std::size_t>;
    ASSERT_TRUE(run_until([&] { return !world_.on_their_way().empty(); }, 1s));
    EXPECT_EQ(world_.on_their_way(), (Numbers{0, 1, 2, 3}));
    ASSERT_TRUE(run_until([&] { return world_.on_their_way().size() != 4; }, 1s));
    EXPECT_EQ(world_.on_their_way(), (Numbers{1, 2, 3}));
    ASSERT_TRUE(run_until([&] { return world_.on_their_way().empty(); }, 1s));
    EXPECT_EQ(world_.driver().counters().orders, 4U);
}

TEST_F(WorldRun, OrdersThatAreGivenUpAreNotOnTheirWay) {
    ASSERT_TRUE(run_until([&] { return !world_.on_their_way().empty(); }, 1s));
    world_.gateway(action::Gateway::stop);
    EXPECT_LE(world_.on_their_way().size(), 1U) << "only what is on the line already";
    ASSERT_TRUE(run_until([&] { return !world_.gateway().stop_unconfirmed(); }, 2s));
    EXPECT_TRUE(world_.on_their_way().empty());
    world_.gateway(action::Gateway::run);
    ASSERT_TRUE(run_until([&] { return !world_.on_their_way().empty(); }, 3s));
    EXPECT_EQ(world_.on_their_way(), (std::deque<std::size_t>{4, 5, 6, 7}));
    world_.cut_line(true);
    ASSERT_TRUE(run_until([&] { return !motor::link_is_usable(world_.driver().link()); }, 6s));
    EXPECT_TRUE(world_.on_their_way().empty());
}

TEST_F(WorldRun, ARestartForgetsWhatWasOnItsWay) {
    ASSERT_TRUE(run_until([&] { return !world_.on_their_way().empty(); }, 1s));
    world_.gateway(action::Gateway::restart);
    EXPECT_TRUE(world_.on_their_way().empty());
}

TEST_F(WorldRun, ACutLineIsAnErrorUntilItIsAcknowledged) {
    ASSERT_TRUE(run_until([&] { return step() == 1; }, 1s));
    const Time cut = world_.now();
    world_.cut_line(true);
    ASSERT_TRUE(run_until([&] { return step() == 4; }, cut + 1s));
    EXPECT_EQ(world_.gateway().safe_reason(), gateway::SafeReason::link_down);
    EXPECT_EQ(world_.board().outputs(), 0) << "safe outputs while the link is down";
    // Silence of 20 ms, counted from the last character; one poll and one character more at the most.
    EXPECT_LE(world_.now() - cut, Time(21ms));
    world_.cut_line(false);
    run_to(world_.now() + 200ms);
    EXPECT_TRUE(world_.take_snapshot().error);
    world_.set_input(1, true);
    ASSERT_TRUE(run_until([&] { return step() == 5; }, world_.now() + 1s));
    run_to(world_.now() + 100ms);
    EXPECT_FALSE(world_.take_snapshot().error);
    EXPECT_EQ(world_.board().outputs(), 8);
}

TEST_F(WorldRun, AMotorErrorIsSeenAndCanBeReset) {
    ASSERT_TRUE(run_until([&] { return step() == 1; }, 1s));
    world_.fail_motor();
    ASSERT_TRUE(run_until([&] { return step() == 4; }, world_.now() + 100ms));
    world_.set_input(1, true);
    ASSERT_TRUE(run_until([&] { return step() == 5; }, world_.now() + 100ms));
    run_to(world_.now() + 100ms);
    EXPECT_FALSE(world_.take_snapshot().error);
}

TEST_F(WorldRun, AMotorWithoutPowerIsSilent) {
    ASSERT_TRUE(run_until([&] { return step() == 1; }, 1s));
    world_.power_motor(false);
    ASSERT_TRUE(run_until([&] { return step() == 4; }, world_.now() + 100ms));
    const auto sent = world_.line().from_motor().counters().sent;
    run_to(world_.now() + 100ms);
    EXPECT_EQ(world_.line().from_motor().counters().sent, sent);
    world_.power_motor(true);
    run_to(world_.now() + 200ms);
    EXPECT_TRUE(world_.take_snapshot().link_up);
}

// 240 rpm are 4 rev/s x 4096 / 520.8333 = 31.46 counts a sample; friction of 5 of 1023 takes 5 / 1023 x 3500
// / 16 = 1.07 counts/sample^2 off a bare motor (1.09 with the current loop's share): 29 samples of 1.92 ms
// and 31.46^2 / 2 / 1.08 = 458 counts.
TEST_F(WorldRun, AMotorWithoutPowerRunsOut) {
    const std::vector<Term> terms{write(0, registers::V1, false, 503),
                                  with_command(term(0, 0, 0, 1, 0), 0x28)};
    World world(table_of(terms), {});
    const auto run = [&](Time time) {
        const Time end = world.now() + time;
        while (world.now() < end) world.step(end);
        return world.take_snapshot();
    };
    const Snapshot running = run(1s);
    EXPECT_NEAR(running.v_ist, 31, 1);
    world.power_motor(false);
    EXPECT_GT(run(40ms).v_ist, 5);
    const Snapshot out = run(25ms);
    EXPECT_EQ(out.v_ist, 0);
    EXPECT_EQ(out.torque, 0);
    EXPECT_NEAR(static_cast<double>(out.shaft - running.shaft), 458, 20);
    EXPECT_EQ(out.p_ist, running.p_ist) << "nobody counts";
    EXPECT_EQ(run(1s).shaft, out.shaft);
    world.act(action::LoadMotor{100});
    EXPECT_GT(run(100ms).shaft, out.shaft + 1000) << "nothing holds it";
}

// 004 HW_SETUP: XPRINP is the format of the pulse input, INVXDIR its sign. 77,000 pulses a second at 770 Hz.
TEST(World, HwSetupIsGivenFromTheStart) {
    WorldOptions options;
    options.motor = registers::Model::mac800;
    options.registers = {{.number = 39, .bits = 0x50}};
    World world(table(), options);
    world.act(action::MotorPulses{.per_second = 7'700, .with_direction = true});
    while (world.now() < 20ms) world.step(20ms);
    EXPECT_EQ(world.mac().read(39), 0x50);
    EXPECT_NEAR(world.mac().read(163), -10, 1);
}

TEST_F(WorldRun, AMotorMayBeOffForLessThanACharacter) {
    run_to(500ms);
    world_.power_motor(false);
    run_to(world_.now() + 100us);
    world_.power_motor(true);
    run_to(world_.now() + 500ms);
    EXPECT_TRUE(world_.take_snapshot().link_up);
}

TEST_F(WorldRun, TheGatewayCanBeStoppedRunAndRestarted) {
    ASSERT_TRUE(run_until([&] { return step() == 1; }, 1s));
    world_.gateway(action::Gateway::stop);
    EXPECT_FALSE(world_.take_snapshot().running);
    EXPECT_EQ(world_.gateway().safe_reason(), gateway::SafeReason::stop_command);
    world_.gateway(action::Gateway::run);
    EXPECT_FALSE(world_.take_snapshot().running) << "the motor has not confirmed the stop yet";
    ASSERT_TRUE(run_until([&] { return !world_.gateway().stop_unconfirmed(); }, world_.now() + 1s));
    world_.gateway(action::Gateway::run);
    EXPECT_EQ(step(), 0);
    ASSERT_TRUE(run_until([&] { return step() == 1; }, world_.now() + 1s));
    world_.gateway(action::Gateway::restart);
    EXPECT_EQ(step(), 0);
    EXPECT_TRUE(run_until([&] { return step() == 1; }, world_.now() + 1s));
}

TEST_F(WorldRun, TheGatewayIsHeldStepsAndStopsAtABreakpoint) {
    using gateway::RunState;
    const auto state = [&] { return world_.gateway().run_state(); };
    ASSERT_TRUE(run_until([&] { return step() == 1; }, 1s));
    world_.gateway(action::Gateway::hold);
    ASSERT_TRUE(run_until([&] { return state() == RunState::held; }, 2s));
    world_.set_input(0, true);
    run_to(world_.now() + 200ms);
    EXPECT_EQ(step(), 1);
    world_.gateway(action::Gateway::step);
    ASSERT_TRUE(run_until([&] { return step() == 2 && state() == RunState::held; }, 3s));
    world_.set_breakpoints({.steps = 1U << 3});
    world_.gateway(action::Gateway::run);
    ASSERT_TRUE(run_until([&] { return state() == RunState::held; }, 6s));
    EXPECT_EQ(step(), 3);
    EXPECT_TRUE(world_.gateway().at_breakpoint());
    world_.gateway(action::Gateway::safe);
    EXPECT_EQ(world_.gateway().safe_reason(), gateway::SafeReason::safe_command);
    EXPECT_EQ(world_.gateway().breakpoints(), 0U);
}

// A client's forces end 5 s after it has fallen silent; a scenario's last until it releases them.
TEST_F(WorldRun, AScenariosForcesLastUntilTheyAreReleased) {
    ASSERT_TRUE(run_until([&] { return step() == 1; }, 1s));
    world_.force({.outputs = true, .mask = 4, .levels = 4});
    world_.force({.outputs = false, .mask = 2, .levels = 2});
    run_to(12s);
    EXPECT_EQ(world_.board().outputs(), 4);
    EXPECT_EQ(world_.gateway().inputs(), 2);
    EXPECT_EQ(world_.board().inputs(), 0) << "the terminals are what they were";
    world_.force({.outputs = true, .mask = 4, .releases = true});
    run_to(world_.now() + 10ms);
    EXPECT_EQ(world_.board().outputs(), 0);
    EXPECT_EQ(world_.gateway().inputs(), 2);
    world_.gateway(action::Gateway::restart);
    run_to(world_.now() + 10ms);
    EXPECT_EQ(world_.gateway().inputs(), 0);
}

TEST_F(WorldRun, AScenarioDoesNotKeepAClientsForces) {
    world_.force({.outputs = true, .mask = 4, .levels = 4});
    world_.force({.outputs = true, .mask = 4, .releases = true});
    run_to(world_.now() + 10ms);
    world_.controller().sequence().force_outputs({.mask = 2, .levels = 2}, world_.instant());
    world_.force({.outputs = true, .mask = 1, .releases = true});
    run_to(world_.now() + 4s);
    EXPECT_EQ(world_.gateway().forces().outputs().mask, 2);
    run_to(world_.now() + 2s);
    EXPECT_EQ(world_.gateway().forces().outputs().mask, 0);
}

// The gateway's README: a stop command leads to the safe state, and run() starts again from step 0.
TEST_F(WorldRun, AStopTakesTheOutputsAwayAndARunBeginsWithoutThem) {
    const auto outputs = [&] { return world_.take_snapshot().outputs; };
    ASSERT_TRUE(run_until([&] { return step() == 1; }, 1s));
    world_.set_input(0, true);
    ASSERT_TRUE(run_until([&] { return outputs() == 1; }, 2s)) << "the clamp is shut";
    world_.gateway(action::Gateway::stop);
    EXPECT_EQ(outputs(), 0) << "in the same instant";
    world_.set_input(0, false);
    run_to(world_.now() + 2s);
    EXPECT_EQ(outputs(), 0);
    EXPECT_EQ(world_.mac().v_ist(), 0);
    world_.gateway(action::Gateway::run);
    ASSERT_TRUE(run_until([&] { return step() == 1; }, world_.now() + 1s));
    run_to(world_.now() + 1s);
    EXPECT_EQ(outputs(), 0) << "the step that shut it has not come yet";
    world_.set_input(0, true);
    EXPECT_TRUE(run_until([&] { return outputs() == 1; }, world_.now() + 1s));
}

// REGISTERS.md: the safe state overrides forced outputs; a stop does not end forces, a restart does.
TEST_F(WorldRun, AForceOutlastsAStopAndARunAndNotARestart) {
    const auto outputs = [&] { return world_.take_snapshot().outputs; };
    ASSERT_TRUE(run_until([&] { return step() == 1; }, 1s));
    const base::Instant now(std::chrono::duration_cast<base::Microseconds>(world_.now()));
    world_.controller().sequence().force_outputs({.mask = 4, .levels = 4}, now);
    EXPECT_EQ(outputs(), 4);
    world_.gateway(action::Gateway::stop);
    EXPECT_EQ(outputs(), 0);
    run_to(world_.now() + 500ms);
    EXPECT_EQ(outputs(), 0);
    world_.gateway(action::Gateway::run);
    ASSERT_TRUE(run_until([&] { return step() == 1; }, world_.now() + 1s));
    EXPECT_EQ(outputs(), 4) << "within its five seconds";
    world_.gateway(action::Gateway::restart);
    ASSERT_TRUE(run_until([&] { return step() == 1; }, world_.now() + 1s));
    EXPECT_EQ(outputs(), 0);
}

TEST(World, TheSameOptionsGiveTheSameRun) {
    const auto run = [](std::uint64_t seed) {
        WorldOptions options;
        options.seed = seed;
        options.faults = {.drop = 0.02, .damage = 0.02, .delay = 0.02};
        World world(table(), options);
        std::vector<std::int32_t> trail;
        while (world.now() < Time(1s)) {
            world.step(1s);
            if (world.gateway().state().step == 1) world.set_input(0, true);
            trail.push_back(world.mac().p_ist());
        }
        return trail;
    };
    EXPECT_EQ(run(11), run(11));
    EXPECT_NE(run(11), run(12));
}

class Models : public testing::TestWithParam<registers::Model> {};

TEST_P(Models, RunTheirSequence) {
    WorldOptions options;
    options.motor = GetParam();
    World world(table(), options);
    while (world.now() < Time(500ms)) world.step(500ms);
    EXPECT_EQ(world.gateway().state().step, 1);
}

INSTANTIATE_TEST_SUITE_P(World, Models,
                         testing::Values(registers::Model::mac50, registers::Model::mac95,
                                         registers::Model::mac140, registers::Model::mac141));

TEST(SimBoard, InputsAndOutputsAreWhatWasSet) {
    SimBoard board(base::Microseconds(1000));
    board.set_input(5, true);
    board.set_input(0, true);
    board.set_input(5, false);
    EXPECT_EQ(board.read(), 1);
    board.write(0xFF);
    EXPECT_EQ(board.outputs(), 0x0F);
}

TEST(SimBoard, TheWatchdogBitesWhenItIsNotFed) {
    SimBoard board(base::Microseconds(1000));
    const auto at = [](std::int64_t us) { return base::Instant(base::Microseconds(us)); };
    EXPECT_FALSE(board.watchdog_bites(at(5000))) << "it begins with the first feeding";
    board.feed();
    EXPECT_FALSE(board.watchdog_bites(at(6000)));
    EXPECT_FALSE(board.watchdog_bites(at(7000)));
    EXPECT_TRUE(board.watchdog_bites(at(7001)));
    EXPECT_FALSE(board.watchdog_bites(at(9000)));
    EXPECT_EQ(board.bites(), 1U);
}

}  // namespace
}  // namespace nplc::sim
