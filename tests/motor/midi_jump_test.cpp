// A position that the motion cannot explain: another master set the origin, or the shaft was taken elsewhere.

#include "midi_bench.h"

namespace nplc::motor {
namespace {

struct MidiJumpTest : testing::TestWithParam<Way> {
    MidiBench bench{GetParam()};
    MidiMotor& driver = bench.driver;
    sim::MidiModule& module = bench.drive.module();
    bool was_in_position = false;

    void SetUp() override {
        bench.start();
        // 1500 rpm: 250000 increments a second; 20000 rpm/s.
        for (const Order& order : {word(registers::V_SOLL, 3'146), word(registers::A_SOLL, 81)})
            bench.order_and_settle(order);
    }
    void go(std::int32_t counts) {
        bench.order(longword(registers::P1 + 2, counts));
        bench.order_and_settle(fast(kPositionP2));
    }
    void move(std::int32_t counts) {
        go(counts);
        ASSERT_TRUE(bench.arrives());
    }
    void foreign(std::uint8_t number, std::int32_t value = 0) {
        ASSERT_TRUE(module.execute(number, 0, static_cast<std::uint32_t>(value)));
    }
    void expect_fault(bool is_run = false) {
        bench.on_poll = [this, is_run] {
            was_in_position = was_in_position || (driver.in_position() && (!is_run || driver.error()));
        };
        EXPECT_TRUE(bench.until([&] { return driver.error(); }, 200ms));
        EXPECT_EQ(driver.fault(), MidiFault::jumped);
        EXPECT_FALSE(text_of(MidiFault::jumped).empty());
        // 25 rev/s and 333 rev/s^2: 0.94 revolutions until it stands, after 200 ms at the most.
        EXPECT_TRUE(bench.until([&] { return !module.moving(); }, 300ms)) << "the shaft goes on";
        bench.pass(1s);
        EXPECT_FALSE(was_in_position);
        const std::size_t moves = bench.count(midi::GO_TO);
        bench.order_and_settle(fast(kPositionP1));
        EXPECT_EQ(bench.count(midi::GO_TO), moves) << "with an error the mode stays";
        bench.order_and_settle(fast(kResetError));
        EXPECT_FALSE(driver.error());
        move(0);
    }
    void expect_none(sim::Time time = 2s) {
        bench.pass(time);
        EXPECT_EQ(driver.fault(), MidiFault::none);
    }
};

INSTANTIATE_TEST_SUITE_P(BothLines, MidiJumpTest, testing::Values(Way::v24, Way::can),
                         [](const auto& way) { return way.param == Way::can ? "Can" : "V24"; });

TEST_P(MidiJumpTest, AnotherMasterSetsTheOriginInMidMove) {
    go(49'152);
    ASSERT_TRUE(bench.until([&] { return module.position() > 40'000; }));
    foreign(midi::ZERO_POSITION);
    expect_fault();
}

TEST_P(MidiJumpTest, OnTheWayBackToo) {
    move(49'152);
    go(0);
    ASSERT_TRUE(bench.until([&] { return module.position() < 80'000; }));
    foreign(midi::ZERO_POSITION);
    expect_fault();
}

TEST_P(MidiJumpTest, SoonAfterTheStart) {
    go(49'152);
    // An eighth of a revolution, and what it travels in 60 ms, the longest between two positions on V24.
    ASSERT_TRUE(bench.until([&] { return module.position() > 1'250 + 15'000; }));
    foreign(midi::ZERO_POSITION);
    expect_fault();
}

TEST_P(MidiJumpTest, InARun) {
    bench.order_and_settle(word(registers::MODE_REG, 1));
    ASSERT_TRUE(bench.until([&] { return module.position() > 40'000; }));
    foreign(midi::ZERO_POSITION);
    expect_fault(true);
}

TEST_P(MidiJumpTest, TheSequencesOwnOriginIsNone) {
    for (const std::int32_t mode : {1, 2}) {
        bench.order_and_settle(longword(registers::P_SOLL, 49'152));
        bench.order_and_settle(word(registers::MODE_REG, mode));
        ASSERT_TRUE(bench.until([&] { return module.position() > 40'000; }));
        bench.order_and_settle(fast(0x63));
        expect_none();
        bench.order_and_settle(word(registers::MODE_REG, 0));
        expect_none();
    }
}

TEST_P(MidiJumpTest, TheReferenceInputIsNone) {
    foreign(midi::REFERENCE, 1);
    module.set_input(sim::MidiModule::Input::reference, true);
    go(49'152);
    ASSERT_TRUE(bench.until([&] { return module.position() > 60'000; }));
    module.set_input(sim::MidiModule::Input::reference, false);
    ASSERT_LT(module.position(), 10'000);
    EXPECT_TRUE(bench.arrives());
    EXPECT_EQ(module.position(), 120'000);
    expect_none();
}

TEST_P(MidiJumpTest, ADriverThatWasHeldUpSeesNone) {
    go(49'152);
    for (int i = 0; i < 20; ++i) {
        bench.pass(13ms);
        // The module answers; the driver is not served for 80 ms.
        bench.now += 80ms;
        bench.drive.service(bench.now);
    }
    EXPECT_TRUE(bench.arrives());
    expect_none();
}

TEST_P(MidiJumpTest, ChangesOfSpeedAreNone) {
    bench.order_and_settle(word(registers::MODE_REG, 1));
    for (const std::int32_t speed : {3'146, 200, 3'146, -3'146, 200, -200, 3'146, 0}) {
        bench.order_and_settle(word(registers::V_SOLL, speed));
        expect_none(300ms);
    }
}

/// It catches up with 200 us an increment for each unit, faster than it was ordered to move.
TEST_P(MidiJumpTest, CatchingUpIsNone) {
    bench.order_and_settle(word(registers::V_SOLL, 8));
    module.hold_shaft(true);
    go(2'048);
    bench.pass(5s);
    module.hold_shaft(false);
    expect_none(10s);
}

}  // namespace
}  // namespace nplc::motor
