// A line that brings the module's answers late, by a constant time and held back to come together, by up to
// 46 ms: the link is not lost, nothing is sent again, and each answer is that to its own question.

#include "midi_bench.h"

namespace nplc::motor {
namespace {

struct MidiLateLine : testing::TestWithParam<std::tuple<Way, int, int>> {
    MidiBench bench{std::get<0>(GetParam())};
    MidiMotor& driver = bench.driver;
    sim::MidiModule& module = bench.drive.module();

    void SetUp() override {
        bench.drive.delay(std::chrono::milliseconds(std::get<1>(GetParam())),
                          std::chrono::milliseconds(std::get<2>(GetParam())));
        bench.start();
    }
    void expect_untroubled() const {
        EXPECT_EQ(driver.link(), Link::up);
        EXPECT_EQ(driver.counters().link_losses, 0U);
        EXPECT_EQ(driver.counters().resent, 0U);
        EXPECT_FALSE(driver.error()) << text_of(driver.fault());
    }
};

INSTANTIATE_TEST_SUITE_P(BothLines, MidiLateLine,
                         testing::Combine(testing::Values(Way::v24, Way::can),
                                          testing::Values(0, 1, 8, 16, 24, 30),
                                          testing::Values(0, 4, 10, 16)),
                         [](const auto& one) {
                             return std::string(std::get<0>(one.param) == Way::can ? "Can" : "V24") +
                                    std::to_string(std::get<1>(one.param)) + "ms" +
                                    std::to_string(std::get<2>(one.param)) + "ms";
                         });

TEST_P(MidiLateLine, LosesNoLinkAndSendsNothingAgain) {
    bench.order(word(registers::V_SOLL, 3'000));
    for (const int place : {4'096, -4'096, 8'192}) {
        bench.order(longword(registers::P_SOLL, place));
        bench.order_and_settle(word(registers::MODE_REG, 2));
        EXPECT_FALSE(driver.in_position()) << "that of the move before";
        ASSERT_TRUE(bench.arrives());
        EXPECT_EQ(module.position(), place / 4'096 * 10'000);
    }
    EXPECT_EQ(bench.count(midi::GO_TO), 3U);
    expect_untroubled();
}

TEST_P(MidiLateLine, StopsOnceAndIsConfirmed) {
    bench.order(word(registers::V_SOLL, 1'000));
    bench.order_and_settle(word(registers::MODE_REG, 1));
    ASSERT_TRUE(bench.arrives());
    driver.stop();
    EXPECT_FALSE(driver.stop_confirmed());
    EXPECT_TRUE(bench.until([&] { return driver.stop_confirmed(); }, 200ms));
    EXPECT_EQ(bench.count(midi::STOP), 1U) << "confirmed by its answer, not before it was carried out";
    bench.pass(2s);
    EXPECT_FALSE(module.moving());
    EXPECT_EQ(bench.count(midi::STOP) + bench.count(midi::EMERGENCY_STOP), 1U);
    expect_untroubled();
}

// An answer to an earlier question would be older than one round: a position then lies further back than the
// shaft turns in that time.
TEST_P(MidiLateLine, NoAnswerIsThatToAnEarlierQuestion) {
    bench.order(word(registers::V_SOLL, 1'000));
    bench.order_and_settle(word(registers::MODE_REG, 1));
    ASSERT_TRUE(bench.arrives());
    const sim::Time late = std::chrono::milliseconds(std::get<1>(GetParam()) + std::get<2>(GetParam()));
    constexpr sim::Time kExchange = 17ms;  // 11 ms on V24, and the pause after it
    constexpr double kIncrementsPerMillisecond = 10'000 * 1'000 / 2.0972 / 60'000;
    for (int i = 0; i < 20; ++i) {
        ASSERT_TRUE(driver.begin_access({.reg = registers::P_IST, .longword = true}));
        ASSERT_TRUE(bench.until([&] { return driver.access_state() == AccessState::under_way; }, 1s));
        const sim::Time asked = bench.now;
        const double least = module.position();
        ASSERT_TRUE(bench.until([&] { return !is_open(driver.access_state()); }, 1s));
        ASSERT_EQ(driver.access_state(), AccessState::done);
        const double told =
            midi::increments_of_counts(midi::Model::mac34_1, static_cast<std::int32_t>(driver.access_value()))
                .value();
        EXPECT_GE(std::abs(told), std::abs(least) - 3) << "from before it was asked";
        EXPECT_LE(bench.now - asked, late + kExchange);
        EXPECT_LE(std::abs(module.position() - told),
                  ((late + kExchange) / 1.0ms) * kIncrementsPerMillisecond);
        driver.drop_access();
        bench.pass(7ms);
    }
    expect_untroubled();
}

}  // namespace
}  // namespace nplc::motor
