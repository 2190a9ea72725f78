// The port as a client program sees it: REGISTERS.md, sentence by sentence.
#include <gtest/gtest.h>

#include "base/bytes.h"
#include "base/crc32.h"
#include "gateway/set_points.h"
#include "motor/jvl_driver.h"
#include "port_bench.h"

namespace nplc::gateway {
namespace {

using reg::Command;
using reg::Result;

// Step 0: IN0 -> outputs 5, step 1. Step 1: IN1 -> outputs 2, step 2, sends 61h. 001 §6.1.5, §6.1.7.
const Bytes kPortTable{{0xC0, 0x01, 0x01, 0x01, 0x80, 0x05, 0, 0},
                       {0xC1, 0x02, 0x02, 0x02, 0x61, 0x02, 0, 0}};
constexpr std::size_t kTableBytes = 3 * 8;

/// Polled all the time, or only when it asks for it.
struct UserPortTest : testing::TestWithParam<bool>, PortBench {
    void SetUp() override { only_when_due = GetParam(); }
    void start_table() {
        ASSERT_TRUE(upload_and_activate(kPortTable));
        ASSERT_TRUE(command(Command::run));
        run(10ms);
        ASSERT_EQ(state(), reg::RunState::running);
    }
    std::uint32_t in_block(const mactalk::Reply& block, std::uint8_t first, std::uint8_t number) {
        return base::load_u32(&block.data[4U * (number - first)]);
    }
};

INSTANTIATE_TEST_SUITE_P(Polled, UserPortTest, testing::Bool(),
                         [](const auto& due) { return due.param ? "WhenDue" : "AllTheTime"; });

TEST_P(UserPortTest, TellsWhoItIsByteForByte) {
    // 50h x3, address 80h, register 01h, each with its inverse, AAh x2 (001 §5.1).
    const std::vector<std::uint8_t> request{0x50, 0x50, 0x50, 0x80, 0x7F, 0x01, 0xFE, 0xAA, 0xAA};
    put(request);
    const std::vector<std::uint8_t> expected{0x52, 0x52, 0x52, 0x00, 0xFF, 0x01, 0xFE, 0x04, 0xFB, 'N',
                                             0xB1, 'P',  0xAF, 'L',  0xB3, 'G',  0xB8, 0xAA, 0xAA};
    EXPECT_EQ(heard(), expected);
    EXPECT_EQ(read(reg::MAP_VERSION), 1U);
    EXPECT_EQ(read(reg::FW_VERSION), 0x100U) << "0.1.0";
}

TEST_P(UserPortTest, EveryRegisterOfTheMapIsReadAndNoOtherIsAnythingButZero) {
    for (unsigned number = 1; number <= 255; ++number) {
        const auto value = read(static_cast<std::uint8_t>(number));
        ASSERT_TRUE(value) << number;
        if (reg::find(static_cast<std::uint8_t>(number)) == nullptr) {
            EXPECT_EQ(*value, 0U) << number;
        }
    }
}

bool is_of_set_points(std::uint8_t number) {
    return (number > reg::FIRED_KEY && number <= reg::SET_POINT_DATA) ||
           (number >= reg::SET_POINT && number < reg::SET_POINT_WANTED + reg::kSetPoints);
}

bool is_of_firmware(std::uint8_t number) {
    return number >= reg::FIRMWARE_BOARD && number <= reg::FIRMWARE_DATA;
}

TEST_P(UserPortTest, AWriteToWhatCanOnlyBeReadIsRefusedWithAReason) {
    for (unsigned number = 1; number <= 255; ++number) {
        const auto n = static_cast<std::uint8_t>(number);
        const reg::Row* row = reg::find(n);
        if (row != nullptr && row->access != reg::Access::read) continue;
        const bool is_left_out = (!SetPointsPart::kIsThere && is_of_set_points(n)) ||
                                 (!FirmwarePart::kIsThere && is_of_firmware(n));
        const bool is_there = row != nullptr && !is_left_out;
        EXPECT_FALSE(write(n, 0)) << number;
        EXPECT_EQ(result(), result_of(is_there ? Result::read_only : Result::no_register, n)) << number;
    }
}

TEST_P(UserPortTest, ABlockIsSixteenRegistersAndZerosBeyondTheLast) {
    const auto block16 = block(reg::STATUS);
    ASSERT_TRUE(block16);
    EXPECT_EQ(in_block(*block16, 16, reg::SAFE_REASON), 1U) << "not started";
    const auto last = block(250);
    ASSERT_TRUE(last);
    for (const std::uint8_t byte : last->view()) EXPECT_EQ(byte, 0);
}

TEST_P(UserPortTest, MessagesThatAreNotForTheGatewayGetNoAnswer) {
    for (const auto kind : {mactalk::Kind::read_samples, mactalk::Kind::safe_mode, mactalk::Kind::init_mode,
                            mactalk::Kind::write_flash, mactalk::Kind::reset}) {
        ask({.kind = kind, .address = reg::kDefaultAddress});
        EXPECT_TRUE(heard().empty());
    }
    ask({.kind = mactalk::Kind::read, .address = 33, .reg = 1});
    EXPECT_TRUE(heard().empty());
}

TEST_P(UserPortTest, UploadsActivatesReadsBackAndRuns) {
    board.motor_registers[10] = 4711;  // P_IST
    const std::span<const std::uint8_t> table = kPortTable;
    ASSERT_TRUE(upload(table));
    EXPECT_EQ(read(reg::STORED_BYTES), kTableBytes);
    EXPECT_EQ(read(reg::STORED_CRC), base::crc32(table));
    EXPECT_EQ(read(reg::TABLE_BYTES), 0U) << "stored is not active";
    EXPECT_NE(status() & reg::kStoredDiffers, 0U);
    ASSERT_TRUE(command(Command::activate));
    EXPECT_EQ(read(reg::TABLE_CRC), base::crc32(table));
    EXPECT_EQ(status() & reg::kStoredDiffers, 0U);
    EXPECT_EQ(state(), reg::RunState::stopped) << "running it needs a command";
    ASSERT_TRUE(write(reg::TABLE_POINTER, 0));
    const auto back = block(reg::TABLE_DATA);
    ASSERT_TRUE(back);
    EXPECT_TRUE(std::equal(table.begin(), table.end(), back->data.begin()));
    EXPECT_TRUE(
        std::all_of(back->data.begin() + kTableBytes, back->data.end(), [](int b) { return b == 0; }));
    EXPECT_EQ(read(reg::TABLE_POINTER), 64U);
    ASSERT_TRUE(command(Command::run));
    board.in = 1;
    run(20ms);
    EXPECT_EQ(read(reg::STEP), 1U);
    EXPECT_EQ(read(reg::OUTPUTS), 0x0505U);
    EXPECT_EQ(read(reg::INPUTS), 0x01'01'01U) << "seen, terminals, HW_INP";
}

TEST_P(UserPortTest, AFullTableGoesInPiecesAndSurvivesARestart) {
    std::vector<std::uint8_t> table;
    for (std::size_t i = 0; i < sequencer::kMaxTerms; ++i) {
        const auto step = static_cast<std::uint8_t>(0xC0 | (i % 62));
        table.insert(table.end(), {step, 0x01, 0x01, static_cast<std::uint8_t>((i + 1) % 62), 0x80, 0, 0, 0});
    }
    table.insert(table.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_TRUE(upload_and_activate(table));
    EXPECT_EQ(read(reg::TABLE_BYTES), table.size());
    start({.autostart = true});
    EXPECT_EQ(read(reg::TABLE_CRC), base::crc32(table));
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::running) << "with autostart after a power-up";
}

TEST_P(UserPortTest, ALostAnswerIsMendedByThePointer) {
    const std::span<const std::uint8_t> table = kPortTable;
    ASSERT_TRUE(command(Command::upload_begin));
    ASSERT_TRUE(send(table.first(8)));
    EXPECT_TRUE(write(reg::TABLE_POINTER, 0));
    EXPECT_TRUE(send(table.first(8))) << "the same again";
    EXPECT_EQ(read(reg::UPLOAD_RECEIVED), 8U);
    EXPECT_TRUE(write(reg::TABLE_POINTER, 16));
    EXPECT_FALSE(send(table.subspan(16)));
    EXPECT_EQ(result(), result_of(Result::bad_offset, reg::TABLE_DATA));
}

TEST_P(UserPortTest, AnUploadThatIsNotAsAnnouncedLeavesTheStoredOne) {
    ASSERT_TRUE(upload_and_activate(kPortTable));
    ASSERT_TRUE(command(Command::upload_begin));
    ASSERT_TRUE(send(std::span<const std::uint8_t>(kPortTable)));
    ASSERT_TRUE(write(reg::UPLOAD_BYTES, kTableBytes));
    ASSERT_TRUE(write(reg::UPLOAD_CRC, 1));
    EXPECT_FALSE(command(Command::upload_commit));
    EXPECT_EQ(result(), result_of(Result::wrong_check, reg::COMMAND));
    EXPECT_EQ(read(reg::UPLOAD_STATE).value_or(0) & 0xFFFFU, 5U | (14U << 8)) << "failed, wrong_check";
    EXPECT_EQ(read(reg::STORED_CRC), base::crc32(kPortTable));
}

TEST_P(UserPortTest, AFaultyTableIsNamedByItsTerm) {
    const Bytes bad{{0xC0, 0, 0, 0x00, 0x80, 0, 0, 0}, {0xC0, 0, 0, 0x3F, 0x80, 0, 0, 0}};
    EXPECT_FALSE(upload(bad));
    EXPECT_EQ(read(reg::UPLOAD_STATE), 5U | (34U << 8) | (1U << 16)) << "bad_next_step in term 1";
    board.missing_register = 5;
    const Bytes misfit{{0xC0, 0x00, 0x80, 0x05, 0x64, 0, 0, 0}};
    EXPECT_FALSE(upload(misfit));
    EXPECT_EQ(read(reg::UPLOAD_STATE), 5U | (36U << 8)) << "not_for_motor in term 0";
}

TEST_P(UserPortTest, PiecesWithoutABeginningAreRefused) {
    EXPECT_FALSE(send(std::span<const std::uint8_t>(kPortTable)));
    EXPECT_EQ(result(), result_of(Result::no_upload, reg::TABLE_DATA));
    EXPECT_FALSE(command(Command::upload_commit));
    EXPECT_FALSE(command(Command::activate));
    EXPECT_EQ(result(), result_of(Result::nothing_stored, reg::COMMAND));
    EXPECT_FALSE(command(Command::run));
    EXPECT_EQ(result(), result_of(Result::no_table, reg::COMMAND));
}

TEST_P(UserPortTest, CommandsAndValuesThatDoNotExistAreRefused) {
    for (const std::uint32_t value : {0U, 11U, 15U, 20U, 255U, 256U, 0x0101U}) {
        EXPECT_FALSE(write(reg::COMMAND, value));
        EXPECT_EQ(result(), result_of(Result::bad_value, reg::COMMAND)) << value;
    }
    EXPECT_FALSE(write(reg::FORCE_IN, 0x40));
    EXPECT_FALSE(write(reg::FORCE_OUT, 0x1000));
    EXPECT_FALSE(write(reg::BREAK_HIGH, 0x8000'0000));
    EXPECT_FALSE(write(reg::TABLE_POINTER, 100'000));
    EXPECT_FALSE(command(Command::hold));
    EXPECT_EQ(result(), result_of(Result::not_running, reg::COMMAND));
}

TEST_P(UserPortTest, BreakpointsAreTwoWordsOfSteps) {
    EXPECT_TRUE(write(reg::BREAK_LOW, 0x8000'0001));
    EXPECT_TRUE(write(reg::BREAK_HIGH, 0x2000'0000)) << "61, the last step";
    EXPECT_EQ(gateway->breakpoints(), 0x2000'0000'8000'0001U);
    EXPECT_EQ(read(reg::BREAK_HIGH), 0x2000'0000U);
    EXPECT_FALSE(write(reg::BREAK_HIGH, 0x8000'0000)) << "there is no step 63";
    EXPECT_EQ(result(), result_of(Result::bad_value, reg::BREAK_HIGH));
    EXPECT_EQ(gateway->breakpoints(), 0x2000'0000'8000'0001U);
}

TEST_P(UserPortTest, TheWorstScanIsForgottenWhenItIsWritten) {
    start_table();
    board.now += 50ms;
    poll();
    EXPECT_GE(read(reg::SCAN_WORST).value_or(0), 50'000U);
    EXPECT_TRUE(write(reg::SCAN_WORST, 0));
    run(10ms);
    EXPECT_LT(read(reg::SCAN_WORST).value_or(50'000), 50'000U);
}

TEST_P(UserPortTest, TwoBytesAreAValueToo) {
    EXPECT_TRUE(write(reg::BREAK_LOW, 0xFFFF'0003, 4));
    EXPECT_TRUE(write(reg::BREAK_LOW, 0x0005, 2));
    EXPECT_EQ(read(reg::BREAK_LOW), 5U);
}

TEST_P(UserPortTest, TermsThatFired) {
    start_table();
    board.in = 0;
    run(10ms);
    EXPECT_EQ(block(reg::FIRED_SCAN)->reg, reg::FIRED_SCAN);
    EXPECT_EQ(read(reg::FIRED), 0U);
    board.in = 1;
    ASSERT_TRUE(write(reg::BREAK_LOW, 2));
    run(20ms);
    EXPECT_EQ(state(), reg::RunState::held);
    static_cast<void>(read(reg::FIRED_SCAN));
    EXPECT_EQ(read(reg::FIRED_STEP), 0U);
    EXPECT_EQ(read(reg::FIRED), 1U) << "term 0";
    EXPECT_EQ(read(reg::FIRED_KEY).value_or(0) & 0xFFU, 1U);
}

TEST_P(UserPortTest, TheLogTellsReasonsWithTheirTimes) {
    start_table();
    const auto before = read(reg::UPTIME).value_or(0);
    const auto count = read(reg::LOG_COUNT).value_or(0);
    ASSERT_TRUE(command(Command::stop));
    EXPECT_EQ(read(reg::SAFE_REASON), 2U);
    const auto slot = static_cast<std::uint8_t>(reg::LOG + 2 * (count % 16));
    EXPECT_EQ(read(static_cast<std::uint8_t>(slot + 1)), 2U);
    EXPECT_GE(read(slot).value_or(0), before);
    EXPECT_EQ(read(reg::SAFE_SINCE), read(slot));
    ASSERT_TRUE(command(Command::clear_log));
    EXPECT_EQ(read(reg::LOG_COUNT), 0U);
}

TEST_P(UserPortTest, FaultsOfLinesAreShownIfTheBoardNamesThem) {
    EXPECT_EQ(read(reg::LINE_FAULTS), 0U);
    shown_lines = {&line, nullptr, &motor_line};
    start({.autostart = false});
    line.counted = {.framing = 3, .overruns = 2};
    motor_line.counted = {.framing = 65'535, .overruns = 65'536};
    EXPECT_EQ(read(reg::LINE_FAULTS), 0x0002'0003U);
    EXPECT_EQ(read(reg::LINE_FAULTS + 1), 0U);
    EXPECT_EQ(read(reg::LINE_FAULTS + 2), 0xFFFF'FFFFU) << "it stays there";
    EXPECT_FALSE(write(reg::LINE_FAULTS + 2, 0));
    EXPECT_EQ(result(), result_of(Result::read_only, reg::LINE_FAULTS + 2));
    EXPECT_FALSE(write(reg::STOP_SINCE + 1, 0));
    EXPECT_EQ(result(), result_of(Result::no_register, reg::STOP_SINCE + 1));
}

TEST(CommandResult, EachErrorHasItsCode) {
    using enum base::Error;
    const std::pair<base::Error, Result> all[]{{no_space, Result::no_space},
                                               {table_no_end, Result::table_no_end},
                                               {table_ragged, Result::table_ragged},
                                               {bad_next_step, Result::bad_next_step},
                                               {bad_register, Result::bad_register},
                                               {not_for_motor, Result::not_for_motor},
                                               {not_stopped, Result::not_stopped},
                                               {no_table, Result::no_table},
                                               {not_enabled, Result::not_enabled},
                                               {busy, Result::busy},
                                               {bad_geometry, Result::storage_failed},
                                               {bad_offset, Result::bad_offset},
                                               {not_begun, Result::no_upload},
                                               {wrong_check, Result::wrong_check},
                                               {storage_failed, Result::storage_failed},
                                               {damaged, Result::nothing_stored},
                                               {bad_setting, Result::bad_value},
                                               {cannot_go_on, Result::cannot_go_on},
                                               {no_proof, Result::no_proof}};
    ASSERT_EQ(std::size(all), static_cast<std::size_t>(base::Error::no_proof));
    for (unsigned number = 1; number <= std::size(all); ++number) {
        const auto error = static_cast<base::Error>(number);
        const auto* row = std::find_if(std::begin(all), std::end(all),
                                       [error](const auto& one) { return one.first == error; });
        ASSERT_NE(row, std::end(all)) << number;
        EXPECT_EQ(gateway::result_of(error), row->second) << number;
    }
}

TEST(SettingsManager, WhatTheBoardDecidesGoesBeforeWhatWasStored) {
    sim::SimStorage flash(PortBench::kFlash);
    SettingsManager manager(flash, PortBench::kSettings);
    manager.start({});
    manager.impose(store::Setting::motor_kind, 2);
    EXPECT_EQ(manager.get(store::Setting::motor_kind), 2U);
    EXPECT_EQ(manager.at_start(store::Setting::motor_kind), 2U);
    EXPECT_FALSE(manager.differ());
}

TEST(SettingsManager, TheMotorsSilenceIsTheDrivers) {
    store::SettingValues values;
    EXPECT_EQ(motor::jvl::settings_of(driver_settings_of(values)).link.silence, base::Milliseconds(20));
    ASSERT_TRUE(values.set(store::Setting::motor_silence, 150).ok());
    EXPECT_EQ(motor::jvl::settings_of(driver_settings_of(values)).link.silence, base::Milliseconds(150));
    EXPECT_EQ(motor::jvl::settings_of(driver_settings_of(values)).link.proof_time, base::Milliseconds(150));
}

TEST_P(UserPortTest, SettingsAreWrittenWhileStoppedAndKept) {
    const auto number = [](store::Setting setting) { return reg::register_of(setting); };
    for (const registers::gateway::SettingInfo& info : registers::gateway::all_settings()) {
        EXPECT_EQ(read(number(info.id)), manager->get(info.id)) << info.name;
        if (info.id == store::Setting::gateway_address) continue;
        EXPECT_TRUE(write(number(info.id), info.lowest)) << info.name;
        EXPECT_TRUE(write(number(info.id), info.highest)) << info.name;
        const bool is_none = info.has_none && info.highest + 1 == registers::gateway::kNone;
        EXPECT_EQ(write(number(info.id), info.highest + 1), is_none) << info.name;
    }
    EXPECT_FALSE(write(number(store::Setting::motor_address), reg::kDefaultAddress)) << "the gateway's own";
    EXPECT_NE(status() & reg::kSettingsDiffer, 0U);
    ASSERT_TRUE(write(number(store::Setting::safe_outputs), 9));
    EXPECT_EQ(board.out, 9) << "in force at once";
    ASSERT_TRUE(write(number(store::Setting::enable_input), registers::gateway::kNone));
    ASSERT_TRUE(write(number(store::Setting::status_output), registers::gateway::kNone));
    ASSERT_TRUE(write(number(store::Setting::motor_address), kMotor));
    ASSERT_TRUE(write(number(store::Setting::require_proof), 0));
    ASSERT_TRUE(command(Command::keep_settings));
    EXPECT_EQ(status() & reg::kSettingsDiffer, 0U);
    start({});
    EXPECT_EQ(read(number(store::Setting::safe_outputs)), 9U);
    EXPECT_EQ(board.out, 9) << "from reset on";
    start_table();
    EXPECT_FALSE(write(number(store::Setting::safe_outputs), 0));
    EXPECT_EQ(result(), result_of(Result::not_stopped, number(store::Setting::safe_outputs)));
    EXPECT_FALSE(command(Command::keep_settings));
}

TEST_P(UserPortTest, WhatTheBoardSetsAtTheStartIsRead) {
    start({.on_start = OnStart::keep, .autostart = false, .virtual_motor = true, .require_proof = true});
    for (const auto setting :
         {store::Setting::on_start, store::Setting::virtual_motor, store::Setting::require_proof})
        EXPECT_EQ(read(reg::register_of(setting)), 1U) << static_cast<int>(setting);
}

TEST_P(UserPortTest, SettingsThatCannotBeStoredAreToldSo) {
    ASSERT_TRUE(write(reg::register_of(store::Setting::safe_outputs), 9));
    flash.fail_operation(0);
    EXPECT_FALSE(command(Command::keep_settings));
    EXPECT_EQ(result(), result_of(Result::storage_failed, reg::COMMAND));
    EXPECT_NE(status() & reg::kSettingsDiffer, 0U);
    EXPECT_TRUE(command(Command::keep_settings)) << "the next one goes well";
}

TEST_P(UserPortTest, OnASlowStorageSettingsAreKeptOnceHoweverOftenTheyAreAskedFor) {
    std::uint64_t needed = 0;
    for (int slot = 0; slot < 3; ++slot) {
        const std::uint64_t before = flash.operations();
        ASSERT_TRUE(command(Command::keep_settings));
        needed = flash.operations() - before;
    }

    ASSERT_TRUE(write(reg::register_of(store::Setting::safe_outputs), 5));
    const std::uint64_t before = flash.operations();
    flash.work_for(10'000);  // 2.5 s for each operation
    EXPECT_FALSE(command(Command::keep_settings)) << "no answer yet";
    EXPECT_NE(status() & reg::kSettingsDiffer, 0U);
    EXPECT_FALSE(command(Command::keep_settings));
    ask({.kind = mactalk::Kind::write,
         .address = reg::kDefaultAddress,
         .reg = reg::COMMAND,
         .length = 4,
         .value = static_cast<std::uint32_t>(Command::keep_settings)});
    EXPECT_EQ(heard(60s), accept());
    EXPECT_EQ(status() & reg::kSettingsDiffer, 0U);
    EXPECT_EQ(flash.operations() - before, needed);
}

TEST_P(UserPortTest, SettingsWhoseEndNobodyWaitedForAreKnownAsKept) {
    ASSERT_TRUE(write(reg::register_of(store::Setting::safe_outputs), 5));
    flash.work_for(10'000);
    EXPECT_FALSE(command(Command::keep_settings));
    EXPECT_NE(status() & reg::kSettingsDiffer, 0U) << "this question ends the wait";
    run(60s);
    EXPECT_EQ(status() & reg::kSettingsDiffer, 0U);
}

TEST_P(UserPortTest, AnInputsEdgeIsSeenBeforeTheMotorIsPolled) {
    start_table();
    const int polls = board.polls;
    board.in = 1;
    for (const auto end = board.now + 20ms; board.now < end && board.out != 5;) {
        board.now += 250us;
        controller->poll_after_edge(board.now);
    }
    EXPECT_EQ(board.out, 5);
    EXPECT_GT(board.polls, polls);
}

TEST_P(UserPortTest, AMotorThatIsNotKnownToStandHoldsAnActivationUp) {
    board.access_answers = motor::AccessState::failed;
    ASSERT_TRUE(upload(kPortTable));
    EXPECT_FALSE(command(Command::activate));
    EXPECT_EQ(result() & 0xFFU, static_cast<std::uint32_t>(Result::link_down)) << "it cannot be asked";
    board.access_answers = motor::AccessState::done;
    EXPECT_TRUE(command(Command::activate));
}

TEST_P(UserPortTest, AResetIsAskedForOnlyWhileStopped) {
    start_table();
    EXPECT_FALSE(command(Command::reset));
    EXPECT_FALSE(controller->reset_asked());
    ASSERT_TRUE(command(Command::stop));
    static_cast<void>(command(Command::reset));
    EXPECT_TRUE(controller->reset_asked());
}

TEST_P(UserPortTest, ANewMessageEndsTheWaitForTheAnswerBefore) {
    board.access_answers = motor::AccessState::under_way;
    ask({.kind = mactalk::Kind::read, .address = kMotor, .reg = 5});
    EXPECT_TRUE(heard(100ms).empty());
    EXPECT_EQ(read(reg::MAP_VERSION), 1U);
    board.access = motor::AccessState::done;
    EXPECT_TRUE(heard(100ms).empty()) << "nobody waits for it any more";
}

TEST_P(UserPortTest, TheMotorIsReadAndWrittenForItsAddressAndForEveryone) {
    board.motor_registers[5] = 0x1234'5678;
    EXPECT_EQ(read(5, kMotor), 0x1234'5678U);
    EXPECT_EQ(read(5, mactalk::kEveryone), 0x1234'5678U);
    EXPECT_EQ(board.accesses.back(), (motor::Access{.reg = 5, .longword = true}));
    EXPECT_EQ(read(255, kMotor), 0U);
    EXPECT_EQ(board.accesses.back(), (motor::Access{.reg = 255, .longword = false})) << "nothing behind it";
    EXPECT_TRUE(write(5, 0x0102'0304, 4, kMotor));
    EXPECT_EQ(board.accesses.back(),
              (motor::Access{.is_write = true, .reg = 5, .longword = true, .value = 0x0102'0304}));
    EXPECT_TRUE(write(5, 0x0304, 2, kMotor));
    EXPECT_EQ(board.accesses.back(), (motor::Access{.is_write = true, .reg = 5, .value = 0x0304}));
    board.accesses.clear();
    const auto values = block(240, kMotor);
    ASSERT_TRUE(values);
    ASSERT_EQ(board.accesses.size(), 8U) << "240 to 255, two a longword";
    EXPECT_EQ(board.accesses.back().reg, 254);
}

TEST_P(UserPortTest, AMac800IsReadAndWrittenInLongwords) {
    board.is_mac800 = true;
    board.motor_registers[5] = 77;
    EXPECT_EQ(read(5, kMotor), 77U);
    EXPECT_FALSE(write(5, 1, 2, kMotor));
    EXPECT_TRUE(write(5, 1, 4, kMotor));
    board.accesses.clear();
    ASSERT_TRUE(block(5, kMotor));
    EXPECT_EQ(board.accesses.size(), 16U);
    EXPECT_EQ(board.accesses.back().reg, 20);
}

TEST_P(UserPortTest, AMotorThatDoesNotAnswerIsNotAnsweredFor) {
    board.access_answers = motor::AccessState::failed;
    EXPECT_FALSE(read(5, kMotor));
    EXPECT_EQ(board.accesses.size(), 2U) << "a read is tried twice";
    EXPECT_FALSE(write(5, 1, 2, kMotor));
    EXPECT_EQ(board.accesses.size(), 3U) << "a write is not: it may have been executed";
    board.link_state = motor::Link::down;
    EXPECT_FALSE(read(5, kMotor));
    EXPECT_EQ(board.accesses.size(), 3U);
}

TEST_P(UserPortTest, WhatFlexMacCannotCarryNeedsTheMotorsOwnPort) {
    ask({.kind = mactalk::Kind::safe_mode, .address = kMotor});
    EXPECT_TRUE(heard().empty());
    wired = true;
    start({});
    ask({.kind = mactalk::Kind::safe_mode, .address = kMotor});
    run(5ms);
    // 54h x3, address 07h and its inverse, AAh x2.
    const std::vector<std::uint8_t> passed{0x54, 0x54, 0x54, 0x07, 0xF8, 0xAA, 0xAA};
    EXPECT_EQ(motor_line.sent, passed);
    for (const std::uint8_t byte : accept()) motor_line.received.push_back({byte, false});
    EXPECT_EQ(heard(), accept());
}

TEST_P(UserPortTest, NoiseInFrontOfAMessageDoesNotHurt) {
    const std::vector<std::uint8_t> noise{0x52, 0x52, 0x52, 0x80, 0x7F, 0x30, 0xCF, 0x80, 0x50, 0x50, 0xAA};
    put(noise);
    line.received.push_back({0x50, true});
    EXPECT_EQ(read(reg::IDENTITY), reg::kIdentity);
}

}  // namespace
}  // namespace nplc::gateway
