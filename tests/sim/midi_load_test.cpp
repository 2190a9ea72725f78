// A pull on a shaft at rest: 003 §III (holding torque), §VII 02h (standby), 0Ch (torque), 19h and 1Ah
// (power); 000 §VI 27h (busy).

#include "midi_bench.h"

namespace nplc::sim {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::int32_t kWhole = 0x80;  ///< Imax
constexpr std::int32_t kSwing = 5;     ///< increments, 003 §VII 02h

struct BenchAtRest : MidiBench {
    BenchAtRest(std::int32_t torque, bool standby) {
        EXPECT_TRUE(order(midi::STOP_TORQUE, standby ? 1 : 0));
        EXPECT_TRUE(order(midi::TORQUE, torque));
        EXPECT_TRUE(order(midi::GO_TO, 100));
        run_out();
        pass(seconds{1});
        EXPECT_EQ((*this)->position(), 100);
    }
};

TEST(MidiLoad, BelowTheHoldingTorqueNothingMoves) {
    for (const std::int32_t torque : {kWhole, 0x40, 0x11}) {
        for (const bool standby : {false, true}) {
            for (const int direction : {1, -1}) {
                BenchAtRest bench(torque, standby);
                bench->set_load(direction * (standby ? torque / 2 : torque));
                bench.pass(seconds{10});
                EXPECT_EQ(bench->position(), 100);
                EXPECT_FALSE(bench->busy());
            }
        }
    }
}

TEST(MidiLoad, AboveItTheShaftIsDraggedTheWayItIsPulledAndBusyTells) {
    for (const std::int32_t torque : {kWhole, 0x40}) {
        for (const int direction : {1, -1}) {
            BenchAtRest bench(torque, false);
            bench->set_load(direction * (torque + 1));
            bench.pass(milliseconds{100});
            // 6 Nm / 128 / 2.7e-4 kg m^2 = 173.6 rad/s^2 = 276,310 inc/s^2; over 0.1 s 1382 increments.
            EXPECT_NEAR(direction * (bench->position() - 100), 1'382, 14);
            EXPECT_TRUE(bench->busy());
            EXPECT_TRUE(bench->leds().catching_up);
            EXPECT_EQ(bench.ask(midi::GET_MEASURES) & midi::kNotBusy, 0U);
            EXPECT_FALSE(bench.order(midi::GO_TO, 5)) << "it moves";
            // Without the pull it is led back, at 5 x 200 us an increment (000 §VI 0Eh).
            bench->set_load(0);
            bench.run_out();
            EXPECT_EQ(bench->position(), 100);
            EXPECT_FALSE(bench->busy());
        }
    }
}

TEST(MidiLoad, InStandbyHalfOfItHolds) {
    BenchAtRest bench(kWhole, true);
    bench->set_load(kWhole / 2 + 1);
    std::int32_t farthest = 0;
    for (int i = 0; i < 20'000; ++i) {
        bench.pass(std::chrono::microseconds{100});
        farthest = std::max(farthest, std::abs(bench->position() - 100));
    }
    EXPECT_GT(farthest, 0);
    EXPECT_LE(farthest, kSwing);
    // 003 §VII 02h: 18h ends the swinging. The loop ends with it (000 §VI 18h), and half the torque does not
    // hold.
    ASSERT_TRUE(bench.order(midi::EMERGENCY_STOP));
    bench->set_load(0);
    bench.pass(milliseconds{1});
    const std::int32_t from = bench->position();
    bench->set_load(kWhole / 2 + 1);
    bench.pass(milliseconds{100});
    EXPECT_NEAR(bench->position() - from, 1'382, 14);
    EXPECT_FALSE(bench->busy());
    ASSERT_TRUE(bench.order(midi::STOP_TORQUE, 0));
    bench.pass(milliseconds{1});
    const std::int32_t held = bench->position();
    bench.pass(seconds{1});
    EXPECT_EQ(bench->position(), held) << "the nominal torque holds";
}

TEST(MidiLoad, InStandbyAlmostTheWholeTorqueStillSwingsWithinTheManualsIncrements) {
    BenchAtRest bench(kWhole, true);
    bench->set_load(-(kWhole - 1));
    for (int i = 0; i < 20'000; ++i) {
        bench.pass(std::chrono::microseconds{100});
        EXPECT_LE(std::abs(bench->position() - 100), kSwing);
    }
}

TEST(MidiLoad, WithPowerOffNothingHolds) {
    BenchAtRest bench(kWhole, false);
    bench->set_load(1);
    bench.pass(seconds{1});
    EXPECT_EQ(bench->position(), 100);
    ASSERT_TRUE(bench.order(midi::POWER_OFF));
    bench.pass(milliseconds{100});
    EXPECT_NEAR(bench->position() - 100, 1'382, 14);
    ASSERT_TRUE(bench.order(midi::POWER_ON));
    bench.pass(milliseconds{1});
    const std::int32_t held = bench->position();
    bench.pass(seconds{1});
    EXPECT_EQ(bench->position(), held);
}

// 3537 rev/s^2 for the whole holding torque would be 212,000 rpm after a second; the virtual motors' limit is
// 31,250 rpm.
TEST(MidiLoad, AFreeShaftTurnsNoFasterThanTheVirtualMotorsDo) {
    for (const midi::Model model : {midi::Model::mac34_1, midi::Model::mac23}) {
        for (const int direction : {1, -1}) {
            MidiBench bench(model);
            const double per_second = 31'250 / 60.0 * midi::facts_of(model).increments_per_rev;
            bench->set_load(direction * kWhole);
            bench.pass(seconds{1});
            const std::int64_t after_1_s = bench->shaft();
            bench.pass(seconds{1});
            const std::int64_t after_2_s = bench->shaft();
            EXPECT_NEAR(static_cast<double>(direction * (after_2_s - after_1_s)), per_second, 2);
            bench->power_off();
            bench.pass(seconds{1});
            EXPECT_NEAR(static_cast<double>(direction * (bench->shaft() - after_2_s)), per_second, 2);
        }
    }
}

// 240 rpm are 40,000 increments a second (period 48000 / 240 = 200). R: friction is 5 of 1023 of the holding
// torque, which is 3537 rev/s^2 = 35.4e6 increments/s^2: 172,874 increments/s^2. It stands after 0.231 s,
// 40,000^2 / 2 / 172,874 = 4,628 increments farther.
TEST(MidiLoad, WithoutSupplyTheShaftRunsOutUncounted) {
    for (const int direction : {1, -1}) {
        MidiBench bench;
        ASSERT_TRUE(bench.order(midi::RUN, direction < 0 ? std::int32_t{midi::kTurnsLeft} : 0, 200));
        bench.pass(seconds{5});
        const std::int32_t position = bench->position();
        const std::int64_t shaft = bench->shaft();
        EXPECT_EQ(shaft, position);
        bench->power_off();
        bench.pass(milliseconds{200});
        EXPECT_NEAR(static_cast<double>(direction * (bench->shaft() - shaft)), 4'543,
                    30);  // 4628 - 172874 / 2 x 0.0314^2
        bench.pass(seconds{1});
        EXPECT_NEAR(static_cast<double>(direction * (bench->shaft() - shaft)), 4'628, 30);
        EXPECT_EQ(bench->position(), position);
        const std::int64_t rest = bench->shaft();
        bench->power_on();
        bench.pass(seconds{3});
        EXPECT_EQ(bench->position(), position) << "as it was stored";
        ASSERT_TRUE(bench.order(midi::GO_TO, position + 1000));
        bench.run_out();
        EXPECT_EQ(bench->shaft(), rest + 1000);
    }
}

TEST(MidiLoad, AnEndBelowHoldsItToo) {
    BenchAtRest bench(kWhole, false);
    bench->stop_shaft(false, 40);
    bench->set_load(-2 * kWhole);
    bench.pass(seconds{1});
    EXPECT_EQ(bench->position(), 40);
    EXPECT_EQ(bench->shaft(), 40);
}

TEST(MidiLoad, AMechanicalEndHoldsTheShaft) {
    MidiBench bench;
    bench->stop_shaft(true, 500);
    ASSERT_TRUE(bench.order(midi::GO_TO, 1000));
    bench.pass(seconds{2});
    EXPECT_EQ(bench->position(), 500);
    EXPECT_TRUE(bench->busy());
    bench->set_load(2 * kWhole);
    bench.pass(seconds{1});
    EXPECT_EQ(bench->position(), 500);
    bench->set_load(0);
    bench->stop_shaft(true, 0);  // it is beyond that
    bench.pass(seconds{1});
    EXPECT_EQ(bench->position(), 500);
    bench->free_shaft();
    bench.run_out();
    EXPECT_EQ(bench->position(), 1000);
}

// 003 §IV: an end-stop ends motion in its own direction only; the reference input sets 0 where it goes
// inactive, turning clockwise.
TEST(MidiLoad, SwitchesAtTheAxis) {
    MidiBench bench;
    ASSERT_TRUE(bench.order(midi::END_STOPS, 1));
    ASSERT_TRUE(bench.order(midi::REFERENCE, 1));
    bench->connect(Input::reference, false, 700);
    bench->connect(Input::upper_stop, true, 3000);
    EXPECT_TRUE(bench->input(Input::reference));
    ASSERT_TRUE(bench.order(midi::GO_TO, 20'000));
    bench.run_out();
    EXPECT_EQ(bench->shaft(), 3001);
    EXPECT_EQ(bench->position(), 3001 - 700);
    EXPECT_EQ(bench.ask(midi::GET_STATUS) & midi::kAtUpperInput, midi::kAtUpperInput);
    EXPECT_FALSE(bench->input(Input::reference));
    ASSERT_TRUE(bench.order(midi::GO_TO, 0));
    bench.run_out();
    EXPECT_EQ(bench->shaft(), 700);
}

TEST(MidiLoad, AShaftThatIsHeldByHandIsNotDragged) {
    BenchAtRest bench(kWhole, false);
    bench->hold_shaft(true);
    bench->set_load(2 * kWhole);
    bench.pass(seconds{1});
    EXPECT_EQ(bench->position(), 100);
}

}  // namespace
}  // namespace nplc::sim
