// Sentences 5 to 8 and 10 of what the gateway must never do, as far as the user port goes.
#include <gtest/gtest.h>

#include "base/bytes.h"
#include "base/crc32.h"
#include "port_bench.h"
#include "registers/mac.h"

namespace nplc::gateway {
namespace {

using reg::Command;
using reg::Result;

// Step 0: IN0 -> step 1 with outputs 5, sends 40h (P1). Step 1: IN1 -> step 0, outputs 0.
const Bytes kTable{{0xC0, 0x01, 0x01, 0x01, 0x40, 0x05, 0, 0}, {0xC1, 0x02, 0x02, 0x00, 0x80, 0x00, 0, 0}};
constexpr int kPIst = 10;
constexpr int kVIst = 12;

struct PortSafety : testing::Test, PortBench {
    PortSafety() : PortBench({.safe_outputs = 0x02, .autostart = false}) {}

    void start_table() {
        ASSERT_TRUE(upload_and_activate(kTable));
        ASSERT_TRUE(command(Command::run));
        run(10ms);
        ASSERT_EQ(state(), reg::RunState::running);
        board.sent.clear();
        board.stops = 0;
    }
    bool set(store::Setting setting, std::uint32_t value) { return write(reg::register_of(setting), value); }
};

TEST_F(PortSafety, ATableBecomesActiveOnlyWhileStopped) {
    start_table();
    const Bytes other{{0xC0, 0, 0, 0x3E, 0x80, 0x0F, 0, 0}};
    EXPECT_TRUE(upload(other)) << "a running sequence is not disturbed by an upload";
    EXPECT_EQ(state(), reg::RunState::running);
    EXPECT_EQ(read(reg::TABLE_CRC), base::crc32(kTable));
    EXPECT_FALSE(command(Command::activate));
    EXPECT_EQ(result(), result_of(Result::not_stopped, reg::COMMAND));
    ASSERT_TRUE(command(Command::stop));
    EXPECT_TRUE(command(Command::activate));
    EXPECT_EQ(read(reg::TABLE_CRC), base::crc32(other));
    EXPECT_EQ(state(), reg::RunState::stopped);
}

TEST_F(PortSafety, ATableBecomesActiveOnlyWhileTheMotorStandsStill) {
    ASSERT_TRUE(upload(kTable));
    board.motor_registers[kVIst] = 1;
    EXPECT_FALSE(command(Command::activate));
    EXPECT_EQ(result(), result_of(Result::moving, reg::COMMAND));
    board.motor_registers[kVIst] = 0;
    ask({.kind = mactalk::Kind::write,
         .address = reg::kDefaultAddress,
         .reg = reg::COMMAND,
         .length = 4,
         .value = static_cast<std::uint32_t>(Command::activate)});
    run(20ms);
    board.motor_registers[kPIst] = 2;  // two counts in 50 ms: slower than V_IST can show
    EXPECT_TRUE(heard().empty());
    EXPECT_EQ(result(), result_of(Result::moving, reg::COMMAND));
    board.link_state = motor::Link::down;
    EXPECT_FALSE(command(Command::activate));
    EXPECT_EQ(result(), result_of(Result::link_down, reg::COMMAND));
    EXPECT_EQ(read(reg::TABLE_BYTES), 0U);
    board.link_state = motor::Link::up;
    EXPECT_TRUE(command(Command::activate));
}

/// A drive that has just been switched on answers a little later than the gateway's port.
TEST_F(PortSafety, AnActivationWaitsASecondForTheLink) {
    ASSERT_TRUE(upload(kTable));
    board.link_state = motor::Link::down;
    ask({.kind = mactalk::Kind::write,
         .address = reg::kDefaultAddress,
         .reg = reg::COMMAND,
         .length = 4,
         .value = static_cast<std::uint32_t>(Command::activate)});
    EXPECT_TRUE(heard(900ms).empty());
    board.link_state = motor::Link::up;
    EXPECT_EQ(heard(90ms), (std::vector<std::uint8_t>{0x11, 0x11, 0x11})) << "accept";
    EXPECT_EQ(read(reg::TABLE_BYTES), 24U) << "two terms and the end term";
}

TEST_F(PortSafety, AResetMakesNoNewTableActiveWhileTheMotorMoves) {
    ASSERT_TRUE(upload(kTable));
    board.motor_registers[kVIst] = 1;
    EXPECT_FALSE(command(Command::reset));
    EXPECT_EQ(result(), result_of(Result::moving, reg::COMMAND));
    EXPECT_FALSE(controller->reset_asked());
    board.motor_registers[kVIst] = 0;
    static_cast<void>(command(Command::reset));
    EXPECT_TRUE(controller->reset_asked());
}

TEST_F(PortSafety, AnOlderTableThatStandsInForADamagedOneDoesNotStartByItself) {
    const Bytes newer{{0xC0, 0, 0, 0x3E, 0x80, 0x0F, 0, 0}};
    ASSERT_TRUE(upload(kTable));
    ASSERT_TRUE(upload(newer));
    flash.flip(store::Layout(kFlash, kTables).content(1) + 3, 0);
    start({.safe_outputs = 0x02, .autostart = true});
    run(1s);
    EXPECT_EQ(read(reg::TABLE_CRC), base::crc32(kTable));
    EXPECT_EQ(read(reg::STORE_FLAGS), 1U);
    EXPECT_EQ(state(), reg::RunState::stopped);
    EXPECT_EQ(read(reg::SAFE_REASON), 5U) << "bad table";
    EXPECT_EQ(board.out, 0x02);
    EXPECT_TRUE(command(Command::run));
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::running);
    EXPECT_EQ(read(reg::SAFE_REASON), 0U);
}

TEST_F(PortSafety, APowerCutInMidUploadDoesNotKeepTheOldTableFromStarting) {
    ASSERT_TRUE(upload(Bytes{{0xC0, 0, 0, 0x3E, 0x80, 0x0F, 0, 0}}));
    ASSERT_TRUE(upload(kTable));
    ASSERT_TRUE(command(Command::upload_begin));
    run(100ms);
    ASSERT_TRUE(send(std::array<std::uint8_t, 128>{}));
    start({.autostart = true});
    run(10ms);
    EXPECT_EQ(read(reg::TABLE_CRC), base::crc32(kTable));
    EXPECT_EQ(state(), reg::RunState::running);
}

TEST_F(PortSafety, WithTheEnableInputOffNothingStarts) {
    ASSERT_TRUE(set(store::Setting::enable_input, 5));
    ASSERT_TRUE(upload_and_activate(kTable));
    for (const Command order : {Command::run, Command::scan, Command::step}) {
        EXPECT_FALSE(command(order));
        EXPECT_EQ(result(), result_of(Result::not_enabled, reg::COMMAND));
    }
    board.in = 0x20;
    run(100ms);
    EXPECT_EQ(state(), reg::RunState::stopped);
    EXPECT_TRUE(command(Command::run));
}

TEST_F(PortSafety, AnActivatedTableDoesNotStartByItself) {
    start({.autostart = true});
    ASSERT_TRUE(upload_and_activate(kTable));
    run(100ms);
    EXPECT_EQ(state(), reg::RunState::stopped);
}

TEST_F(PortSafety, WhileItRunsEveryRegisterIsReadAndTheMotorIsNotWritten) {
    start_table();
    board.motor_registers[5] = 99;
    EXPECT_EQ(read(5, kMotor), 99U);
    board.accesses.clear();
    EXPECT_FALSE(write(5, 1, 2, kMotor));
    EXPECT_FALSE(write(5, 1, 2, mactalk::kEveryone));
    EXPECT_TRUE(board.accesses.empty());
    ASSERT_TRUE(command(Command::hold));
    run(10ms);
    ASSERT_EQ(state(), reg::RunState::held);
    EXPECT_FALSE(write(5, 1, 2, kMotor)) << "held is not stopped";
    ASSERT_TRUE(command(Command::stop));
    EXPECT_TRUE(write(5, 1, 2, kMotor));
}

TEST_F(PortSafety, WhileItWaitsForTheMotorOrIsAboutToHoldTheMotorIsNotWritten) {
    wired = true;
    start({.autostart = false});
    const auto expect_refused = [&](reg::RunState wanted) {
        ASSERT_EQ(state(), wanted);
        board.accesses.clear();
        motor_line.sent.clear();
        using mactalk::Kind;
        for (const auto kind : {Kind::write, Kind::safe_mode, Kind::write_flash, Kind::reset}) {
            ask({.kind = kind, .address = kMotor, .reg = 5, .length = 2, .value = 1});
            EXPECT_TRUE(heard(10ms).empty());
        }
        EXPECT_TRUE(board.accesses.empty());
        EXPECT_TRUE(motor_line.sent.empty());
        EXPECT_EQ(state(), wanted);
    };
    ASSERT_TRUE(upload_and_activate(kTable));
    board.is_settled = false;
    ASSERT_TRUE(command(Command::run));
    expect_refused(reg::RunState::waiting_for_motor);
    board.is_settled = true;
    run(10ms);
    ASSERT_TRUE(command(Command::hold));
    board.is_settled = false;
    expect_refused(reg::RunState::holding);
}

TEST_F(PortSafety, AModeOfZeroAtTheMotorsAddressIsAStop) {
    for (const std::uint32_t allowed : {0U, 2U}) {
        start({.autostart = false});
        ASSERT_TRUE(set(store::Setting::motor_writes, allowed));
        start_table();
        EXPECT_TRUE(write(registers::MODE_REG, 0, 2, kMotor));
        EXPECT_EQ(state(), reg::RunState::stopped);
        EXPECT_EQ(read(reg::SAFE_REASON), static_cast<std::uint32_t>(SafeReason::stop_command));
        EXPECT_EQ(board.stops, 1);
        EXPECT_TRUE(write(registers::MODE_REG, 0, 2, kMotor)) << "the motor's own register again";
        EXPECT_EQ(board.stops, 2) << "somebody's writes may have set the motor in motion";
    }
}

TEST_F(PortSafety, AModeOfZeroThatTheMotorDoesNotConfirmKeepsASequenceFromStarting) {
    start({.autostart = false});
    ASSERT_TRUE(upload_and_activate(kTable));
    board.stop_is_confirmed = false;
    write(registers::MODE_REG, 0, 2, kMotor);
    EXPECT_FALSE(command(Command::run));
    EXPECT_EQ(state(), reg::RunState::stopped);
    board.stop_is_confirmed = true;
    EXPECT_TRUE(command(Command::run));
}

TEST_F(PortSafety, ASettingAllowsMotorWritesWhileItRuns) {
    ASSERT_TRUE(set(store::Setting::motor_writes, 1));
    start_table();
    EXPECT_TRUE(write(5, 1, 2, kMotor));
}

TEST_F(PortSafety, SafeFlashAndResetMessagesNeedASettingOfTheirOwnWhileItRuns) {
    wired = true;
    const mactalk::Kind kinds[]{mactalk::Kind::safe_mode, mactalk::Kind::init_mode,
                                mactalk::Kind::write_flash, mactalk::Kind::reset};
    for (const std::uint32_t allowed : {0U, 1U, 2U}) {
        start({.autostart = false});
        ASSERT_TRUE(set(store::Setting::motor_writes, allowed));
        start_table();
        for (const auto kind : kinds) {
            motor_line.sent.clear();
            ask({.kind = kind, .address = kMotor});
            run(10ms);
            EXPECT_EQ(motor_line.sent.empty(), allowed < 2);
        }
        motor_line.sent.clear();
        ask({.kind = mactalk::Kind::read_samples, .address = kMotor});
        run(10ms);
        EXPECT_FALSE(motor_line.sent.empty()) << "a read";
    }
}

TEST_F(PortSafety, ForcedSignalsAreShownAndEndWhenTheirClientIsSilent) {
    start_table();
    ASSERT_TRUE(write(reg::FORCE_IN, 0x0101));
    run(10ms);
    EXPECT_EQ(read(reg::STEP), 1U) << "as if IN0 were on";
    EXPECT_EQ(read(reg::INPUTS).value_or(0) & 0x3F3FU, 0x0001U) << "the terminals are shown too";
    ASSERT_TRUE(write(reg::FORCE_OUT, 0x0A0A));
    EXPECT_EQ(board.out, 0x0F) << "5 from the sequence, A forced";
    EXPECT_NE(status() & reg::kForcedInputs, 0U);
    EXPECT_NE(status() & reg::kForcedOutputs, 0U);
    for (int i = 0; i < 3; ++i) {
        run(4s);
        EXPECT_TRUE(write(reg::FORCE_LEFT, 0));
    }
    for (int i = 0; i < 48; ++i) {
        run(100ms);
        EXPECT_NE(status() & reg::kForcedOutputs, 0U) << "reads do not count as the client's sign";
    }
    run(250ms);
    EXPECT_EQ(status() & (reg::kForcedInputs | reg::kForcedOutputs), 0U);
    EXPECT_EQ(board.out, 0x05);
    EXPECT_EQ(read(reg::FORCE_LEFT), 0U);
}

TEST_F(PortSafety, HowLongASilentClientsForcedSignalsLastIsASetting) {
    ASSERT_TRUE(set(store::Setting::force_timeout, 300));
    start_table();
    ASSERT_TRUE(write(reg::FORCE_OUT, 0x0A0A));
    run(295ms);
    EXPECT_EQ(board.out, 0x0A);
    run(10ms);
    EXPECT_EQ(board.out, 0x00);
}

TEST_F(PortSafety, ForcedSignalsEndAtAReset) {
    start_table();
    ASSERT_TRUE(write(reg::FORCE_IN, 0x3F3F));
    ASSERT_TRUE(write(reg::FORCE_OUT, 0x0F0F));
    start({});
    EXPECT_EQ(read(reg::FORCE_IN), 0U);
    EXPECT_EQ(read(reg::FORCE_OUT), 0U);
}

TEST_F(PortSafety, TheSafeStateBeatsForcedOutputsAndTheEnableInputIsNeverForced) {
    ASSERT_TRUE(set(store::Setting::enable_input, 5));
    board.in = 0x20;
    start_table();
    ASSERT_TRUE(write(reg::FORCE_OUT, 0x0F0F));
    EXPECT_EQ(board.out, 0x0F);
    ASSERT_TRUE(write(reg::FORCE_IN, 0x2020));
    board.in = 0;
    const auto lost = board.now;
    run(10ms);
    EXPECT_EQ(board.out, 0x02);
    EXPECT_LE(board.out_since - lost, 10ms);
    EXPECT_EQ(read(reg::SAFE_REASON), 7U);
    EXPECT_EQ(board.stops, 1);
}

TEST_F(PortSafety, ABreakpointStopsTheMotorBeforeItHolds) {
    start_table();
    ASSERT_TRUE(write(reg::BREAK_LOW, 1U << 1));
    board.is_settled = true;
    board.in = 1;
    run(3ms + 250us);
    ASSERT_EQ(board.sent.size(), 1U) << "the scan's order first";
    board.is_settled = false;  // the motor has still to execute it, and then the stop
    run(20ms);
    EXPECT_EQ(state(), reg::RunState::holding);
    const int stops = board.stops;
    board.is_settled = true;
    run(1ms);
    EXPECT_EQ(state(), reg::RunState::held);
    EXPECT_EQ(board.stops, std::max(stops, 1));
    EXPECT_EQ(board.stops, 1);
    EXPECT_NE(status() & reg::kAtBreakpoint, 0U);
    EXPECT_EQ(read(reg::STEP), 1U);
    EXPECT_EQ(board.out, 0x05) << "outputs stay";
    const auto scans = read(reg::SCANS);
    run(1s);
    EXPECT_EQ(read(reg::SCANS), scans);
    board.in = 2;
    ASSERT_TRUE(command(Command::run));
    run(20ms);
    EXPECT_EQ(read(reg::STEP), 0U) << "it goes on from where it was";
}

TEST_F(PortSafety, ABreakpointLeavesAVirtualMotorAlone) {
    ASSERT_TRUE(set(store::Setting::virtual_motor, 1));
    start_table();
    ASSERT_TRUE(write(reg::BREAK_LOW, 1U << 1));
    board.in = 1;
    run(20ms);
    EXPECT_EQ(state(), reg::RunState::held);
    EXPECT_EQ(board.stops, 0);
}

TEST_F(PortSafety, AHoldWithTheLinkDownHasTheMotorStoppedAsSoonAsItIsBack) {
    start_table();
    board.link_state = motor::Link::down;
    run(10ms);
    ASSERT_TRUE(command(Command::hold));
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::held);
    EXPECT_EQ(board.out, 0x02) << "the safe state of a lost link";
    board.stops = 0;
    board.link_state = motor::Link::unacknowledged;
    run(250us);
    EXPECT_EQ(board.stops, 1);
    run(1s);
    EXPECT_EQ(board.stops, 1);
    EXPECT_EQ(state(), reg::RunState::held);
    EXPECT_TRUE(board.sent.empty());
}

