// The gateway's port in the whole world: the virtual motor behind it, line times and the flash.
#include <gtest/gtest.h>

#include "base/bytes.h"
#include "base/crc32.h"
#include "protocol/mactalk.h"
#include "registers/gateway.h"
#include "sim/world.h"

namespace nplc::sim {
namespace {

namespace mactalk = protocol::mactalk;
namespace reg = registers::gateway;
using mactalk::Kind;
using namespace std::chrono_literals;

constexpr std::uint8_t kMotor = 1;
constexpr std::int64_t kCharacter = 520'834;  // ns at 19200 baud

/// One step that does nothing, so often that the bytes are `terms` terms and an end.
std::vector<std::uint8_t> long_table(std::size_t terms) {
    std::vector<std::uint8_t> table;
    for (std::size_t i = 0; i < terms; ++i)
        table.insert(table.end(), {0xC1, 0x01, 0x01, static_cast<std::uint8_t>(i % 60), 0x80, 0, 0, 0});
    table.insert(table.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    return table;
}

struct UserPortRun : testing::Test {
    explicit UserPortRun(const WorldOptions& options = {}) : world({}, options) { go_on(500ms); }

    void go_on(Time duration) {
        for (const Time end = world.now() + duration; world.now() < end;) {
            world.step(end);
            const auto bytes = world.user_received();
            heard.insert(heard.end(), bytes.begin(), bytes.end());
        }
    }
    /// Sends, and waits for so many bytes; a program answers within a character.
    bool exchange(std::span<const std::uint8_t> bytes, std::size_t wanted) {
        heard.clear();
        world.user_sends(bytes);
        for (const Time end = world.now() + 3s; world.now() < end && heard.size() < wanted;) {
            world.step(end);
            const auto more = world.user_received();
            heard.insert(heard.end(), more.begin(), more.end());
        }
        return heard.size() == wanted;
    }
    std::optional<std::uint32_t> read(std::uint8_t address, std::uint8_t number) {
        const auto request = mactalk::encode({.kind = Kind::read, .address = address, .reg = number});
        if (!exchange(request.view(), 19)) return std::nullopt;
        const std::uint8_t data[]{heard[9], heard[11], heard[13], heard[15]};
        return base::load_u32(data);
    }
    bool write(std::uint8_t address, std::uint8_t number, std::uint32_t value, std::uint8_t length = 4) {
        return exchange(
            mactalk::encode(
                {.kind = Kind::write, .address = address, .reg = number, .length = length, .value = value})
                .view(),
            3);
    }
    bool command(reg::Command command) {
        return write(reg::kDefaultAddress, reg::COMMAND, static_cast<std::uint32_t>(command));
    }
    bool upload(const std::vector<std::uint8_t>& table) {
        if (!command(reg::Command::upload_begin)) return false;
        for (std::size_t at = 0; at < table.size(); at += mactalk::kMaxLongWrite) {
            const auto piece =
                std::span(table).subspan(at, std::min(mactalk::kMaxLongWrite, table.size() - at));
            if (!exchange(mactalk::encode_long_write(reg::kDefaultAddress, reg::TABLE_DATA, piece).view(), 3))
                return false;
        }
        return true;
    }
    bool finish_upload(const std::vector<std::uint8_t>& table) {
        return write(reg::kDefaultAddress, reg::UPLOAD_BYTES, static_cast<std::uint32_t>(table.size())) &&
               write(reg::kDefaultAddress, reg::UPLOAD_CRC, base::crc32(table)) &&
               command(reg::Command::upload_commit) && (go_on(1s), true) &&
               read(reg::kDefaultAddress, reg::UPLOAD_STATE) == 4U;
    }

    World world;
    std::vector<std::uint8_t> heard;
};

TEST_F(UserPortRun, TheMotorsRegistersAreReadAsTheMotorAnswersThem) {
    for (const int each : {1, 5, 7, 35, 49, 65, 255}) {
        const auto number = static_cast<std::uint8_t>(each);
        const auto low = static_cast<std::uint16_t>(world.mac().read(number));
        EXPECT_EQ(read(kMotor, number).value_or(0) & 0xFFFFU, low) << int{number};
        EXPECT_EQ(read(mactalk::kEveryone, number).value_or(0) & 0xFFFFU, low) << int{number};
    }
    EXPECT_FALSE(read(2, 5)) << "another unit's";
}

TEST_F(UserPortRun, TheMotorsRegistersAreWrittenWhileNothingRuns) {
    EXPECT_TRUE(write(kMotor, registers::V1, 777, 2));
    EXPECT_EQ(world.mac().read(registers::V1), 777);
    EXPECT_TRUE(write(kMotor, registers::P1, 123'456));
    EXPECT_EQ(world.mac().read(registers::P1), 123'456);
    EXPECT_EQ(read(kMotor, registers::P1), 123'456U);
}

TEST_F(UserPortRun, ABlockIsTheMotorsThirtyTwoWords) {
    const auto request = mactalk::encode({.kind = Kind::read_block, .address = kMotor, .reg = registers::V1});
    ASSERT_TRUE(exchange(request.view(), mactalk::kMaxReplyBytes));
    for (unsigned i = 0; i < 32; ++i) {
        const unsigned word = heard[9 + 4 * i] | static_cast<unsigned>(heard[11 + 4 * i] << 8);
        const auto number = static_cast<std::uint8_t>(registers::V1 + i);
        const registers::Register* row = registers::find(registers::Model::mac140, number);
        if (row != nullptr) {
            EXPECT_EQ(word, static_cast<std::uint16_t>(world.mac().read(number))) << int{number};
        }
    }
}

// 95 % of what framing and a turn-round of one character allow: 11 + 2 n characters, one, and 3 of answer.
TEST_F(UserPortRun, AnUploadUsesTheLine) {
    const auto table = long_table(1024);
    const Time begun = world.now();
    ASSERT_TRUE(upload(table));
    const Time taken = world.now() - begun;
    std::int64_t characters = 19 + 1 + 3;  // upload_begin: a write of four bytes
    for (std::size_t at = 0; at < table.size(); at += mactalk::kMaxLongWrite) {
        const std::size_t piece = std::min(mactalk::kMaxLongWrite, table.size() - at);
        characters += 11 + 2 * static_cast<std::int64_t>(piece) + 1 + 3;
    }
    const Time possible(characters * kCharacter);
    EXPECT_LE(taken * 95 / 100, possible);
    RecordProperty("percent", static_cast<int>(100 * possible / taken));
    EXPECT_TRUE(finish_upload(table));
}

TEST_F(UserPortRun, AnUploadedTableRunsAfterARestart) {
    const auto table = long_table(3);
    ASSERT_TRUE(upload(table));
    ASSERT_TRUE(finish_upload(table));
    EXPECT_EQ(read(reg::kDefaultAddress, reg::TABLE_BYTES), 0U);
    ASSERT_TRUE(command(reg::Command::activate)) << "the motor stands still";
    EXPECT_EQ(read(reg::kDefaultAddress, reg::TABLE_CRC), base::crc32(table));
    static_cast<void>(command(reg::Command::reset));
    go_on(500ms);
    EXPECT_EQ(read(reg::kDefaultAddress, reg::TABLE_CRC), base::crc32(table));
    EXPECT_EQ(world.gateway().run_state(), gateway::RunState::running) << "autostart";
}

TEST_F(UserPortRun, NoTableBecomesActiveWhileTheMotorMoves) {
    const auto table = long_table(3);
    ASSERT_TRUE(upload(table));
    ASSERT_TRUE(finish_upload(table));
    ASSERT_TRUE(write(kMotor, registers::V_SOLL, 2000, 2));
    ASSERT_TRUE(write(kMotor, registers::A_SOLL, 500, 2));
    ASSERT_TRUE(write(kMotor, registers::MODE_REG, 1, 2)) << "velocity mode";
    go_on(500ms);
    ASSERT_NE(world.mac().v_ist(), 0);
    EXPECT_FALSE(command(reg::Command::activate));
    EXPECT_EQ(read(reg::kDefaultAddress, reg::RESULT).value_or(0) & 0xFFU, 7U) << "moving";
    ASSERT_TRUE(write(kMotor, registers::MODE_REG, 0, 2));
    go_on(3s);
    EXPECT_TRUE(command(reg::Command::activate));
}

TEST_F(UserPortRun, KeptSpeedsTakeHoldAtAReset) {
    const auto setting = [](store::Setting which) { return reg::register_of(which); };
    const auto time_of_a_read = [&] {
        const Time begun = world.now();
        EXPECT_TRUE(read(reg::kDefaultAddress, reg::IDENTITY));
        return world.now() - begun;
    };
    EXPECT_TRUE(world.take_snapshot().link_up);
    const Time before = time_of_a_read();
    ASSERT_TRUE(write(reg::kDefaultAddress, setting(store::Setting::user_baud), 38'400));
    ASSERT_TRUE(write(reg::kDefaultAddress, setting(store::Setting::motor_baud), 9'600));
    ASSERT_TRUE(command(reg::Command::keep_settings));
    EXPECT_EQ(time_of_a_read(), before) << "not yet";
    EXPECT_TRUE(world.take_snapshot().link_up);
    world.gateway(action::Gateway::restart);
    go_on(500ms);
    // 8 characters of question and 19 of answer, of 260 us instead of 521 each.
    EXPECT_NEAR(static_cast<double>((before - time_of_a_read()).count()), 27 * 260'417.0, 1e6);
    EXPECT_FALSE(world.take_snapshot().link_up) << "the motor has 19200 baud";
}

struct WiredRun : UserPortRun {
    WiredRun() : UserPortRun({.faults = {}, .gateway = {}, .motor_mactalk_wired = true}) {}
};

TEST_F(WiredRun, WhatFlexMacCannotCarryGoesOverTheMotorsOwnPort) {
    EXPECT_TRUE(exchange(mactalk::encode({.kind = Kind::safe_mode, .address = kMotor}).view(), 3));
    EXPECT_TRUE(world.mac().is_mode(MotorMode::safe));
    EXPECT_TRUE(exchange(mactalk::encode({.kind = Kind::init_mode, .address = kMotor}).view(), 3));
    EXPECT_FALSE(world.mac().is_mode(MotorMode::safe));
    // 52h x3, address, length 8 and 8 data bytes, each with its inverse, AAh x2.
    EXPECT_TRUE(exchange(mactalk::encode({.kind = Kind::read_samples, .address = kMotor}).view(), 25));
}

}  // namespace
}  // namespace nplc::sim
