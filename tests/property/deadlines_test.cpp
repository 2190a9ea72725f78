// A firmware that is polled only when something arrives and when it asked to be does the same, at the same
// microsecond, as one that is polled every 250 us as well: no deadline is missing, and none is late.

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "input_file.h"
#include "port_traffic.h"
#include "program.h"
#include "random_tables.h"
#include "sim/scenario_runner.h"
#include "sim/sim_storage.h"
#include "sim/world.h"

namespace nplc::property {
namespace {

using namespace std::chrono_literals;
using sim::Polling;
using sim::Time;

/// Every line is one thing that happened, with its time.
class Diary final : public gateway::Observer {
  public:
    void ordered(base::Instant now, const sequencer::MotorOrder& order) override {
        at(now) << "order " << int{order.command} << ' ' << int{order.reg} << ' ' << order.value << '\n';
    }
    void scanned(base::Instant now, const sequencer::State& before, sequencer::InputImage image,
                 const sequencer::State& after) override {
        at(now) << "scan " << int{image} << ": " << words(before) << " -> " << words(after) << '\n';
    }
    /// What the world shows, if it has changed.
    void look(const sim::World& world) {
        const gateway::Gateway& gateway = world.gateway();
        std::ostringstream now;
        now << "out " << int{world.board().outputs()} << " run " << static_cast<int>(gateway.run_state())
            << " safe " << static_cast<int>(gateway.safe_reason()) << " link "
            << static_cast<int>(world.driver().link()) << " inpos " << world.driver().in_position() << " err "
            << world.driver().error() << " executed " << world.mac().orders().size() << " resent "
            << world.driver().counters().resent << " events " << gateway.log().count();
        if (now.str() == shown_) return;
        shown_ = now.str();
        text_ << world.now().count() << " ns " << shown_ << '\n';
    }
    std::string text() const { return text_.str(); }

  private:
    std::ostream& at(base::Instant now) { return text_ << now.time_since_epoch().count() << " us "; }
    static std::string words(const sequencer::State& state) {
        return std::to_string(state.step) + '/' + std::to_string(state.timer) + '/' +
               std::to_string(state.counter) + '/' + std::to_string(state.outputs);
    }

    std::ostringstream text_;
    std::string shown_;
};

struct Played {
    std::string diary;
    std::uint64_t polls = 0;
};

/// The diaries are long: only where they part.
void expect_same(const Played& at_need, const Played& beyond_need) {
    if (at_need.diary == beyond_need.diary) return;
    std::istringstream left(at_need.diary);
    std::istringstream right(beyond_need.diary);
    std::string one;
    std::string other;
    do {
        one = other = "(the end)";
        std::getline(left, one);
        std::getline(right, other);
    } while (one == other && left && right);
    ADD_FAILURE() << "at need:     " << one << "\nbeyond need: " << other;
}

Played play(const sim::Program& program, const sim::Scenario& scenario, sim::WorldOptions options) {
    Diary diary;
    options.motor = program.names.motor;
    options.observer = &diary;
    // A storage at work is looked at every millisecond, so when an operation ends is a matter of polls: here
    // each has ended at once.
    sim::SimStorage storage(sim::World::kFlash, 0);
    options.storage = &storage;
    sim::World world(program.content(), options);
    sim::ScenarioRunner runner(scenario, program.names, world);
    const auto show = [&] {
        while (runner.observe(world.take_snapshot())) {
        }
        diary.look(world);
    };
    show();
    constexpr Time kEnd = 120s;
    while (!runner.ended() && world.now() < kEnd) {
        world.step(std::min(runner.next_due().value_or(kEnd), kEnd));
        show();
    }
    runner.finish(world.take_snapshot());
    EXPECT_EQ(runner.failures(), 0U);
    EXPECT_EQ(world.board().bites(), 0U);
    return {diary.text(), world.polls()};
}

void play_both(const std::filesystem::path& source, sim::WorldOptions options) {
    SCOPED_TRACE(source.string());
    const sim::Program program = sim::load_program(source.string());
    const std::string file = std::filesystem::path(source).replace_extension(".scn").string();
    const auto parsed = sim::parse_scenario(sim::read_input(file, "a scenario"), file, program.names);
    ASSERT_TRUE(parsed.mistakes.empty());
    options.polling = Polling::at_need;
    const Played at_need = play(program, parsed.scenario, options);
    options.polling = Polling::beyond_need;
    expect_same(at_need, play(program, parsed.scenario, options));
    EXPECT_GT(at_need.diary.size(), 500U);
}

TEST(Deadlines, TheExamplesRunAsIfPolledAllTheTime) {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(NPLC_EXAMPLES)) {
        if (entry.path().extension() != ".seq") continue;
        ++count;
        play_both(entry.path(), {.faults = {}, .gateway = {}});
    }
    EXPECT_GE(count, 8);
}

/// A random sequence on a line that loses, damages and delays characters, is cut, and whose motor loses its
/// supply; inputs change, one of them the enable input of every third run; a lamp flashes in every second
/// one.
class Disturbed {
  public:
    Disturbed(std::uint64_t seed, Polling polling)
        : dice_(seed), world_(random_table(Shape::dense, dice_), options(seed, polling)) {}