TEST_F(PortSafety, SingleScansAndSteps) {
    ASSERT_TRUE(upload_and_activate(kTable));
    board.stops = 0;
    board.is_settled = false;  // the stop is still to be taken
    ASSERT_TRUE(command(Command::scan));
    run(10ms);
    EXPECT_EQ(board.stops, 1);
    EXPECT_EQ(read(reg::SCANS), 0U);
    board.is_settled = true;
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::held);
    EXPECT_EQ(read(reg::SCANS), 1U);
    ASSERT_TRUE(command(Command::scan));
    run(10ms);
    EXPECT_EQ(read(reg::SCANS), 2U) << "one scan, although nothing happened in it";
    ASSERT_TRUE(command(Command::step));
    run(100ms);
    EXPECT_EQ(state(), reg::RunState::running) << "until the step changes";
    const int stops = board.stops;
    board.in = 1;
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::held);
    EXPECT_EQ(read(reg::STEP), 1U);
    EXPECT_EQ(board.stops, stops + 1);
}

TEST_F(PortSafety, AStepUnderWayIsShownAndRunOrHoldGivesItUp) {
    start_table();
    EXPECT_FALSE(command(Command::run));
    EXPECT_EQ(result(), result_of(Result::not_stopped, reg::COMMAND)) << "it runs already";
    ASSERT_TRUE(command(Command::hold));
    run(10ms);
    EXPECT_EQ(status() & reg::kSingle, 0U);
    ASSERT_TRUE(command(Command::step));
    run(10ms);
    EXPECT_NE(status() & reg::kSingle, 0U);
    ASSERT_TRUE(command(Command::run));
    EXPECT_EQ(status() & reg::kSingle, 0U);
    board.in = 1;
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::running) << "the step changed, and it was not held";
    ASSERT_TRUE(command(Command::hold));
    run(10ms);
    ASSERT_TRUE(command(Command::step));
    ASSERT_TRUE(command(Command::hold));
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::held);
    EXPECT_EQ(status() & reg::kSingle, 0U);
}

