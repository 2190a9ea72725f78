// The Stellaris flash driver on a model of its chip, written from the data sheet (LM3S6965, "Internal
// Memory"): a command counts only with its key, takes a while, and is not disturbed meanwhile; a word is
// programmed to the AND of old and new; protected blocks stay unchanged, and ARIS is set.

#include "hal_mcu/stellaris/flash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace nplc::hal_mcu::stellaris {
namespace {

using ports::StorageState;

constexpr std::uint32_t kBegin = 0x3000;
constexpr std::uint32_t kSize = 8 * 1024;

class ChipModel final : public FlashAccess {
  public:
    using Order = std::pair<std::uint32_t, std::uint32_t>;

    std::uint32_t get(std::uint32_t offset) override {
        if (offset == 0x00C) return violated ? 1 : 0;
        EXPECT_EQ(offset, 0x008U) << "no register that a driver reads";
        if (looks_left_ == 0) end();
        if (looks_left_ > 0) --looks_left_;
        return command_;
    }
    void set(std::uint32_t offset, std::uint32_t value) override {
        orders.emplace_back(offset, value);
        EXPECT_EQ(command_, 0U) << "written while it works";
        if (offset == 0x000) address_ = value & 0x3'FFFF;
        if (offset == 0x004) data_ = value;
        if (offset == 0x008 && value >> 16 == 0xA442) begin(value & 0xFFFF);
        if (offset == 0x014 && (value & 1U) != 0) violated = false;
    }
    std::uint8_t byte(std::uint32_t address) override {
        EXPECT_EQ(command_, 0U) << "read while it works";
        return memory.at(address);
    }
    /// Power fails now: what is under way is left half done.
    void cut() {
        if (command_ == 0) return;
        if (command_ == 1) data_ |= 0x0F0F'0F0F;
        if (command_ == 2)
            std::fill_n(memory.begin() + address_ / kPage * kPage, kPage / 2, std::uint8_t{0xFF});
        if (command_ == 1) end();
        command_ = 0;
    }

    static constexpr std::uint32_t kPage = 1024;
    std::vector<std::uint8_t> memory = std::vector<std::uint8_t>(256 * 1024, 0x55);
    std::set<std::uint32_t> protected_pages;
    std::vector<Order> orders;
    std::set<std::uint32_t> programmed;  ///< words, since their page was erased
    bool violated = false;
    int looks = 3;  ///< at FMC until a command is done
    int commands = 0;

  private:
    void begin(std::uint32_t command) {
        EXPECT_TRUE(command == 1 || command == 2) << command;
        ++commands;
        command_ = command;
        looks_left_ = looks;
        if (protected_pages.contains(address_ / kPage)) {
            violated = true;
            command_ = 0;
        }
    }
    void end() {
        if (command_ == 1) program_word();
        if (command_ == 2) erase_page();
        command_ = 0;
        looks_left_ = -1;
    }
    void program_word() {
        EXPECT_EQ(address_ % 4, 0U);
        EXPECT_TRUE(programmed.insert(address_).second) << address_ << " was programmed twice";
        for (std::uint32_t i = 0; i < 4; ++i)
            memory.at(address_ + i) &= static_cast<std::uint8_t>(data_ >> (8 * i));
    }
    void erase_page() {
        const std::uint32_t page = address_ / kPage * kPage;
        std::fill_n(memory.begin() + page, kPage, std::uint8_t{0xFF});
        programmed.erase(programmed.lower_bound(page), programmed.lower_bound(page + kPage));
    }

    std::uint32_t address_ = 0;
    std::uint32_t data_ = 0;
    std::uint32_t command_ = 0;
    int looks_left_ = -1;
};

struct FlashBench {
    ChipModel chip;
    Flash flash{chip, kBegin, kSize};

