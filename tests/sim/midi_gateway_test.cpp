// The whole gateway on the simulated board with a MIDI drive in the JVL motor's place: the same sequence, the
// same steps, the same places.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "program.h"
#include "sim/midi_virtual.h"
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
    return dynamic_cast<const MidiVirtual*>(world.drive())->drive().module().position() /
           (midi->model == Model::mac23 ? 2'000.0 : 10'000.0);
}

VirtualDriveOptions as_drive(const MidiDriveOptions& midi) {
    const registers::DriveFamily& family = *registers::find_drive("MAC23")->family;
    return {.model = &family.models()[static_cast<std::size_t>(midi.model)], .can = midi.can};
}

Ran run_scenario(const std::string& name, const std::string& text,
                 const std::optional<MidiDriveOptions>& midi) {
    const Program program = load_program(kExamples + "/" + name + ".seq");
    Names names = program.names;
    if (midi) names.drive = as_drive(*midi).model;
    const ParsedScenario parsed = parse_scenario(text, name, names);
    for (const Mistake& mistake : parsed.mistakes) ADD_FAILURE() << mistake.place() << " " << mistake.message;
    WorldOptions options;
    options.registers = parsed.scenario.registers;
    if (midi) options.drive = as_drive(*midi);
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
    for (const ExpectationResult& outcome : runner.outcomes()) {
        if (!outcome.passed) ran.failures.push_back(outcome.expectation + ": " + outcome.seen);
    }
    ran.end = last.p_ist;
    ran.discarded = world.driver().counters().discarded;
    return ran;
}

Ran run_example(const std::string& name, const std::optional<MidiDriveOptions>& midi) {
    std::ostringstream text;
    text << std::ifstream(kExamples + "/" + name + ".scn").rdbuf();
    return run_scenario(name, text.str(), midi);
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

/// 003 §VII 0Bh from another master, on the way to the place: the gripper must not open, and the reason is
/// reported.
TEST(MidiGateway, AnotherMastersOriginInMidMoveIsAFault) {
    for (const bool can : {false, true}) {
        const Program program = load_program(kExamples + "/midi_pick_and_place.seq");
        WorldOptions options;
        options.drive = as_drive({.can = can});
        World world(program.table, options);
        const auto until = [&](const std::string& step, auto holds) {
            const Time end = world.now() + 3s;
            while (world.now() < end &&
                   (program.names.step(world.gateway().state().step) != step || !holds()))
                world.step(world.now() + 1ms);
            return world.now() < end;
        };
        ASSERT_TRUE(until("Idle", [] { return true; }));
        world.set_input(0, true);
        MidiModule& module = dynamic_cast<MidiVirtual*>(world.drive())->drive().module();
        ASSERT_TRUE(until("Travel", [&] { return module.position() > 40'000; }));
        world.set_input(0, false);
        ASSERT_TRUE(module.execute(registers::midi::ZERO_POSITION, 0, 0));
        while (program.names.step(world.gateway().state().step) == "Travel" && world.now() < 10s)
            world.step(world.now() + 1ms);
        EXPECT_EQ(program.names.step(world.gateway().state().step), "Fault");
        ASSERT_TRUE(until("Fault", [&] { return !module.moving(); }));
        // Where it was zeroed, what passes until it is seen, and the stop: less than 4 of the 12 revolutions.
        EXPECT_LT(module.position(), 40'000);
        const gateway::EventLog& log = world.gateway().log();
        bool is_noted = false;
        for (std::size_t i = 0; i < log.count(); ++i) {
            const auto& entry = log.slot(i);
            is_noted = is_noted || (entry.event == static_cast<std::uint8_t>(gateway::Event::motor_fault) &&
                                    entry.detail == static_cast<std::uint16_t>(motor::MidiFault::jumped));
        }
        EXPECT_TRUE(is_noted);
    }
}

// 003 §VII 02h, 19h: 1023 is the whole holding torque; half of it, 64 of 128 steps, holds in standby.
TEST(MidiGateway, ALoadAboveTheHoldingTorqueMovesARestingShaft) {
    const std::string scenario = R"(
at 200 ms  pulse Start 50 ms
expect at 2400 ms step = Idle and P_IST = 0 +- 2 counts
at 2500 ms motor load 515
expect at 2900 ms P_IST = 0 +- 2 counts and not ERROR
at 3 s motor load 1100
expect at 3 s INPOS
expect P_IST > 1 rev 300 ms after P_IST > 20 counts
expect at 3500 ms not INPOS
end at 4 s
)";
    for (const bool can : {false, true}) {
        const Ran ran = run_scenario("midi_pick_and_place", scenario,
                                     MidiDriveOptions{.model = Model::mac34_1, .can = can});
        EXPECT_EQ(ran.failures, std::vector<std::string>{});
    }
}

// 003 §IV: a stop input that is active holds the axis where the driver has them enabled; the security input
// silences the module. 12 revolutions are the place.
TEST(MidiGateway, ItsInputsAndSupplyAreDriven) {
    const std::string scenario = R"(
motor stop above 11.9 rev
at 200 ms  pulse Start 50 ms
expect at 2 s SHAFT = 11.9 rev +- 2 counts and not INPOS
at 2 s motor stop none
expect P_IST = 12 rev +- 2 counts by 8 s
at 10 s motor security on for 500 ms
expect not LINK at 10.4 s
end at 14 s
)";
    for (const bool can : {false, true}) {
        const Ran ran = run_scenario("midi_pick_and_place", scenario,
                                     MidiDriveOptions{.model = Model::mac34_1, .can = can});
        EXPECT_EQ(ran.failures, std::vector<std::string>{});
    }
}

// 003 §IV, §VII 03h: an enabled end-stop input ends the motion, 6 of 12 revolutions out.
TEST(MidiGateway, AnEndStopEndsItsMotion) {
    const Ran ran = run_scenario("midi_pick_and_place", R"(
motor END_STOPS := 1
motor upper_stop on above 6 rev
at 200 ms pulse Start 50 ms
expect SHAFT = 6 rev +- 4 counts and V_IST = 0 and not INPOS at 2 s
end at 3 s
)",
                                 MidiDriveOptions{.model = Model::mac34_1});
    EXPECT_EQ(ran.failures, std::vector<std::string>{});
}

TEST(MidiGateway, ATableThatTheDriveCannotDoIsRefusedWithAReason) {
    WorldOptions options;
    options.drive = as_drive({});
    // Step 0: HOME (70h) at once; end.
    const std::vector<std::uint8_t> table{0xC0, 0x00, 0x00, 0x01, 0x70, 0x00, 0, 0,
                                          0x3F, 0,    0,    0,    0,    0,    0, 0};
    const World world(table, options);
    EXPECT_FALSE(world.load_result().ok);
    EXPECT_EQ(world.load_result().fault.error, base::Error::not_for_motor);
    EXPECT_EQ(world.why_not(), registers::midi::text_of(registers::midi::Limitation::homing));
}

}  // namespace
}  // namespace nplc::sim
