// The driver on virtual modules, over both lines: what a sequence orders is what the shaft does.

#include <set>

#include "midi_bench.h"

namespace nplc::motor {
namespace {

struct MidiMotorTest : testing::TestWithParam<Way> {
    MidiBench bench{GetParam()};
    MidiMotor& driver = bench.driver;
    sim::MidiModule& module = bench.drive.module();

    void SetUp() override { bench.start(); }
    /// 1500 rpm (period 32), 20000 rpm/s.
    void set_profile() {
        bench.order(word(registers::V1, 3'146));
        bench.order(word(registers::A1, 81));
        bench.order(fast(kInitV1));
        bench.order_and_settle(fast(kInitA1));
    }
    void go(std::int32_t counts) {
        bench.order(longword(registers::P1 + 2, counts));
        bench.order_and_settle(fast(kPositionP2));
    }
    std::uint32_t read(std::uint8_t reg, bool is_long = false) {
        EXPECT_TRUE(driver.begin_access({.reg = reg, .longword = is_long}));
        EXPECT_TRUE(bench.until([&] { return !is_open(driver.access_state()); }));
        EXPECT_EQ(driver.access_state(), AccessState::done);
        return driver.access_value();
    }
};

INSTANTIATE_TEST_SUITE_P(BothLines, MidiMotorTest, testing::Values(Way::v24, Way::can),
                         [](const auto& way) { return way.param == Way::can ? "Can" : "V24"; });

TEST_P(MidiMotorTest, GoesToAPosition) {
    set_profile();
    go(49'152);
    EXPECT_FALSE(driver.in_position()) << "not that of the move before";
    EXPECT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 120'000);
    EXPECT_EQ(module.memory().period, 32);
    // 6442450.944 / (81 x 32^2) = 77.7.
    EXPECT_EQ(module.memory().ramp, 78);
    EXPECT_EQ(bench.count(midi::GO_TO), 1U);
    EXPECT_FALSE(driver.error());
    EXPECT_EQ(driver.counters().orders, 6U);
    EXPECT_EQ(driver.counters().discarded, 0U);
}

TEST_P(MidiMotorTest, ATargetGivenInMidMoveWaitsForTheEndOfTheMove) {
    set_profile();
    go(49'152);
    bench.pass(100ms);
    ASSERT_TRUE(module.moving());
    go(4'096);
    EXPECT_FALSE(driver.in_position());
    EXPECT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 10'000);
    EXPECT_EQ(bench.count(midi::GO_TO), 2U);
    EXPECT_FALSE(driver.error());
}

/// POSITION(P1, V1), as a scan sends it: V1 in position mode, then P1 (001 section 2.7).
TEST_P(MidiMotorTest, AVelocityBeforeTheTargetStartsNothingTowardsTheOldOne) {
    set_profile();
    bench.order(longword(registers::P1, 4'096));
    go(49'152);
    bench.pass(300ms);
    ASSERT_TRUE(module.moving());
    bench.order_and_settle(fast(kStop));
    ASSERT_TRUE(bench.until([&] { return !module.moving(); }));
    bench.pass(500ms);
    const std::int32_t stopped_at = module.position();
    ASSERT_GT(stopped_at, 10'000);
    ASSERT_TRUE(stopped_at < 119'000);
    bench.order(fast(kPositionV1));
    bench.order(fast(kPositionP1));
    std::int32_t farthest = stopped_at;
    ASSERT_TRUE(bench.until(
        [&] {
            farthest = std::max(farthest, module.position());
            return driver.in_position();
        },
        20s));
    EXPECT_EQ(module.position(), 10'000);
    EXPECT_LE(farthest, stopped_at + 5);
    EXPECT_EQ(bench.count(midi::GO_TO), 2U);
    EXPECT_FALSE(driver.error());
}

/// A scan with more orders than the driver queues: the rest comes at the next poll.
TEST_P(MidiMotorTest, AVelocityBeforeTheTargetStartsNothingWhereTheQueueEndsBetweenThem) {
    set_profile();
    bench.order(longword(registers::P1, 4'096));
    go(49'152);
    ASSERT_TRUE(bench.arrives());
    bench.order_and_settle(fast(kStop));
    bench.pass(500ms);
    std::vector<Order> scan(7, word(registers::A1, 81));
    scan.push_back(longword(registers::P1 + 2, 4'096));
    for (const Order& order : {fast(kPositionV1), fast(kPositionP1)}) scan.push_back(order);
    scan.insert(scan.begin(), longword(registers::P_SOLL, 20'480));
    for (std::size_t next = 0; next < scan.size();) {
        while (next < scan.size() && driver.has_room()) driver.send(scan[next++]);
        bench.step(bench.now + 1ms);
    }
    EXPECT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 10'000);
    EXPECT_EQ(bench.count(midi::GO_TO), 2U);
}

TEST_P(MidiMotorTest, WithoutValuesOfItsOwnTheModulesHold) {
    go(4'096);
    EXPECT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 10'000);
    EXPECT_EQ(bench.count(midi::SPEED) + bench.count(midi::RAMP) + bench.count(midi::TORQUE), 0U);
}

TEST_P(MidiMotorTest, TheSamePlaceAgainIsNoMove) {
    go(4'096);
    ASSERT_TRUE(bench.arrives());
    bench.order_and_settle(fast(kPositionP2));
    EXPECT_FALSE(driver.in_position());
    EXPECT_TRUE(bench.arrives(500ms));
    EXPECT_EQ(bench.count(midi::GO_TO), 1U);
}

TEST_P(MidiMotorTest, RelativeMoves) {
    bench.order(longword(registers::P1, 4'096));
    bench.order(fast(0x75));  // 15h: P_SOLL-relative
    bench.order_and_settle(fast(kPositionP1));
    ASSERT_TRUE(bench.arrives());
    bench.order_and_settle(fast(kPositionP1));
    ASSERT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 20'000);
    bench.order(longword(registers::P1 + 12, -2'048));  // P7
    bench.order_and_settle(fast(0x71));                 // 11h
    ASSERT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 15'000);
}

TEST_P(MidiMotorTest, RunsStopsAndTurnsBack) {
    bench.order(word(registers::V1, 1'600));
    bench.order(word(registers::A1, 160));
    bench.order(fast(kInitA1));
    bench.order_and_settle(fast(kVelocityV1));
    EXPECT_TRUE(bench.until([&] { return module.moving(); }));
    EXPECT_TRUE(bench.arrives());
    const std::int32_t before = module.position();
    bench.pass(1s);
    // Period 63: 126984 increments a second.
    EXPECT_NEAR(module.position() - before, 126'984, 1'300);
    EXPECT_NEAR(static_cast<std::int16_t>(read(registers::V_IST)), 100, 15);
    EXPECT_NEAR(static_cast<std::int16_t>(read(registers::V_IST)), 100, 15);

    bench.order_and_settle(word(registers::V_SOLL, -1'600));
    EXPECT_FALSE(driver.in_position());
    EXPECT_TRUE(bench.arrives());
    const std::int32_t turned = module.position();
    bench.pass(200ms);
    EXPECT_LT(module.position(), turned - 20'000);
    EXPECT_EQ(bench.count(midi::STOP), 1U);

    bench.order_and_settle(fast(kInitV1));
    EXPECT_TRUE(bench.until([&] { return !module.moving(); }));
    bench.pass(200ms);
    EXPECT_FALSE(driver.error());
    EXPECT_FALSE(driver.in_position());
    EXPECT_EQ(bench.count(midi::RUN), 2U);
}

TEST_P(MidiMotorTest, ASpeedChangesInMidRun) {
    bench.order(word(registers::A_SOLL, 160));
    bench.order(word(registers::V1, 1'600));
    bench.order_and_settle(fast(kVelocityV1));
    ASSERT_TRUE(bench.arrives());
    bench.order_and_settle(word(registers::V_SOLL, 800));
    EXPECT_FALSE(driver.in_position());
    ASSERT_TRUE(bench.arrives());
    EXPECT_EQ(bench.count(midi::RUN), 2U);
    EXPECT_EQ(bench.count(midi::STOP), 0U);
    bench.order_and_settle(fast(0x65));  // 05h: V_SOLL = 0
    EXPECT_TRUE(bench.arrives()) << "in velocity mode with V 0 standstill is the position";
    EXPECT_FALSE(module.moving());
}

TEST_P(MidiMotorTest, FromARunToAPosition) {
    bench.order(word(registers::A_SOLL, 160));
    bench.order(word(registers::V1, 1'600));
    bench.order_and_settle(fast(kVelocityV1));
    ASSERT_TRUE(bench.arrives());
    bench.order_and_settle(fast(kPositionP1));
    EXPECT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 0);
    EXPECT_FALSE(driver.error());
}

TEST_P(MidiMotorTest, ZeroIsHere) {
    go(4'096);
    ASSERT_TRUE(bench.arrives());
    bench.order(fast(kInitV1));
    bench.order_and_settle(fast(0x63));
    EXPECT_EQ(module.position(), 0);
    EXPECT_EQ(read(registers::P_IST, true), 0U);
    // P_SOLL is still 4096: as on a JVL motor position mode turns it on.
    bench.order_and_settle(word(registers::MODE_REG, 2));
    EXPECT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 10'000);
}

TEST_P(MidiMotorTest, TorqueAndWindow) {
    bench.order(word(registers::T1, 512));
    bench.order(word(registers::Z1, 32));
    bench.order(fast(0x14));             // INIT, T1
    bench.order_and_settle(fast(0x1C));  // INIT, Z1
    EXPECT_EQ(module.memory().torque, 64);
    EXPECT_EQ(module.memory().tolerance, 78);
    bench.order_and_settle(fast(0x6C));
    EXPECT_EQ(bench.count(midi::TORQUE), 1U) << "the same value wears the EEPROM for nothing";
}

TEST_P(MidiMotorTest, StopComesBeforeEverythingElse) {
    set_profile();
    go(49'152);
    bench.pass(100ms);
    bench.order(longword(registers::P1, 4'096));
    bench.order(fast(kPositionP1));
    driver.stop();
    ASSERT_TRUE(bench.until([&] { return driver.orders_complete(); }));
    EXPECT_EQ(bench.count(midi::STOP), 1U);
    EXPECT_TRUE(bench.until([&] { return !module.moving(); }, 1s));
    bench.pass(1s);
    EXPECT_EQ(bench.count(midi::GO_TO), 1U);
    EXPECT_EQ(driver.counters().discarded, 2U);
    EXPECT_FALSE(driver.in_position());
    EXPECT_FALSE(driver.error());
    bench.order_and_settle(fast(kPositionP1));
    EXPECT_TRUE(bench.arrives()) << "P1 is 0: the write before the stop was dropped";
    EXPECT_EQ(module.position(), 0);
}

/// 003 §IV: catching up is ended by 18h only.
TEST_P(MidiMotorTest, AStopThatIsNotEnoughIsHelpedOn) {
    set_profile();
    module.hold_shaft(true);
    go(4'096);
    bench.pass(1s);
    module.hold_shaft(false);
    bench.pass(100ms);
    ASSERT_TRUE(module.moving());
    driver.stop();
    EXPECT_TRUE(bench.until([&] { return !module.moving(); }, 2s));
    EXPECT_EQ(bench.count(midi::EMERGENCY_STOP), 1U);
}

TEST_P(MidiMotorTest, ATripIsAnErrorUntilResetErrorResetsTheModule) {
    go(4'096);
    ASSERT_TRUE(bench.arrives());
    go(49'152);
    bench.pass(50ms);
    module.overload_amplifier();
    ASSERT_TRUE(bench.until([&] { return driver.error(); }, 200ms));
    EXPECT_EQ(driver.fault(), MidiFault::tripped);
    EXPECT_FALSE(driver.in_position());
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_EQ(read(registers::ERR_STAT) & 0x0FU, 1U);
    const std::int32_t place = module.position();
    bench.order(fast(kResetError));
    ASSERT_TRUE(bench.until([&] { return bench.count(midi::RESET) == 1; }));
    bench.pass(1s);
    EXPECT_TRUE(driver.error()) << "two deaf seconds";
    EXPECT_EQ(driver.link(), Link::starting);
    ASSERT_TRUE(bench.until([&] { return driver.link() == Link::up; }, 3s));
    EXPECT_FALSE(driver.error());
    EXPECT_EQ(driver.counters().link_losses, 0U);
    EXPECT_EQ(module.position(), place);
    bench.pass(500ms);
    EXPECT_EQ(module.position(), place) << "the move is over for good";
    bench.order_and_settle(fast(kPositionP2));
    EXPECT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 120'000);
}

TEST_P(MidiMotorTest, ATripWhoseCauseStaysComesBack) {
    module.connect_encoder(false);
    ASSERT_TRUE(bench.until([&] { return driver.error(); }, 200ms));
    bench.order(fast(kResetError));
    bench.pass(4s);
    EXPECT_TRUE(driver.error());
    EXPECT_EQ(driver.fault(), MidiFault::tripped);
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_EQ(bench.count(midi::RESET), 1U);
}

TEST_P(MidiMotorTest, AWarningIsNoError) {
    module.set_supply(86'000);
    bench.pass(200ms);
    EXPECT_FALSE(driver.error());
    EXPECT_NE(driver.drive_status() & midi::kOverVoltage, 0U);
}

TEST_P(MidiMotorTest, AnEndStopIsAnErrorAndTheWayBackIsFree) {
    ASSERT_TRUE(module.execute(midi::UPPER_STOP, 0, 20'000));
    ASSERT_TRUE(module.execute(midi::END_STOPS, 0, 8));
    go(49'152);
    ASSERT_TRUE(bench.until([&] { return driver.error(); }, 5s));
    EXPECT_EQ(driver.fault(), MidiFault::end_stop);
    EXPECT_FALSE(driver.in_position());
    EXPECT_EQ(read(registers::ERR_STAT) & 0x80U, 0x80U);
    bench.order_and_settle(fast(kResetError));
    EXPECT_FALSE(driver.error());
    EXPECT_EQ(bench.count(midi::RESET), 0U);
    go(0);
    EXPECT_TRUE(bench.arrives());
    EXPECT_FALSE(driver.error());
}

TEST_P(MidiMotorTest, AStopByAnotherMasterIsAnError) {
    set_profile();
    go(49'152);
    bench.pass(100ms);
    ASSERT_TRUE(module.execute(midi::EMERGENCY_STOP, 0, 0));
    ASSERT_TRUE(bench.until([&] { return driver.error(); }, 1s));
    EXPECT_EQ(driver.fault(), MidiFault::not_arrived);
    const std::size_t moves = bench.count(midi::GO_TO);
    bench.order_and_settle(fast(kPositionP2));
    EXPECT_EQ(bench.count(midi::GO_TO), moves) << "with an error the mode stays";
    bench.order(fast(kResetError));
    bench.order_and_settle(fast(kPositionP2));
    EXPECT_TRUE(bench.arrives());
}

TEST_P(MidiMotorTest, AHeldShaftIsNotInPositionAndNoError) {
    set_profile();
    module.hold_shaft(true);
    go(4'096);
    bench.pass(3s);
    EXPECT_FALSE(driver.in_position());
    EXPECT_FALSE(driver.error());
    module.hold_shaft(false);
    EXPECT_TRUE(bench.arrives(60s));
    module.turn_shaft(500);
    EXPECT_TRUE(bench.until([&] { return !driver.in_position(); }, 200ms));
    EXPECT_TRUE(bench.arrives(60s));
}

TEST_P(MidiMotorTest, ARampThatDoesNotExistIsAnErrorWhenItShows) {
    bench.order(word(registers::V_SOLL, 3'146));
    bench.order(word(registers::A_SOLL, 24));
    EXPECT_FALSE(driver.error()) << "nothing moves";
    go(4'096);
    EXPECT_TRUE(driver.error());
    EXPECT_EQ(driver.fault(), MidiFault::bad_value);
    EXPECT_EQ(driver.limitation(), registers::midi::Limitation::too_soft);
    EXPECT_EQ(bench.count(midi::GO_TO), 0U);
    bench.order(fast(kResetError));
    bench.order(word(registers::A_SOLL, 81));
    bench.order_and_settle(fast(kPositionP2));
    EXPECT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 10'000);
}

TEST_P(MidiMotorTest, AccessesAsAPersonsToolMakesThem) {
    go(4'096);
    ASSERT_TRUE(bench.arrives());
    EXPECT_EQ(read(registers::P_IST, true), 4'096U);
    EXPECT_EQ(read(registers::MODE_REG), 2U);
    EXPECT_EQ(read(registers::P_SOLL, true), 4'096U);
    EXPECT_EQ(read(registers::ERR_STAT), 0x10U) << "IN_POS";
    EXPECT_EQ(read(registers::V_SOLL), 210U) << "the module's own 100 rpm: 100663.3 / 480 = 209.7";
    EXPECT_EQ(read(99), 0U);
    ASSERT_TRUE(
        driver.begin_access({.is_write = true, .reg = registers::P_SOLL, .longword = true, .value = 8'192}));
    ASSERT_TRUE(bench.until([&] { return !is_open(driver.access_state()); }));
    EXPECT_EQ(driver.access_state(), AccessState::done);
    EXPECT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 20'000);
    ASSERT_TRUE(driver.begin_access({.is_write = true, .reg = registers::L1, .value = 256}));
    ASSERT_TRUE(bench.until([&] { return !is_open(driver.access_state()); }));
    EXPECT_EQ(driver.access_state(), AccessState::failed);
    EXPECT_FALSE(driver.error());
}

TEST_P(MidiMotorTest, LostInMidMove) {
    set_profile();
    go(49'152);
    bench.drive.cut(true);
    ASSERT_TRUE(bench.until([&] { return driver.link() == Link::down; }, 1s));
    EXPECT_TRUE(driver.error());
    EXPECT_EQ(driver.fault(), MidiFault::link_lost);
    EXPECT_TRUE(driver.orders_complete());
    bench.order(fast(kPositionP1));
    driver.stop();
    bench.pass(1s);
    bench.drive.cut(false);
    ASSERT_TRUE(bench.until([&] { return driver.link() == Link::unacknowledged; }, 1s));
    ASSERT_TRUE(bench.until([&] { return driver.orders_complete(); }, 1s));
    EXPECT_EQ(bench.drive.module().actions().back().number, midi::EMERGENCY_STOP);
    EXPECT_TRUE(driver.error());
    bench.pass(1s);
    EXPECT_TRUE(driver.error());
    bench.order_and_settle(fast(kResetError));
    EXPECT_FALSE(driver.error());
    EXPECT_EQ(driver.link(), Link::up);
    EXPECT_EQ(bench.count(midi::GO_TO), 1U);
    EXPECT_EQ(driver.counters().link_losses, 1U);
}

/// With ERROR the mode is 0, and nothing may turn that is not controlled any more.
TEST_P(MidiMotorTest, WhatStillTurnsWhenTheLinkIsBackIsStopped) {
    bench.order(word(registers::A_SOLL, 160));
    bench.order(word(registers::V1, 800));
    bench.order_and_settle(fast(kVelocityV1));
    ASSERT_TRUE(bench.arrives());
    bench.drive.cut(true);
    ASSERT_TRUE(bench.until([&] { return driver.link() == Link::down; }, 1s));
    bench.pass(1s);
    ASSERT_TRUE(module.moving());
    bench.drive.cut(false);
    EXPECT_TRUE(bench.until([&] { return !module.moving(); }, 3s));
    EXPECT_EQ(bench.count(midi::RUN), 1U);
    EXPECT_EQ(driver.fault(), MidiFault::link_lost);
    bench.pass(2s);
    const std::size_t stops = bench.count(midi::STOP);
    EXPECT_EQ(stops, 1U);
    bench.order_and_settle(fast(kResetError));
    EXPECT_FALSE(driver.error());
    EXPECT_FALSE(module.moving());
}

/// For a gateway that leaves the motor as it finds it.
TEST_P(MidiMotorTest, WhatTurnedBeforeTheStartIsLeftAlone) {
    ASSERT_TRUE(module.execute(midi::RUN, 0, 480));
    MidiMotor another(GetParam() == Way::can ? static_cast<MidiLink&>(bench.can_link) : bench.v24_link, {});
    for (int i = 0; i < 3'000; ++i) {
        bench.now += 1ms;
        bench.drive.service(bench.now);
        another.poll(bench.instant());
    }
    EXPECT_EQ(another.link(), Link::up);
    EXPECT_TRUE(module.moving());
    EXPECT_FALSE(another.error());
    EXPECT_EQ(bench.count(midi::STOP) + bench.count(midi::EMERGENCY_STOP), 0U);
}

TEST_P(MidiMotorTest, AModuleThatStartsAnewInMidMove) {
    set_profile();
    go(49'152);
    bench.pass(50ms);
    bench.drive.power(false);
    bench.pass(10ms);
    bench.drive.power(true);
    ASSERT_TRUE(bench.until([&] { return driver.error(); }, 3s));
    EXPECT_TRUE(bench.until([&] { return driver.link() == Link::unacknowledged; }, 4s));
    bench.pass(1s);
    EXPECT_EQ(bench.count(midi::GO_TO), 1U) << "nothing is delivered late";
    EXPECT_TRUE(driver.error());
}

TEST(MidiMotorCan, ABootInMidMoveIsNoticedAtOnce) {
    MidiBench bench(Way::can);
    bench.start();
    bench.order(longword(registers::P1, 49'152));
    bench.order_and_settle(fast(kPositionP1));
    bench.drive.can().receive({.id = 0x701, .length = 1});
    bench.driver.poll(bench.instant());
    EXPECT_TRUE(bench.driver.error());
    EXPECT_EQ(bench.driver.fault(), MidiFault::restarted);
    EXPECT_NE(bench.driver.link(), Link::up);
}

TEST(MidiMotorCan, OffTheBus) {
    MidiBench bench(Way::can);
    bench.start();
    bench.drive.can().set_state(ports::CanState::bus_off);
    ASSERT_TRUE(bench.until([&] { return bench.driver.link() == Link::down; }, 1s));
    EXPECT_EQ(bench.driver.fault(), MidiFault::link_lost);
    bench.pass(1s);
    EXPECT_NEAR(bench.drive.can().restarts(), 11, 2);
    bench.drive.can().set_state(ports::CanState::active);
    EXPECT_TRUE(bench.until([&] { return bench.driver.link() == Link::unacknowledged; }, 1s));
}

TEST(MidiMotorModels, Mac23) {
    MidiBench bench(Way::v24, midi::Model::mac23);
    bench.start();
    bench.order(longword(registers::P1, 40'960));
    bench.order(word(registers::V_SOLL, 3'146));
    bench.order(word(registers::A_SOLL, 81));
    bench.order_and_settle(fast(kPositionP1));
    EXPECT_TRUE(bench.arrives());
    EXPECT_EQ(bench.drive.module().position(), 20'000);
    EXPECT_EQ(bench.drive.module().memory().period, 160);
    EXPECT_EQ(bench.drive.module().memory().ramp, 16);  // 32212254.7 / (81 x 160^2) = 15.5
}

TEST(MidiFaults, EachHasItsOwnWordsWithoutAFullStop) {
    std::set<std::string_view> texts;
    for (unsigned number = 0; number <= static_cast<unsigned>(MidiFault::jumped); ++number) {
        const std::string_view text = text_of(static_cast<MidiFault>(number));
        ASSERT_FALSE(text.empty()) << number;
        EXPECT_FALSE(text.ends_with('.')) << text;
        EXPECT_TRUE(texts.insert(text).second) << text;
    }
    EXPECT_EQ(text_of(static_cast<MidiFault>(200)), "");
}

}  // namespace
}  // namespace nplc::motor