    StorageState wait() {
        for (int i = 0; i < 10'000 && flash.state() == StorageState::busy; ++i) continue;
        return flash.state();
    }
    void erase(std::uint32_t address) {
        EXPECT_TRUE(flash.erase(address).ok());
        EXPECT_EQ(wait(), StorageState::ready);
    }
};

std::vector<std::uint8_t> counting(std::size_t size) {
    std::vector<std::uint8_t> bytes(size);
    std::iota(bytes.begin(), bytes.end(), std::uint8_t{1});
    return bytes;
}

TEST(StellarisFlash, HasPagesOfAKibibyteAndWords) {
    const auto geometry = FlashBench().flash.geometry();
    EXPECT_EQ(geometry.size, kSize);
    EXPECT_EQ(geometry.erase_block, 1024U);
    EXPECT_EQ(geometry.program_page, 1024U);
    EXPECT_EQ(geometry.program_unit, 4U);
}

TEST(StellarisFlash, ErasesOnePageWithTheSequenceOfTheDataSheet) {
    FlashBench bench;
    bench.erase(0x400);
    const std::vector<ChipModel::Order> expected{{0x000, 0x3400}, {0x004, 0}, {0x008, 0xA442'0002}};
    EXPECT_EQ(bench.chip.orders, expected);
    EXPECT_EQ(bench.chip.memory[0x33FF], 0x55);
    EXPECT_EQ(bench.chip.memory[0x3400], 0xFF);
    EXPECT_EQ(bench.chip.memory[0x37FF], 0xFF);
    EXPECT_EQ(bench.chip.memory[0x3800], 0x55);
}

TEST(StellarisFlash, ProgramsWordsLowByteFirstOneAfterTheOther) {
    FlashBench bench;
    bench.erase(0x400);
    bench.chip.orders.clear();
    const auto bytes = counting(8);
    ASSERT_TRUE(bench.flash.program(0x404, bytes).ok());
    EXPECT_EQ(bench.wait(), StorageState::ready);
    const std::vector<ChipModel::Order> expected{{0x000, 0x3404}, {0x004, 0x0403'0201}, {0x008, 0xA442'0001},
                                                 {0x000, 0x3408}, {0x004, 0x0807'0605}, {0x008, 0xA442'0001}};
    EXPECT_EQ(bench.chip.orders, expected);
    std::array<std::uint8_t, 16> read{};
    ASSERT_TRUE(bench.flash.read(0x400, read).ok());
    const std::array<std::uint8_t, 16> around{0xFF, 0xFF, 0xFF, 0xFF, 1,    2,    3,    4,
                                              5,    6,    7,    8,    0xFF, 0xFF, 0xFF, 0xFF};
    EXPECT_EQ(read, around);
}

TEST(StellarisFlash, FillsAWholePageSomeWordsAtATime) {
    FlashBench bench;
    bench.chip.looks = 0;  // as on the chip, whose core stands until a command is done
    bench.erase(0);
    const auto bytes = counting(1024);
    ASSERT_TRUE(bench.flash.program(0, bytes).ok());
    int before = bench.chip.commands;
    while (bench.flash.state() == StorageState::busy) {
        EXPECT_LE(bench.chip.commands - before, 16) << "the loop waits too long";
        before = bench.chip.commands;
    }
    EXPECT_EQ(bench.chip.commands, 1 + 256);
    EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), bench.chip.memory.begin() + kBegin));
}

TEST(StellarisFlash, IsBusyUntilTheLastWordAndThenTakesTheNext) {
    FlashBench bench;
    bench.erase(0);
    const auto bytes = counting(12);
    std::array<std::uint8_t, 4> read{};
    ASSERT_TRUE(bench.flash.program(0, bytes).ok());
    EXPECT_EQ(bench.flash.erase(0).error(), base::Error::busy);
    EXPECT_EQ(bench.flash.program(0x100, bytes).error(), base::Error::busy);
    EXPECT_EQ(bench.flash.read(0, read).error(), base::Error::busy);
    EXPECT_EQ(bench.wait(), StorageState::ready);
    EXPECT_EQ(bench.chip.programmed.size(), 3U);
    EXPECT_TRUE(bench.flash.program(0x100, bytes).ok());
}

TEST(StellarisFlash, AProtectedPageIsAFailureAndNothingFollowsIt) {
    FlashBench bench;
    bench.erase(0);
    bench.chip.protected_pages = {kBegin / 1024, kBegin / 1024 + 1};
    ASSERT_TRUE(bench.flash.erase(0x400).ok());
    EXPECT_EQ(bench.wait(), StorageState::failed);
    EXPECT_EQ(bench.flash.state(), StorageState::failed) << "until the next operation";
    EXPECT_EQ(bench.chip.memory[kBegin + 0x400], 0x55);

    const int before = bench.chip.commands;
    const auto bytes = counting(64);
    ASSERT_TRUE(bench.flash.program(0, bytes).ok());
    EXPECT_EQ(bench.wait(), StorageState::failed);
    EXPECT_EQ(bench.chip.commands - before, 1);

    bench.chip.protected_pages.clear();
    ASSERT_TRUE(bench.flash.program(0, bytes).ok());
    EXPECT_EQ(bench.wait(), StorageState::ready);
    bench.erase(0x400);
}

TEST(StellarisFlash, AViolationFromBeforeIsNotTheNextOperationsFault) {
    FlashBench bench;
    bench.chip.violated = true;
    bench.erase(0x400);
}

TEST(StellarisFlash, RefusesWhatDoesNotFit) {
    FlashBench bench;
    const auto bytes = counting(8);
    std::array<std::uint8_t, 8> read{};
    EXPECT_EQ(bench.flash.program(2, bytes).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.flash.program(0, std::span(bytes).first(6)).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.flash.program(1020, bytes).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.flash.program(kSize, bytes).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.flash.erase(kSize).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.flash.erase(4).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.flash.read(kSize - 4, read).error(), base::Error::bad_geometry);
    EXPECT_EQ(bench.chip.commands, 0);
}

TEST(StellarisFlash, APowerCutSpoilsOneWordAtTheMost) {
    const auto bytes = counting(40);
    for (int commands = 0; commands <= 10; ++commands) {
        FlashBench bench;
        bench.erase(0);
        ASSERT_TRUE(bench.flash.program(0, bytes).ok());
        while (bench.chip.commands - 1 < commands) static_cast<void>(bench.flash.state());
        bench.chip.cut();
        const auto* const page = &bench.chip.memory[kBegin];
        const auto whole = static_cast<std::size_t>(std::max(commands - 1, 0)) * 4;
        const auto begun = static_cast<std::size_t>(commands) * 4;
        EXPECT_TRUE(std::equal(page, page + whole, bytes.begin())) << commands;
        EXPECT_TRUE(std::all_of(page + begun, page + 1024, [](std::uint8_t byte) { return byte == 0xFF; }))
            << commands;
        EXPECT_TRUE(commands == 0 || !std::equal(page + whole, page + begun, &bytes[whole])) << commands;
    }
}

}  // namespace
}  // namespace nplc::hal_mcu::stellaris
