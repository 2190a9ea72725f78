// The whole gateway on the simulated board with a MIDI drive in the JVL motor's place: the same sequence, the
// same steps, the same places.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "program.h"
#include "sim/scenario.h"
#include "sim/scenario_runner.h"
#include "sim/world.h"

namespace nplc::sim {
namespace {

using namespace std::chrono_literals;
using registers::midi::Model;

const std::string kExamples = NPLC_EXAMPLES;

struct Ran {
    std::vector<std::uint8_t> steps;
    std::int32_t end = 0;
    struct Place {
        std::string step;
        double revolutions;  ///< of the shaft, at the step's end
    };
    std::vector<Place> places;
    std::vector<std::string> failures;
    std::uint32_t discarded = 0;
};

/// By the manuals' resolutions, not by the driver's conversion: 4096 counts, 2000 or 10000 increments.
double revolutions(const World& world, const Snapshot& snapshot,
                   const std::optional<MidiDriveOptions>& midi) {
    if (!midi) return snapshot.p_ist / 4'096.0;
    return world.midi()->drive().module().position() / (midi->model == Model::mac23 ? 2'000.0 : 10'000.0);
}

Ran run_example(const std::string& name, const std::optional<MidiDriveOptions>& midi) {
    const Program program = load_program(kExamples + "/" + name + ".seq");
    std::ostringstream text;
    text << std::ifstream(kExamples + "/" + name + ".scn").rdbuf();
    const ParsedScenario parsed = parse_scenario(text.str(), name, program.names);
    EXPECT_TRUE(parsed.mistakes.empty());
    WorldOptions options;
    options.midi = midi;
    World world(program.table, options);
    EXPECT_TRUE(world.load_result().ok);
    ScenarioRunner runner(parsed.scenario, program.names, world);
    Ran ran;
    Snapshot last;
    const auto show = [&] {
        do {
            last = world.take_snapshot();
            if (ran.steps.empty() || ran.steps.back() != last.step) {
                ran.steps.push_back(last.step);
                ran.places.push_back({program.names.step(last.step), 0});
            }
            ran.places.back().revolutions = revolutions(world, last, midi);
        } while (runner.observe(last));
    };
    show();
    while (!runner.ended() && world.now() < 30s) {
        Time stop = world.now() + 50ms;
        if (const auto due = runner.next_due()) stop = std::min(stop, *due);
        world.step(stop);
        show();
    }
    runner.finish(last);
    for (const Outcome& outcome : runner.outcomes()) {
        if (!outcome.passed) ran.failures.push_back(outcome.expectation + ": " + outcome.seen);
    }
    ran.end = last.p_ist;
    ran.discarded = world.driver().counters().discarded;
    return ran;
}

/// Where the shaft stands where it was sent: 60 mm are 12 revolutions. The other steps end in motion, or
/// where the guard door was opened.
void expect_settled(const Ran& ran) {
    constexpr double kTwoCounts = 2 / 4'096.0;
    int holds = 0;
    for (const auto& [step, revolutions] : ran.places) {
        if (step != "Hold") continue;
        ++holds;
        EXPECT_NEAR(revolutions, 12, kTwoCounts);
    }
    EXPECT_EQ(holds, 2);
    EXPECT_EQ(ran.places.back().step, "Idle");
    EXPECT_NEAR(ran.places.back().revolutions, 0, kTwoCounts);
}

TEST(MidiGateway, PickAndPlaceIsTheSameOnEveryDrive) {
    const Ran jvl = run_example("pick_and_place", std::nullopt);
    EXPECT_TRUE(jvl.failures.empty());
    expect_settled(jvl);
    for (const MidiDriveOptions& midi :
         {MidiDriveOptions{.model = Model::mac34_1}, MidiDriveOptions{.model = Model::mac34_2, .can = true},
          MidiDriveOptions{.model = Model::mac23}}) {
        SCOPED_TRACE(std::string(registers::midi::facts_of(midi.model).name) + (midi.can ? " CAN" : " V24"));
        const Ran other = run_example("pick_and_place", midi);
        EXPECT_EQ(other.steps, jvl.steps);
        EXPECT_NEAR(other.end, jvl.end, 2);  // of 4096 counts a revolution; it ends at 0
        EXPECT_EQ(other.discarded, 0U);
        expect_settled(other);
        for (const std::string& failure : other.failures) ADD_FAILURE() << failure;
    }
}

TEST(MidiGateway, ATableThatTheDriveCannotDoIsRefusedWithAReason) {
    WorldOptions options;
    options.midi = MidiDriveOptions{};
    // Step 0: HOME (70h) at once; end.
    const std::vector<std::uint8_t> table{0xC0, 0x00, 0x00, 0x01, 0x70, 0x00, 0, 0,
                                          0x3F, 0,    0,    0,    0,    0,    0, 0};
    const World world(table, options);
    EXPECT_FALSE(world.load_result().ok);
    EXPECT_EQ(world.load_result().fault.error, base::Error::not_for_motor);
    EXPECT_EQ(world.why_not(), registers::midi::text_of(registers::midi::Lack::homing));
}

}  // namespace
}  // namespace nplc::sim