TEST_F(PortSafety, AnUploadThatIsGivenUpIsLogged) {
    ASSERT_TRUE(command(Command::upload_begin));
    ASSERT_TRUE(send(std::array<std::uint8_t, 128>{}));
    ASSERT_TRUE(command(Command::clear_log));
    ASSERT_TRUE(command(Command::upload_begin));
    EXPECT_EQ(read(reg::LOG + 1), 27U | (128U << 16));
    ASSERT_TRUE(command(Command::upload_abort));
    ASSERT_TRUE(command(Command::upload_abort));
    EXPECT_EQ(read(reg::LOG_COUNT), 2U) << "nothing was left to be aborted";
}

TEST_F(PortSafety, AddressesTakeHoldAtTheNextReset) {
    ASSERT_TRUE(set(store::Setting::gateway_address, 6));
    ASSERT_TRUE(set(store::Setting::motor_address, 9));
    EXPECT_EQ(read(reg::IDENTITY, 6), std::nullopt);
    ASSERT_TRUE(read(5, kMotor).has_value());
    ASSERT_TRUE(command(Command::keep_settings)) << "at the old address";
    start({.autostart = false});
    EXPECT_EQ(read(reg::IDENTITY, 6), reg::kIdentity);
    EXPECT_EQ(read(reg::IDENTITY), std::nullopt);
    EXPECT_TRUE(read(5, 9).has_value());
}

