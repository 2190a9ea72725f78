// Random moves and runs on a disturbed line to a virtual module: what was ordered is executed once at most,
// in its turn, never after a stop or a loss that came between; and the link comes back.

#include <map>
#include <random>

#include "midi_bench.h"

namespace nplc::motor {
namespace {

constexpr int kRuns = 250;

class DisturbedRun {
  public:
    DisturbedRun(Way way, std::uint64_t seed) : bench_(way, midi::Model::mac34_1, seed), dice_(seed) {
        bench_.on_poll = [this] { watch(); };
    }

    void run() {
        bench_.start();
        for (int i = 0; i < 60; ++i) {
            disturb();
            act();
            bench_.pass(std::chrono::milliseconds(1 + dice_() % 150));
        }
        calm();
        bench_.pass(3s);  // a module may still be deaf
        EXPECT_TRUE(bench_.until([&] { return link_is_usable(bench_.driver.link()); }, 10s))
            << "the link has not come back";
        bench_.driver.send(fast(kResetError));
        EXPECT_TRUE(
            bench_.until([&] { return bench_.driver.orders_complete() && !bench_.driver.error(); }, 10s));
        bench_.driver.send(word(registers::MODE_REG, 0));
        bench_.driver.send(word(registers::V_SOLL, 3'000));
        order_move();
        EXPECT_TRUE(bench_.arrives(60s)) << "nor does it move";
    }

    void check() const {
        int last = 0;
        for (const sim::MidiAction& action : bench_.drive.module().actions()) {
            if (action.number != midi::GO_TO && action.number != midi::RUN) continue;
            const auto ordered = ordered_.find(action.data);
            ASSERT_NE(ordered, ordered_.end()) << "never ordered: " << action.data;
            EXPECT_GT(ordered->second, last) << "twice, or out of turn: " << action.data;
            last = ordered->second;
            const auto ended = ended_.find(action.data);
            if (ended == ended_.end()) continue;
            EXPECT_LE(action.at, ended->second + 30ms) << "late: " << action.data;
        }
    }
    std::size_t motions() const { return bench_.count(midi::GO_TO) + bench_.count(midi::RUN); }
    std::uint32_t resent() const { return bench_.driver.counters().resent; }

  private:
    /// A loss ends what was ordered before it.
    void watch() {
        const bool up = link_is_usable(bench_.driver.link());
        if (was_up_ && !up) end_all();
        was_up_ = up;
    }
    void end_all() {
        for (const auto& [data, number] : ordered_) ended_.try_emplace(data, bench_.now);
    }
    void begin(std::uint32_t data) {
        if (link_is_usable(bench_.driver.link())) ordered_[data] = number_;
    }

    /// Every motion has a number of its own: a place or a speed.
    void order_move() {
        ++number_;
        const int place = number_ % 2 != 0 ? 8 * number_ : -8 * number_;
        begin(static_cast<std::uint32_t>(*midi::increments_of_counts(midi::Model::mac34_1, place)));
        bench_.driver.send(longword(registers::P_SOLL, place));
        bench_.driver.send(word(registers::MODE_REG, 2));
    }
    void order_run() {
        const auto speed = static_cast<std::int16_t>(20 + ++number_);
        begin(*midi::period_of_v_soll(midi::Model::mac34_1, speed));
        bench_.driver.send(word(registers::V_SOLL, speed));
        bench_.driver.send(word(registers::MODE_REG, 1));
    }
    void act() {
        if (!bench_.driver.orders_complete()) return;
        switch (dice_() % 6) {
            case 0:
                end_all();
                return bench_.driver.stop();
            case 1:
            case 2:
                bench_.driver.send(fast(kResetError));
                bench_.driver.send(word(registers::MODE_REG, 0));
                bench_.driver.send(word(registers::V_SOLL, 3'000));
                return order_move();
            case 3:
                bench_.driver.send(fast(kResetError));
                return order_run();
            default:
                return;
        }
    }
    void disturb() {
        const auto all = [this](const sim::LineFaults& faults) {
            bench_.drive.line().to_motor().set_faults(faults);
            bench_.drive.line().from_motor().set_faults(faults);
            bench_.drive.can().lose(10 * faults.drop);
        };
        switch (dice_() % 24) {
            case 0:
                return bench_.drive.cut(true);
            case 1:
            case 2:
                return bench_.drive.cut(false);
            case 3:
                bench_.drive.power(false);
                return;
            case 4:
            case 5:
                return bench_.drive.power(true);
            case 6:
            case 10:
                return all({.drop = 0.01});
            case 7:
                return all({.damage = 0.01});
            case 8:
            case 11:
                return all({.framing = 0.01});
            case 9:
                return all({.delay = 0.02, .longest_delay = 20ms});
            case 12:
                return all({});
            default:
                return;
        }
    }
    void calm() {
        bench_.drive.cut(false);
        bench_.drive.power(true);
        bench_.drive.line().to_motor().set_faults({});
        bench_.drive.line().from_motor().set_faults({});
        bench_.drive.can().lose(0);
    }

    MidiBench bench_;
    std::mt19937_64 dice_;
    std::map<std::uint32_t, int> ordered_;  ///< and its number
    std::map<std::uint32_t, sim::Time> ended_;
    int number_ = 0;
    bool was_up_ = false;
};

void disturbed_runs(Way way) {
    std::size_t motions = 0;
    std::uint32_t resent = 0;
    for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        DisturbedRun run(way, seed);
        run.run();
        run.check();
        motions += run.motions();
        resent += run.resent();
        if (testing::Test::HasFailure()) return;
    }
    EXPECT_GT(motions, 600U);
    EXPECT_GT(resent, 100U);
}

TEST(MidiDisturbed, NothingTwiceAndNothingLateOverV24) {
    disturbed_runs(Way::v24);
}
TEST(MidiDisturbed, NothingTwiceAndNothingLateOverCan) {
    disturbed_runs(Way::can);
}

}  // namespace
}  // namespace nplc::motor
