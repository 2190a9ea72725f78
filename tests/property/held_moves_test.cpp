// A sequence that was held in mid-motion and goes on does the same steps and ends at the same places as one
// that was not held.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <random>
#include <sstream>

#include "program.h"
#include "protocol/mactalk.h"
#include "registers/gateway.h"
#include "sim/world.h"

namespace nplc::property {
namespace {

using namespace std::chrono_literals;
using registers::gateway::Command;
using sim::Time;

/// A MAC800 has longwords only.
sim::Program program_for(registers::Model motor) {
    std::stringstream text;
    text << std::ifstream(NPLC_HELD_MOVES).rdbuf();
    std::string program = text.str();
    if (motor == registers::Model::mac800) program.replace(program.find("MAC140"), 6, "MAC800");
    const std::string file = testing::TempDir() + "held_moves_" + std::to_string(::getpid()) + ".seq";
    std::ofstream(file) << program;
    sim::Program compiled = sim::load_program(file);
    std::remove(file.c_str());
    return compiled;
}

class Course {
  public:
    explicit Course(const sim::WorldOptions& options)
        : program_(program_for(options.motor)), world_(program_.table, options) {
        EXPECT_TRUE(world_.load_result().ok) << world_.why_not();
    }

    const std::string& last() const { return steps_.back(); }
    bool is_done() const { return last() == "Done" || last() == "Fault"; }
    const std::vector<std::string>& steps() const { return steps_; }
    /// In counts, where each step was left.
    const std::vector<std::int32_t>& places() const { return places_; }

    void pass(Time time) {
        for (const Time end = world_.now() + time; world_.now() < end;) {
            world_.step(std::min(end, world_.now() + 1ms));
            const std::string step = program_.names.step(world_.gateway().state().step);
            if (step == last()) continue;
            steps_.push_back(step);
            places_.push_back(world_.take_snapshot().p_ist);
        }
    }
    gateway::RunState state() const { return world_.gateway().run_state(); }
    void command(Command what) {
        world_.user_sends(protocol::mactalk::encode({.kind = protocol::mactalk::Kind::write,
                                                     .address = registers::gateway::kDefaultAddress,
                                                     .reg = registers::gateway::COMMAND,
                                                     .length = 4,
                                                     .value = static_cast<std::uint32_t>(what)})
                              .view());
        pass(20ms);
    }
    bool until(gateway::RunState wanted) {
        for (int i = 0; i < 3'000 && state() != wanted; ++i) pass(1ms);
        return state() == wanted;
    }

  private:
    sim::Program program_;
    sim::World world_;
    std::vector<std::string> steps_{""};
    std::vector<std::int32_t> places_;
};

const std::vector<std::string> kSteps{"", "POWER_UP", "Away", "Further", "Spin", "Back", "Done"};

void expect_done(const Course& run) {
    ASSERT_EQ(run.steps(), kSteps);
    constexpr int kWindow = 20;
    EXPECT_NEAR(run.places()[2], 20'000, kWindow);
    EXPECT_NEAR(run.places()[3], 25'000, 2 * kWindow) << "from where it was, P_IST and P7";
    EXPECT_NEAR(run.places()[5], 0, kWindow);
}

void hold_at_random(const sim::WorldOptions& options, std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const auto below = [&](int limit) { return std::uniform_int_distribution(0, limit - 1)(random); };
    Course run(options);
    for (int i = 0; i < 60 && !run.is_done(); ++i) {
        run.pass(std::chrono::milliseconds(below(400)));
        if (run.is_done()) break;
        run.command(Command::hold);
        if (!run.until(gateway::RunState::held)) continue;
        run.pass(std::chrono::milliseconds(below(600)));
        run.command(below(3) == 0 ? Command::step : Command::run);
        EXPECT_NE(run.state(), gateway::RunState::stopped);
    }
    if (run.state() == gateway::RunState::held) run.command(Command::run);
    for (int i = 0; i < 200 && !run.is_done(); ++i) {
        run.pass(100ms);
        if (run.state() == gateway::RunState::held) run.command(Command::run);
    }
    expect_done(run);
}

struct Motors : testing::TestWithParam<int> {
    static sim::WorldOptions options(int which) {
        sim::WorldOptions options;
        if (which == 1) options.motor = registers::Model::mac800;
        if (which == 2) options.drive = {.model = registers::find_drive("MAC34-1")};
        if (which == 3) options.drive = {.model = registers::find_drive("MAC34-1"), .can = true};
        return options;
    }
};
INSTANTIATE_TEST_SUITE_P(All, Motors, testing::Values(0, 1, 2, 3));

TEST_P(Motors, NobodyHoldsIt) {
    Course run(options(GetParam()));
    for (int i = 0; i < 200 && !run.is_done(); ++i) run.pass(100ms);
    expect_done(run);
}

TEST_P(Motors, HeldAndContinuedItEndsAtTheSamePlaces) {
    for (std::uint64_t seed = 1; seed <= NPLC_HELD_RUNS; ++seed) hold_at_random(options(GetParam()), seed);
}

}  // namespace
}  // namespace nplc::property