    Played run() {
        for (int event = 0; event < 60; ++event) {
            disturb();
            const Time end = world_.now() + Time(1000 * (1 + dice_.below(80'000)));
            while (world_.now() < end) {
                world_.step(end);
                diary_.look(world_);
            }
        }
        EXPECT_EQ(world_.board().bites(), 0U);
        return {diary_.text(), world_.polls()};
    }

  private:
    sim::WorldOptions options(std::uint64_t seed, Polling polling) {
        constexpr std::uint32_t kBaud[]{9'600, 19'200, 115'200};
        sim::WorldOptions options{.baud = kBaud[seed % 3], .seed = seed, .faults = {}, .gateway = {}};
        if (seed % 2 == 0) options.gateway.status_output = 3;
        if (seed % 3 == 0) options.gateway.enable_input = 1;
        options.gateway.longest_wait = 40ms;
        options.polling = polling;
        options.observer = &diary_;
        return options;
    }

    void disturb() {
        switch (dice_.below(12)) {
            case 0:
                return world_.cut_line(true);
            case 1:
                return world_.cut_line(false);
            case 2:
                return world_.power_motor(false);
            case 3:
                world_.power_motor(true);
                return world_.cut_line(false);
            case 4:
                return spoil(0.05, 0.03, 0.02, 0.02);
            case 5:
                return spoil(0, 0, 0, 0);
            case 6:
                return world_.gateway(sim::action::Gateway::run);
            case 7:
                return dice_.one_in(4) ? world_.gateway(sim::action::Gateway::stop)
                                       : world_.gateway(sim::action::Gateway::run);
            default:
                return world_.toggle_input(dice_.below(3));
        }
    }

    void spoil(double drop, double damage, double framing, double delay) {
        world_.spoil_line(
            {.drop = drop, .damage = damage, .framing = framing, .delay = delay, .longest_delay = {}});
    }

    Dice dice_;
    Diary diary_;
    sim::World world_;
};

TEST(Deadlines, DisturbedRunsToo) {
    for (std::uint64_t seed = 1; seed <= NPLC_DEADLINE_RUNS; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const Played at_need = Disturbed(seed, Polling::at_need).run();
        expect_same(at_need, Disturbed(seed, Polling::beyond_need).run());
        if (testing::Test::HasFailure()) return;
    }
}

TEST(Deadlines, AndThoseOfABusyPort) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        PortTraffic at_need(seed, PortTraffic::Traffic::anything, Polling::at_need);
        at_need.run();
        PortTraffic beyond(seed, PortTraffic::Traffic::anything, Polling::beyond_need);
        beyond.run();
        EXPECT_EQ(at_need.trace(), beyond.trace());
        EXPECT_EQ(at_need.executed(), beyond.executed());
        // Not compared byte for byte: how much of an answer has left when the next message drops it depends
        // on how often a full port is looked at.
        EXPECT_GT(at_need.answered(), 1000U);
    }
}

/// A stopped gateway without a motor has nothing to do: in an hour only the watchdog (every second) wakes it.
TEST(Deadlines, IdleWithoutAStatusStreamSleeps) {
    sim::World world({}, {.faults = {}, .gateway = {}, .polling = Polling::at_need});
    world.power_motor(false);
    while (world.now() < 10s) world.step(10s);
    const std::uint64_t before = world.polls();
    while (world.now() < 3'610s) world.step(3'610s);
    EXPECT_EQ(world.polls() - before, 3'600U);
}

/// A running sequence that waits sleeps too, and the time it slept is no scan time.
TEST(Deadlines, WhatItSleepsIsNoScanTime) {
    const std::vector<std::uint8_t> waits_for_in0{0x00, 0x01, 0x01, 0x01, 0x00, 0x00, 0x00, 0x00,
                                                  0x3F, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00};
    sim::World world(waits_for_in0, {.faults = {}, .gateway = {}, .polling = Polling::at_need});
    while (world.now() < 1s) world.step(1s);
    ASSERT_EQ(world.gateway().run_state(), gateway::RunState::running);
    world.cut_line(true);
    while (world.now() < 60s) world.step(60s);
    world.set_input(0, true);
    while (world.now() < 61s) world.step(61s);
    EXPECT_EQ(world.gateway().safe_reason(), gateway::SafeReason::link_down);
    EXPECT_LT(world.gateway().worst_scan_time(), 10ms);
}

}  // namespace
}  // namespace nplc::property