TEST_F(PortSafety, AMotorThatCannotBeStoppedEndsTheHoldInTheSafeState) {
    start_table();
    ASSERT_TRUE(command(Command::hold));
    board.is_settled = false;
    run(1600ms);  // 500 ms for its last orders, longest_wait for the stop
    EXPECT_EQ(state(), reg::RunState::stopped);
    EXPECT_EQ(read(reg::SAFE_REASON), 4U) << "motor stuck";
}

TEST_F(PortSafety, TheTimerStandsWhileHeld) {
    const Bytes timed{{0xC0, 0x00, 0x00, 0x01, 0x80, 0x00, 0x64, 0},
                      {0x41, 0x00, 0x00, 0x02, 0x80, 0x01, 0, 0}};
    ASSERT_TRUE(upload_and_activate(timed));
    ASSERT_TRUE(write(reg::BREAK_LOW, 1U << 1));
    ASSERT_TRUE(command(Command::run));
    run(1s);
    EXPECT_EQ(read(reg::TIMER), 100U) << "as preset";
    ASSERT_TRUE(write(reg::BREAK_LOW, 0));
    ASSERT_TRUE(command(Command::run));
    run(98ms);
    EXPECT_EQ(read(reg::STEP), 1U);
    run(4ms);
    EXPECT_EQ(read(reg::STEP), 2U);
}

