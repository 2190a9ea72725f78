// A table with the digest of its certificate behind it, and the setting that asks for one: REGISTERS.md,
// Upload.
#include <gtest/gtest.h>

#include "base/crc32.h"
#include "port_bench.h"

namespace nplc::gateway {
namespace {

using reg::Command;
using reg::Result;
using store::Setting;

using ProvenBytes = std::vector<std::uint8_t>;

// Step 0: always -> outputs 5. And the same with outputs 3.
const Bytes kMine{{0xC0, 0, 0, 0x3E, 0x80, 0x05, 0, 0}};
const Bytes kOthers{{0xC0, 0, 0, 0x3E, 0x80, 0x03, 0, 0}};

/// `first`, first + 1, ... as a digest.
ProvenBytes with_proof(std::span<const std::uint8_t> table, std::uint8_t first) {
    ProvenBytes content(table.begin(), table.end());
    for (const char sign : std::string_view("NPLPROOF")) content.push_back(static_cast<std::uint8_t>(sign));
    for (unsigned i = 0; i < 32; ++i) content.push_back(static_cast<std::uint8_t>(first + i));
    return content;
}

struct ProofTest : testing::Test, PortBench {
    void require_proof() {
        ASSERT_TRUE(write(reg::register_of(Setting::require_proof), 1));
        ASSERT_TRUE(write(reg::register_of(Setting::autostart), 1));
        ASSERT_TRUE(command(Command::keep_settings));
    }
    bool has_proof() { return read(reg::PROOF) != 0U; }
};

TEST_F(ProofTest, TheDigestComesWithTheTableAndIsNoPartOfIt) {
    const ProvenBytes content = with_proof(kMine, 0x10);
    ASSERT_TRUE(upload_and_activate(content));
    EXPECT_EQ(read(reg::TABLE_BYTES), 16U);
    EXPECT_EQ(read(reg::TABLE_CRC), base::crc32(kMine));
    EXPECT_EQ(read(reg::STORED_BYTES), 16U + 40U);
    EXPECT_EQ(read(reg::STORED_CRC), base::crc32(content));
    EXPECT_EQ(status() & reg::kStoredDiffers, 0U);
    EXPECT_EQ(read(reg::PROOF_BYTES), 40U);
    EXPECT_EQ(read(63), 0x13121110U);
    EXPECT_EQ(read(70), 0x2F2E2D2CU);
    ASSERT_TRUE(write(reg::TABLE_POINTER, 0));
    const auto back = block(reg::TABLE_DATA);
    ASSERT_TRUE(back);
    EXPECT_TRUE(std::all_of(back->data.begin() + 16, back->data.end(), [](int b) { return b == 0; }));
    start({.autostart = false});
    EXPECT_EQ(read(63), 0x13121110U) << "after a restart too";
}

TEST_F(ProofTest, AnUploadWithoutOneClearsIt) {
    ASSERT_TRUE(upload_and_activate(with_proof(kMine, 0x10)));
    ASSERT_TRUE(upload(kMine));
    EXPECT_NE(status() & reg::kStoredDiffers, 0U);
    EXPECT_TRUE(has_proof()) << "of the active one, still";
    ASSERT_TRUE(command(Command::activate));
    EXPECT_FALSE(has_proof());
    EXPECT_EQ(status() & reg::kStoredDiffers, 0U);
}

TEST_F(ProofTest, OtherBytesBehindTheEndTermAreNone) {
    const ProvenBytes content = with_proof(kMine, 0x10);
    for (std::size_t bytes = 20; bytes < content.size(); bytes += 4) {
        ASSERT_TRUE(upload_and_activate(std::span(content).first(bytes)));
        EXPECT_FALSE(has_proof()) << bytes;
    }
    ProvenBytes longer = content;
    longer.insert(longer.end(), 8, 0);
    ASSERT_TRUE(upload_and_activate(longer));
    EXPECT_FALSE(has_proof());
    for (std::size_t at = 16; at < 24; ++at) {
        ProvenBytes flipped = content;
        flipped[at] ^= 1;
        ASSERT_TRUE(upload_and_activate(flipped));
        EXPECT_FALSE(has_proof()) << at;
    }
}

TEST_F(ProofTest, AFullTableHasRoomForIt) {
    ProvenBytes table;
    for (std::size_t i = 0; i < sequencer::kMaxTerms; ++i)
        table.insert(table.end(), {0xC0, 0, 0, 0x3E, 0x80, 0, 0, 0});
    table.insert(table.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    ASSERT_TRUE(upload_and_activate(with_proof(table, 0x10)));
    EXPECT_EQ(read(reg::TABLE_BYTES), table.size());
    EXPECT_TRUE(has_proof());
}

TEST_F(ProofTest, WithoutOneNothingStartsWhereOneIsRequired) {
    ASSERT_TRUE(upload_and_activate(kMine));
    require_proof();
    EXPECT_EQ(read(reg::SAFE_REASON), 14U);
    for (const Command order : {Command::run, Command::scan, Command::step}) {
        EXPECT_TRUE(command(Command::stop));
        EXPECT_FALSE(command(order));
        EXPECT_EQ(result(), result_of(Result::no_proof, reg::COMMAND));
        EXPECT_EQ(read(reg::SAFE_REASON), 14U) << "a stop does not hide it";
    }
    start({.autostart = true});
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::stopped) << "nor by itself";
    EXPECT_EQ(read(reg::SAFE_REASON), 14U);
    ASSERT_TRUE(upload_and_activate(with_proof(kMine, 0x10)));
    EXPECT_EQ(read(reg::SAFE_REASON), 1U) << "not started";
    ASSERT_TRUE(command(Command::run));
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::running);
}

TEST_F(ProofTest, WithOneItStartsByItselfAndWithoutTheSettingToo) {
    require_proof();
    EXPECT_EQ(read(reg::SAFE_REASON), 1U) << "without a table there is nothing to prove";
    ASSERT_TRUE(upload(with_proof(kMine, 0x10)));
    start({.autostart = true});
    run(10ms);
    EXPECT_EQ(state(), reg::RunState::running);
    ASSERT_TRUE(command(Command::stop));
    ASSERT_TRUE(upload_and_activate(kMine));
    EXPECT_FALSE(command(Command::run));
    ASSERT_TRUE(write(reg::register_of(Setting::require_proof), 0));
    EXPECT_EQ(read(reg::SAFE_REASON), 1U);
    EXPECT_TRUE(command(Command::run));
}

/// Power fails at every operation of an upload that brings or clears the digest.
TEST_F(ProofTest, ACutLeavesEachDigestBesideItsOwnTable) {
    const ProvenBytes mine = with_proof(kMine, 0x10);
    const ProvenBytes others = with_proof(kOthers, 0x50);
    const ProvenBytes bare(std::span<const std::uint8_t>(kOthers).begin(),
                           std::span<const std::uint8_t>(kOthers).end());
    unsigned cases = 0;
    for (const auto& [before, after] :
         {std::pair(mine, bare), {bare, mine}, {mine, others}, {others, mine}}) {
        flash = sim::SimStorage(kFlash);
        start({.autostart = false});
        ASSERT_TRUE(upload(before));
        std::vector<sim::SimStorage> cut;
        flash.watch([&](const sim::StorageOperation& operation) {
            for (const sim::Tear& tear : sim::tears_of(operation, kFlash))
                cut.push_back(flash.torn(operation, tear));
        });
        ASSERT_TRUE(upload(after));
        for (const sim::SimStorage& torn : cut) {
            flash = torn;
            start({.autostart = false});
            ++cases;
            const std::uint32_t crc = tables->active_crc();
            const std::uint32_t word = tables->proof_word(0);
            if (crc == base::crc32(kMine)) {
                ASSERT_EQ(word, 0x13121110U);
            } else {
                ASSERT_EQ(crc, base::crc32(kOthers));
                ASSERT_EQ(word, before == bare || after == bare ? 0U : 0x53525150U);
            }
        }
    }
    EXPECT_GT(cases, 200U);
    std::cout << cases << " cuts\n";
}

}  // namespace
}  // namespace nplc::gateway
