// A stop for a MIDI drive when its answers or the commands to it are lost: sent blind until it is confirmed,
// which only an answer to the stop itself does, or the shaft read at rest since it was asked.

#include "midi_bench.h"
#include "scripted_line.h"

namespace nplc::motor {
namespace {

struct MidiBlindStop : testing::TestWithParam<Way> {
    MidiBench bench{GetParam()};
    MidiMotor& driver = bench.driver;
    sim::MidiModule& module = bench.drive.module();

    /// At constant speed.
    void run() {
        bench.start();
        bench.order(word(registers::V_SOLL, 1'000));
        bench.order_and_settle(word(registers::MODE_REG, 1));
        ASSERT_TRUE(bench.arrives());
        ASSERT_TRUE(module.moving());
    }
    void lose_link() {
        ASSERT_TRUE(bench.until([&] { return driver.link() == Link::down; }, 1s));
    }
    std::size_t blind_stops() const { return bench.count(midi::EMERGENCY_STOP); }
};

INSTANTIATE_TEST_SUITE_P(BothLines, MidiBlindStop, testing::Values(Way::v24, Way::can),
                         [](const auto& way) { return way.param == Way::can ? "Can" : "V24"; });

TEST_P(MidiBlindStop, StopsADriveThatHearsAndIsNotHeard) {
    run();
    bench.drive.cut(false, true);
    lose_link();
    ASSERT_TRUE(module.moving());
    driver.stop();
    EXPECT_TRUE(bench.until([&] { return !module.moving(); }, 300ms)) << "told blind";
    EXPECT_GT(blind_stops(), 0U);
    bench.pass(3s);
    EXPECT_FALSE(driver.stop_confirmed()) << "nobody has said so";
    bench.drive.cut(false, false);
    EXPECT_TRUE(bench.until([&] { return driver.stop_confirmed(); }, 700ms));
    EXPECT_TRUE(bench.until([&] { return driver.link() == Link::unacknowledged; }, 1s));
    const auto told = blind_stops();
    bench.pass(2s);
    EXPECT_EQ(blind_stops(), told) << "it was confirmed";
}

// 17h is lost with its answer, and the wire to the drive is whole again before the link counts as lost.
TEST_P(MidiBlindStop, ReachesADriveThatDidNotHearTheStopItself) {
    run();
    bench.drive.cut(true, true);
    driver.stop();
    bench.pass(20ms);
    bench.drive.cut(false, true);
    EXPECT_TRUE(bench.until([&] { return !module.moving(); }, 600ms));
    EXPECT_EQ(bench.count(midi::STOP), 0U);
    EXPECT_FALSE(driver.stop_confirmed());
}

TEST_P(MidiBlindStop, GoesOnUntilADriveThatDoesNotHearHasAnswered) {
    run();
    bench.drive.cut(true, false);
    driver.stop();
    bench.pass(3s);
    EXPECT_TRUE(module.moving());
    EXPECT_FALSE(driver.stop_confirmed());
    bench.drive.cut(false, false);
    EXPECT_TRUE(bench.until([&] { return driver.stop_confirmed(); }, 600ms));
    EXPECT_TRUE(bench.until([&] { return !module.moving(); }, 500ms));
}

TEST_P(MidiBlindStop, ComesAfterACutThatIsMended) {
    run();
    bench.drive.cut(true, true);
    lose_link();
    driver.stop();
    bench.pass(5s);
    EXPECT_TRUE(module.moving());
    EXPECT_FALSE(driver.stop_confirmed());
    bench.drive.cut(false, false);
    EXPECT_TRUE(bench.until([&] { return !module.moving(); }, 700ms));
    EXPECT_TRUE(bench.until([&] { return driver.stop_confirmed(); }, 20ms)) << "by its answer to 18h";
}

TEST_P(MidiBlindStop, IsSentEvery50msForASecondThenEvery500ms) {
    bench.start();
    bench.drive.cut(false, true);
    lose_link();
    bench.pass(250ms);
    driver.stop();
    bench.pass(4s);
    std::vector<sim::Time> times;
    for (const sim::MidiAction& action : module.actions())
        if (action.number == midi::EMERGENCY_STOP) times.push_back(action.at);
    ASSERT_GT(times.size(), 23U);
    for (std::size_t i = 1; i < times.size(); ++i) {
        const sim::Time expected = i <= 20 ? sim::Time(50ms) : sim::Time(500ms);
        EXPECT_LE(times[i] - times[i - 1], expected + 1ms) << i;
        EXPECT_GE(times[i] - times[i - 1], expected - 1ms) << i;
    }
}

TEST_P(MidiBlindStop, IsEndedByAnOperator) {
    run();
    bench.drive.cut(true, true);
    driver.stop();
    bench.pass(1s);
    ASSERT_FALSE(driver.stop_confirmed());
    driver.give_up_stop();
    bench.pass(200ms);
    bench.drive.cut(false, false);
    EXPECT_TRUE(bench.until([&] { return driver.link() == Link::unacknowledged; }, 1s));
    EXPECT_EQ(blind_stops(), 0U) << "nothing is told late";
}

TEST_P(MidiBlindStop, IsNotSentWhereNobodyAskedForAStop) {
    run();
    bench.drive.cut(false, true);
    lose_link();
    bench.pass(2s);
    EXPECT_EQ(blind_stops(), 0U);
    EXPECT_TRUE(module.moving());
}

// The answers to stops arrive after the next stop was sent, and after the first query that follows them.
TEST_P(MidiBlindStop, OfALateLineIsConfirmedAndTheLinkComesBack) {
    for (const auto late : {0ms, 20ms, 40ms, 45ms, 49ms, 55ms, 70ms}) {
        SCOPED_TRACE(late.count());
        MidiBench other(GetParam());
        other.start();
        other.drive.delay(late, 0ms);
        other.drive.cut(true, true);
        other.driver.stop();
        other.pass(700ms);
        EXPECT_FALSE(other.driver.stop_confirmed());
        other.drive.cut(false, false);
        EXPECT_TRUE(other.until([&] { return other.driver.stop_confirmed(); }, 1'700ms));
        EXPECT_TRUE(other.until([&] { return other.driver.link() == Link::unacknowledged; }, 2s));
        EXPECT_NE(other.driver.fault(), MidiFault::several);
    }
}

// A line that babbles is never silent: 18h does not wait for that.
TEST(MidiBabblingLine, CarriesAnEmergencyStopAtOnce) {
    for (const auto& [number, bytes] : {std::pair{midi::EMERGENCY_STOP, 21U}, std::pair{midi::STOP, 0U}}) {
        ScriptedLine line;
        MidiV24Link link{line, {}};
        base::Instant now{1s};
        const auto babble = [&] {
            line.received.push_back({0, true});
            now += base::Microseconds(1'000);
            static_cast<void>(link.poll(now));
        };
        for (int i = 0; i < 10; ++i) babble();
        link.begin({.number = number}, now);
        for (int i = 0; i < 10; ++i) babble();
        EXPECT_EQ(line.sent.size(), bytes);
    }
}

}  // namespace
}  // namespace nplc::motor
