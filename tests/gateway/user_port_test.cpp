// The port as a person's program sees it: REGISTERS.md, sentence by sentence.
#include <gtest/gtest.h>

#include "base/bytes.h"
#include "base/crc32.h"
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

struct UserPortTest : testing::Test, PortBench {
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

TEST_F(UserPortTest, TellsWhoItIsByteForByte) {
    // 50h x3, address 80h, register 01h, each with its inverse, AAh x2 (001 §5.1).
    const std::vector<std::uint8_t> request{0x50, 0x50, 0x50, 0x80, 0x7F, 0x01, 0xFE, 0xAA, 0xAA};
    put(request);
    const std::vector<std::uint8_t> expected{0x52, 0x52, 0x52, 0x00, 0xFF, 0x01, 0xFE, 0x04, 0xFB, 'N',
                                             0xB1, 'P',  0xAF, 'L',  0xB3, 'G',  0xB8, 0xAA, 0xAA};
    EXPECT_EQ(heard(), expected);
    EXPECT_EQ(read(reg::MAP_VERSION), 1U);
    EXPECT_EQ(read(reg::FW_VERSION), 0x100U) << "0.1.0";
}

TEST_F(UserPortTest, EveryRegisterOfTheMapIsReadAndNoOtherIsAnythingButZero) {
    for (unsigned number = 1; number <= 255; ++number) {
        const auto value = read(static_cast<std::uint8_t>(number));
        ASSERT_TRUE(value) << number;
        if (reg::find(static_cast<std::uint8_t>(number)) == nullptr) {
            EXPECT_EQ(*value, 0U) << number;
        }
    }
}

TEST_F(UserPortTest, AWriteToWhatCanOnlyBeReadIsRefusedWithAReason) {
    for (unsigned number = 1; number <= 255; ++number) {
        const auto n = static_cast<std::uint8_t>(number);
        const reg::Row* row = reg::find(n);
        if (row != nullptr && row->access != reg::Access::read) continue;
        EXPECT_FALSE(write(n, 0)) << number;
        EXPECT_EQ(result(), result_of(row == nullptr ? Result::no_register : Result::read_only, n)) << number;
    }
}

TEST_F(UserPortTest, ABlockIsSixteenRegistersAndZerosBeyondTheLast) {
    const auto block16 = block(reg::STATUS);
    ASSERT_TRUE(block16);
    EXPECT_EQ(in_block(*block16, 16, reg::SAFE_REASON), 1U) << "not started";
    const auto last = block(250);
    ASSERT_TRUE(last);
    for (const std::uint8_t byte : last->view()) EXPECT_EQ(byte, 0);
}

TEST_F(UserPortTest, MessagesThatAreNotForTheGatewayGetNoAnswer) {
    for (const auto kind : {mactalk::Kind::read_samples, mactalk::Kind::safe_mode, mactalk::Kind::init_mode,
                            mactalk::Kind::write_flash, mactalk::Kind::reset}) {
        ask({.kind = kind, .address = reg::kDefaultAddress});
        EXPECT_TRUE(heard().empty());
    }
    ask({.kind = mactalk::Kind::read, .address = 33, .reg = 1});
    EXPECT_TRUE(heard().empty());
}

TEST_F(UserPortTest, UploadsActivatesReadsBackAndRuns) {
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

TEST_F(UserPortTest, AFullTableGoesInPiecesAndSurvivesARestart) {
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

TEST_F(UserPortTest, ALostAnswerIsMendedByThePointer) {
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

TEST_F(UserPortTest, AnUploadThatIsNotAsAnnouncedLeavesTheStoredOne) {
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

TEST_F(UserPortTest, AFaultyTableIsNamedByItsTerm) {
    const Bytes bad{{0xC0, 0, 0, 0x00, 0x80, 0, 0, 0}, {0xC0, 0, 0, 0x3F, 0x80, 0, 0, 0}};
    EXPECT_FALSE(upload(bad));
    EXPECT_EQ(read(reg::UPLOAD_STATE), 5U | (34U << 8) | (1U << 16)) << "bad_next_step in term 1";
    board.missing_register = 5;
    const Bytes misfit{{0xC0, 0x00, 0x80, 0x05, 0x64, 0, 0, 0}};
    EXPECT_FALSE(upload(misfit));
    EXPECT_EQ(read(reg::UPLOAD_STATE), 5U | (36U << 8)) << "not_for_motor in term 0";
}

TEST_F(UserPortTest, PiecesWithoutABeginningAreRefused) {
    EXPECT_FALSE(send(std::span<const std::uint8_t>(kPortTable)));
    EXPECT_EQ(result(), result_of(Result::no_upload, reg::TABLE_DATA));
    EXPECT_FALSE(command(Command::upload_commit));
    EXPECT_FALSE(command(Command::activate));
    EXPECT_EQ(result(), result_of(Result::nothing_stored, reg::COMMAND));
    EXPECT_FALSE(command(Command::run));
    EXPECT_EQ(result(), result_of(Result::no_table, reg::COMMAND));
}

TEST_F(UserPortTest, CommandsAndValuesThatDoNotExistAreRefused) {
    for (const std::uint32_t value : {0U, 10U, 15U, 20U, 255U, 256U, 0x0101U}) {
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

TEST_F(UserPortTest, TwoBytesAreAValueToo) {
    EXPECT_TRUE(write(reg::BREAK_LOW, 0xFFFF'0003, 4));
    EXPECT_TRUE(write(reg::BREAK_LOW, 0x0005, 2));
    EXPECT_EQ(read(reg::BREAK_LOW), 5U);
}

TEST_F(UserPortTest, TermsThatFired) {
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

TEST_F(UserPortTest, TheLogTellsReasonsWithTheirTimes) {
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

TEST_F(UserPortTest, FaultsOfLinesAreShownIfTheBoardNamesThem) {
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
    EXPECT_FALSE(write(reg::LINE_FAULTS + 3, 0));
    EXPECT_EQ(result(), result_of(Result::no_register, reg::LINE_FAULTS + 3));
}

TEST(SettingsKeeper, WhatTheBoardDecidesGoesBeforeWhatWasStored) {
    sim::SimStorage flash(PortBench::kFlash);
    SettingsKeeper keeper(flash, PortBench::kSettings);
    keeper.start({});
    keeper.impose(store::Setting::motor_kind, 2);
    EXPECT_EQ(keeper.get(store::Setting::motor_kind), 2U);
    EXPECT_EQ(keeper.at_start(store::Setting::motor_kind), 2U);
    EXPECT_FALSE(keeper.differ());
}

TEST(SettingsKeeper, TheMotorsSilenceIsTheDrivers) {
    store::SettingValues values;
    EXPECT_EQ(motor::jvl::settings_of(driver_settings_of(values)).link.silence, base::Milliseconds(20));
    ASSERT_TRUE(values.set(store::Setting::motor_silence, 150).ok());
    EXPECT_EQ(motor::jvl::settings_of(driver_settings_of(values)).link.silence, base::Milliseconds(150));
    EXPECT_EQ(motor::jvl::settings_of(driver_settings_of(values)).link.proof_time, base::Milliseconds(150));
}

TEST_F(UserPortTest, SettingsAreWrittenWhileStoppedAndKept) {
    const auto number = [](store::Setting setting) { return reg::register_of(setting); };
    for (const registers::gateway::SettingInfo& info : registers::gateway::all_settings()) {
        EXPECT_EQ(read(number(info.id)), keeper->get(info.id)) << info.name;
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

TEST_F(UserPortTest, AResetIsAskedForOnlyWhileStopped) {
    start_table();
    EXPECT_FALSE(command(Command::reset));
    EXPECT_FALSE(controller->reset_asked());
    ASSERT_TRUE(command(Command::stop));
    static_cast<void>(command(Command::reset));
    EXPECT_TRUE(controller->reset_asked());
}

TEST_F(UserPortTest, ANewMessageEndsTheWaitForTheAnswerBefore) {
    board.access_answers = motor::AccessState::under_way;
    ask({.kind = mactalk::Kind::read, .address = kMotor, .reg = 5});
    EXPECT_TRUE(heard(100ms).empty());
    EXPECT_EQ(read(reg::MAP_VERSION), 1U);
    board.access = motor::AccessState::done;
    EXPECT_TRUE(heard(100ms).empty()) << "nobody waits for it any more";
}

TEST_F(UserPortTest, TheMotorIsReadAndWrittenForItsAddressAndForEveryone) {
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

TEST_F(UserPortTest, AMac800IsReadAndWrittenInLongwords) {
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

TEST_F(UserPortTest, AMotorThatDoesNotAnswerIsNotAnsweredFor) {
    board.access_answers = motor::AccessState::failed;
    EXPECT_FALSE(read(5, kMotor));
    EXPECT_EQ(board.accesses.size(), 2U) << "a read is tried twice";
    EXPECT_FALSE(write(5, 1, 2, kMotor));
    EXPECT_EQ(board.accesses.size(), 3U) << "a write is not: it may have been executed";
    board.link_state = motor::Link::down;
    EXPECT_FALSE(read(5, kMotor));
    EXPECT_EQ(board.accesses.size(), 3U);
}

TEST_F(UserPortTest, WhatFlexMacCannotCarryNeedsTheMotorsOwnPort) {
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

TEST_F(UserPortTest, NoiseInFrontOfAMessageDoesNotHurt) {
    const std::vector<std::uint8_t> noise{0x52, 0x52, 0x52, 0x80, 0x7F, 0x30, 0xCF, 0x80, 0x50, 0x50, 0xAA};
    put(noise);
    line.received.push_back({0x50, true});
    EXPECT_EQ(read(reg::IDENTITY), reg::kIdentity);
}

}  // namespace
}  // namespace nplc::gateway