TEST_F(PortSafety, TheSafeCommandEndsAllThatAPersonDid) {
    start_table();
    ASSERT_TRUE(write(reg::FORCE_OUT, 0x0F0F));
    ASSERT_TRUE(write(reg::BREAK_LOW, 3));
    ASSERT_TRUE(command(Command::upload_begin));
    ASSERT_TRUE(command(Command::safe));
    EXPECT_EQ(board.out, 0x02);
    EXPECT_EQ(board.stops, 1);
    EXPECT_EQ(read(reg::SAFE_REASON), 8U);
    EXPECT_EQ(read(reg::BREAK_LOW), 0U);
    EXPECT_EQ(read(reg::UPLOAD_STATE), 0U);
    EXPECT_EQ(status() & (reg::kForcedOutputs | reg::kBreakpoints), 0U);
}

TEST_F(PortSafety, AStatusLampBlinksAndIsNoneOfTheSequencesOutputs) {
    ASSERT_TRUE(set(store::Setting::status_output, 3));
    int changes = 0;
    for (int last = board.out, i = 0; i < 4000; ++i) {
        poll();
        EXPECT_EQ(board.out & 7, 0x02);
        changes += board.out != last ? 1 : 0;
        last = board.out;
    }
    EXPECT_EQ(changes, 2) << "1 Hz while stopped";
    start_table();
    EXPECT_EQ(board.out & 8, 8) << "on while it runs";
}

}  // namespace
}  // namespace nplc::gateway
