#include "macreg/motor.h"

#include <gtest/gtest.h>

#include "bench.h"

namespace nplc::macreg {
namespace {

using registers::Model;

std::vector<int> addresses(const Found& found) {
    std::vector<int> all;
    for (const FoundUnit& unit : found.units) all.push_back(unit.address);
    return all;
}

struct FinderTest : testing::Test {
    Units units;
    mactalk_client::SimWire wire{units, 19'200, 1};
};

TEST_F(FinderTest, SilenceEndsItAtOnce) {
    const Found found = find_units(wire, {});
    EXPECT_TRUE(found.units.empty());
    EXPECT_FALSE(found.noise);
    EXPECT_LE(found.asked, 1U);
}

TEST_F(FinderTest, ASingleMotorSaysItsAddressItself) {
    units.add(Model::mac140, 77);
    const Found found = find_units(wire, {});
    EXPECT_EQ(addresses(found), (std::vector<int>{77}));
    EXPECT_LE(found.asked, 3U);
}

TEST_F(FinderTest, SeveralMotorsAreToldApart) {
    units.add(Model::mac140, 3).write(2, 1);
    units.add(Model::mac800, 12);
    units.add(Model::mac95, 200);
    const Found found = find_units(wire, {});
    EXPECT_EQ(addresses(found), (std::vector<int>{3, 12, 200}));
    EXPECT_EQ(found.units[1].model, Model::mac800);
    EXPECT_EQ(found.units[0].mode, 1);
}

// Two of a kind answer PROG_VERSION with the same bytes at the same time; their addresses betray them.
TEST_F(FinderTest, TwinsAreToldApart) {
    units.add(Model::mac140, 5);
    units.add(Model::mac140, 6);
    EXPECT_EQ(addresses(find_units(wire, {})), (std::vector<int>{5, 6}));
}

TEST_F(FinderTest, EveryAddressIsAskedIfWanted) {
    units.add(Model::mac140, 254);
    const Found found = find_units(wire, {.every_address = true});
    EXPECT_EQ(addresses(found), (std::vector<int>{254}));
    EXPECT_GE(found.asked, 254U);
}

// 60 ms of patience and 15 ms on the line: an answer that begins after 70 ms comes while the next address is
// asked.
TEST_F(FinderTest, ALateAnswerIsNotTakenForAnotherAddress) {
    units.add(Model::mac140, 8);
    units.delay = base::Milliseconds{70};
    for (const int address : addresses(find_units(wire, {.every_address = true}))) EXPECT_EQ(address, 8);
}

TEST_F(FinderTest, WritesNothing) {
    sim::MacMotor& motor = units.add(Model::mac140, 5);
    std::vector<std::int32_t> before;
    for (int reg = 1; reg < 165; ++reg) before.push_back(motor.read(static_cast<std::uint8_t>(reg)));
    static_cast<void>(find_units(wire, {.every_address = true}));
    for (int reg = 1; reg < 165; ++reg) {
        const auto* row = registers::find(Model::mac140, static_cast<std::uint8_t>(reg));
        if (row == nullptr || row->access == registers::Access::read_only) continue;
        EXPECT_EQ(motor.read(static_cast<std::uint8_t>(reg)), before[static_cast<std::size_t>(reg - 1)])
            << row->name;
    }
}

}  // namespace
}  // namespace nplc::macreg
