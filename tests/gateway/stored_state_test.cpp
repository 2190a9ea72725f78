// Whatever happens to the bytes that are stored: what starts by itself is what was stored last, under the
// settings that were stored last, and otherwise it is stopped and gives the reason.
#include <gtest/gtest.h>

#include "base/crc32.h"
#include "gateway/status_light.h"
#include "port_bench.h"

namespace nplc::gateway {
namespace {

using reg::Command;
using store::Setting;

const Bytes kOlder{{0xC0, 0, 0, 0x3E, 0x80, 0x0F, 0, 0}};
// Step 0: IN0 -> step 1 with outputs 5, sends 40h (P1). Step 1: IN1 -> step 0, outputs 0.
const Bytes kStoredTable{{0xC0, 0x01, 0x01, 0x01, 0x40, 0x05, 0, 0},
                         {0xC1, 0x02, 0x02, 0x00, 0x80, 0x00, 0, 0}};
constexpr Settings kConfigured{.safe_outputs = 0x02, .autostart = true};

struct StoredState : testing::Test, PortBench {
    StoredState() : PortBench(kConfigured) {}

    void keep(Setting setting, std::uint32_t value) {
        ASSERT_TRUE(write(reg::register_of(setting), value));
        ASSERT_TRUE(command(Command::keep_settings));
    }

    /// The next start with every bit flipped that the store has ever changed, and with every block lost.
    template <class Look>
    void damage_each(Look look) {
        const sim::SimStorage sound = flash;
        const auto begin = [&] {
            start(kConfigured);
            run(10ms);
            look();
            flash = sound;
        };
        for (std::uint32_t address = 0; address < kFlash.size; ++address) {
            const bool is_blank = sound.bytes()[address] == 0xFF && address % 64 != 0 && address % 64 != 56;
            for (unsigned bit = 0; bit < 8 && !is_blank; ++bit) {
                flash.flip(address, bit);
                begin();
            }
        }
        for (std::uint32_t block = 0; block < kFlash.size; block += kFlash.erase_block) {
            for (const unsigned byte : {0xFFU, 0x00U}) {
                flash.fill(block, kFlash.erase_block, static_cast<std::uint8_t>(byte));
                begin();
            }
        }
    }

    bool is_shown() const {
        const SafeReason reason = gateway->safe_reason();
        return reason == SafeReason::bad_settings || reason == SafeReason::bad_table;
    }
};

TEST_F(StoredState, WithoutAutostartNoDamageStartsAnything) {
    ASSERT_TRUE(upload(kStoredTable));
    keep(Setting::autostart, 0);
    keep(Setting::enable_input, 3);
    keep(Setting::safe_outputs, 5);
    damage_each([&] {
        EXPECT_EQ(gateway->run_state(), RunState::stopped);
        EXPECT_TRUE(board.out == 5 || board.out == 2 || board.out == 0)
            << "the stored ones, those before, the configured ones";
        EXPECT_TRUE(manager->get(Setting::enable_input) == 3 || manager->were_damaged());
    });
}

TEST_F(StoredState, WhatStartsByItselfIsWhatWasStoredLast) {
    ASSERT_TRUE(upload(kOlder));
    ASSERT_TRUE(upload(kStoredTable));
    keep(Setting::longest_wait, 700);
    keep(Setting::longest_wait, 800);
    unsigned ran = 0;
    unsigned stopped = 0;
    damage_each([&] {
        if (gateway->run_state() == RunState::stopped) {
            ++stopped;
            EXPECT_TRUE(is_shown());
            return;
        }
        ++ran;
        EXPECT_EQ(tables->active_crc(), base::crc32(kStoredTable));
        EXPECT_EQ(manager->get(Setting::longest_wait), 800U);
    });
    EXPECT_GT(ran, 100U);
    EXPECT_GT(stopped, 100U);
}

/// With require_proof: the digest that it was uploaded with, or nothing runs.
TEST_F(StoredState, WhatStartsUnderRequireProofHasItsOwnDigest) {
    const auto with_proof = [](std::span<const std::uint8_t> table, std::uint8_t digest) {
        std::vector<std::uint8_t> content(table.begin(), table.end());
        content.insert(content.end(), reg::kProofMark.begin(), reg::kProofMark.end());
        content.insert(content.end(), reg::kDigestBytes, digest);
        return content;
    };
    ASSERT_TRUE(upload(with_proof(kOlder, 0x11)));
    ASSERT_TRUE(upload(with_proof(kStoredTable, 0x22)));
    keep(Setting::require_proof, 1);
    unsigned ran = 0;
    damage_each([&] {
        if (gateway->run_state() == RunState::stopped) return;
        ++ran;
        EXPECT_EQ(tables->active_crc(), base::crc32(kStoredTable));
        for (std::size_t word = 0; word < reg::kProofWords; ++word)
            EXPECT_EQ(tables->proof_word(word), 0x22222222U);
    });
    EXPECT_GT(ran, 100U);
}

TEST_F(StoredState, TheOnlySettingsAndTheOnlyTable) {
    ASSERT_TRUE(upload(kStoredTable));
    keep(Setting::longest_wait, 800);
    damage_each([&] {
        if (gateway->run_state() == RunState::stopped) {
            EXPECT_TRUE(is_shown());
            return;
        }
        EXPECT_EQ(tables->active_crc(), base::crc32(kStoredTable));
        EXPECT_EQ(manager->get(Setting::longest_wait), 800U);
    });
}

TEST_F(StoredState, DamagedSettingsLockUntilSomeAreKept) {
    ASSERT_TRUE(upload(kStoredTable));
    keep(Setting::safe_outputs, 5);
    flash.flip(store::Layout(kFlash, kSettings).content(0) + 28, 0);
    start({.safe_outputs = 0x02, .autostart = true, .status_output = 3});
    run(3ms);
    EXPECT_EQ(board.out & 7, 0x02);
    EXPECT_EQ(read(reg::SAFE_REASON), 9U) << "bad settings";
    EXPECT_EQ(read(reg::STORE_FLAGS), 2U);
    for (const Command order : {Command::run, Command::scan, Command::step}) {
        EXPECT_TRUE(command(Command::stop));
        EXPECT_FALSE(command(order));
        EXPECT_EQ(result(), result_of(reg::Result::not_enabled, reg::COMMAND));
        EXPECT_EQ(read(reg::SAFE_REASON), 9U) << "a stop does not hide it";
    }
    EXPECT_TRUE(status_light(gateway->run_state(), gateway->safe_reason(), 750)) << "four flashes";
    EXPECT_FALSE(status_light(gateway->run_state(), gateway->safe_reason(), 1'400));
    keep(Setting::safe_outputs, 5);
    EXPECT_EQ(read(reg::STORE_FLAGS), 0U);
    EXPECT_EQ(read(reg::SAFE_REASON), 1U) << "not started";
    EXPECT_TRUE(command(Command::run));
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::running);
    start(kConfigured);
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::running) << "by itself again";
}

TEST_F(StoredState, AfterACutInTheFirstUploadNothingIsSaidToBeDamaged) {
    ASSERT_TRUE(command(Command::upload_begin));
    run(100ms);
    ASSERT_TRUE(send(kStoredTable));
    start(kConfigured);
    EXPECT_EQ(read(reg::STORE_FLAGS), 0U);
    EXPECT_EQ(read(reg::SAFE_REASON), 1U);
}

}  // namespace
}  // namespace nplc::gateway
