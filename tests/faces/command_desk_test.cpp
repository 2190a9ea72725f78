#include "faces/command_desk.h"

#include <gtest/gtest.h>

#include "registers/gateway.h"

namespace nplc::faces {
namespace {

namespace gw = registers::gateway;

constexpr base::Instant kNow{base::Milliseconds(1'000)};

Command run() {
    return Command::of(gw::Command::run, kNow);
}
Command stop() {
    return Command::of(gw::Command::stop, kNow);
}

struct Desk {
    std::optional<CommandDesk::Work> take(bool stops_only = false) {
        std::optional<CommandDesk::Work> work;
        EXPECT_TRUE(desk.take(work, stops_only));
        return work;
    }

    CommandDesk desk;
    int rung = 0;
    Bell bell{[this] { ++rung; }};
    std::unique_ptr<CommandDesk::Client> one = desk.join(Side::person, "one", bell);
    std::unique_ptr<CommandDesk::Client> two = desk.join(Side::plant, "two", bell);
};

TEST(Command, KnowsWhatStopsAndWhatOperates) {
    EXPECT_TRUE(stop().is_stop());
    EXPECT_TRUE(Command::of(gw::Command::safe, kNow).is_stop());
    EXPECT_TRUE(Command::of(gw::Command::hold, kNow).is_stop());
    EXPECT_FALSE(stop().operates());
    EXPECT_FALSE(run().is_stop());
    EXPECT_TRUE(run().operates());
    EXPECT_TRUE(Command::own(gw::FORCE_IN, 0x0101, kNow).operates());
    EXPECT_FALSE(Command::own(gw::UPLOAD_BYTES, 8, kNow).operates());
    EXPECT_FALSE(Command::own(gw::TABLE_POINTER, 0, kNow).operates());
    EXPECT_FALSE(Command::own(gw::SET_POINT_POINTER, 0, kNow).operates());
    EXPECT_TRUE(Command::set_points(std::array<std::uint8_t, 8>{}, gw::Origin::modbus, kNow).operates());
    EXPECT_TRUE(Command::table_piece(std::array<std::uint8_t, 4>{}, kNow).operates());
    EXPECT_TRUE(Command::motor_write(5, false, 2, kNow).operates());
    EXPECT_FALSE(Command::motor_read(5, false, kNow).operates());
}

TEST(CommandDesk, ClientsTakeTurns) {
    Desk desk;
    ASSERT_TRUE(desk.one->submit(run()));
    ASSERT_TRUE(desk.one->submit(run()));
    ASSERT_TRUE(desk.two->submit(run()));
    EXPECT_EQ(desk.take()->client.name, "one");
    EXPECT_EQ(desk.take()->client.name, "two");
    EXPECT_EQ(desk.take()->client.name, "one");
    EXPECT_FALSE(desk.take());
}

TEST(CommandDesk, TellsHowACommandEndedAndRings) {
    Desk desk;
    const auto id = desk.one->submit(run());
    const auto work = desk.take();
    EXPECT_FALSE(desk.one->take());
    ASSERT_TRUE(desk.desk.end(*work, {.id = work->id, .result = Result::no_table}));
    EXPECT_EQ(desk.rung, 1);
    const auto ended = desk.one->take();
    ASSERT_TRUE(ended);
    EXPECT_EQ(ended->id, *id);
    EXPECT_EQ(ended->result, Result::no_table);
}

/// 8 of one client wait at the most, and they block no other client.
TEST(CommandDesk, IsBounded) {
    Desk desk;
    for (int i = 0; i < 8; ++i) EXPECT_TRUE(desk.one->submit(run()));
    EXPECT_FALSE(desk.one->submit(run()));
    EXPECT_TRUE(desk.two->submit(run()));
    EXPECT_TRUE(desk.one->submit(stop()));
    std::vector<std::unique_ptr<CommandDesk::Client>> others;
    for (int i = 0; i < 62; ++i) others.push_back(desk.desk.join(Side::plant, "", desk.bell));
    EXPECT_NE(others.back(), nullptr);
    EXPECT_EQ(desk.desk.join(Side::plant, "", desk.bell), nullptr);
}

TEST(CommandDesk, AStopGoesBeforeAllAndEndsWhatItsClientGaveBefore) {
    Desk desk;
    const auto ran = desk.one->submit(run());
    ASSERT_TRUE(desk.two->submit(run()));
    ASSERT_TRUE(desk.one->submit(Command::of(gw::Command::hold, kNow)));
    ASSERT_TRUE(desk.two->submit(stop()));
    const auto dropped = desk.one->take();
    ASSERT_TRUE(dropped);
    EXPECT_EQ(dropped->id, *ran);
    EXPECT_EQ(dropped->result, Result::too_late);
    // Stop before hold, whoever was first.
    EXPECT_EQ(desk.take(true)->command.value, stop().value);
    EXPECT_EQ(desk.take(true)->command.value, static_cast<std::uint32_t>(gw::Command::hold));
    EXPECT_FALSE(desk.take(true));
}

TEST(CommandDesk, AStopThatWaitsAlreadyIsTheSame) {
    Desk desk;
    const auto first = desk.one->submit(stop());
    EXPECT_EQ(desk.one->submit(stop()), first);
    EXPECT_TRUE(desk.take());
    EXPECT_FALSE(desk.take());
}

TEST(CommandDesk, DropsWhatOperatesAndKeepsReads) {
    Desk desk;
    ASSERT_TRUE(desk.two->submit(run()));
    const auto read = desk.two->submit(Command::motor_read(10, true, kNow));
    ASSERT_TRUE(desk.desk.drop_all_that_operates());
    EXPECT_EQ(desk.two->take()->result, Result::too_late);
    EXPECT_EQ(desk.take()->id, *read);
}

/// What waits of it is not carried out, but for its stops.
TEST(CommandDesk, AClientThatLeavesIsForgotten) {
    Desk desk;
    const std::uint64_t number = desk.one->number();
    ASSERT_TRUE(desk.one->submit(run()));
    ASSERT_TRUE(desk.one->submit(stop()));
    ASSERT_TRUE(desk.one->submit(run()));
    desk.one.reset();
    base::Ring<std::uint64_t, CommandDesk::kMostClients> leavers;
    ASSERT_TRUE(desk.desk.take_leavers(leavers));
    EXPECT_TRUE(leavers.empty());
    const auto work = desk.take();
    ASSERT_TRUE(work);
    EXPECT_TRUE(work->command.is_stop());
    EXPECT_TRUE(desk.desk.end(*work, {.id = work->id}));
    EXPECT_FALSE(desk.take());
    ASSERT_TRUE(desk.desk.take_leavers(leavers));
    ASSERT_FALSE(leavers.empty());
    EXPECT_EQ(leavers.front(), number);
}

TEST(Bell, RingsOnceForEveryArm) {
    int rung = 0;
    Bell bell([&rung] { ++rung; });
    bell.strike();
    bell.strike();
    EXPECT_EQ(rung, 1);
    bell.arm();
    bell.strike();
    EXPECT_EQ(rung, 2);
}

}  // namespace
}  // namespace nplc::faces
