#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "driver.h"
#include "run_command.h"
#include "sim/world.h"

/// The same course in nanoplc-sim and in the FMU: the same values, to the last bit.
namespace nplc::sim::fmu {
namespace {

namespace fs = std::filesystem;

struct Change {
    int milliseconds;
    Id input;
    double value;
};

/// Of pick_and_place: two cycles, the second with the guard opened on its way, a load in between.
const std::vector<Change> kCourse = {{200, Id::in0, 1},
                                     {250, Id::in0, 0},
                                     {600, Id::load_torque, 0.25},
                                     {900, Id::load_torque, 0},
                                     {2500, Id::in0, 1},
                                     {2550, Id::in0, 0},
                                     {2700, behind(Id::in0, 1), 1},
                                     {3300, behind(Id::in0, 1), 0},
                                     {4200, behind(Id::in0, 2), 1},
                                     {4300, behind(Id::in0, 2), 0},
                                     {5000, Id::in0, 1},
                                     {5050, Id::in0, 0},
                                     {5200, Id::load_torque, -0.5}};
constexpr int kEnd = 5600;  // ms

/// N.m in the units of `motor load`: 1023 are 1.57 N.m.
int load_units(double newton_metres) {
    return static_cast<int>(std::lround(newton_metres * 1023 / 1.57));
}

std::string as_scenario() {
    std::string text;
    for (const Change& change : kCourse) {
        std::ostringstream line;
        line << "at " << change.milliseconds << " ms ";
        if (change.input == Id::load_torque)
            line << "motor load " << load_units(change.value);
        else
            line << "IN" << static_cast<int>(change.input) - 1 << " := " << change.value;
        text += line.str() + "\n";
    }
    return text + "end at " + std::to_string(kEnd) + " ms\n";
}

void set_inputs(Fmu3& fmu, double from_ms, double to_ms) {
    for (const Change& change : kCourse) {
        if (change.milliseconds < from_ms || change.milliseconds >= to_ms) continue;
        const fmi3Status status = change.input == Id::load_torque ? fmu.set(change.input, change.value)
                                                                  : fmu.set(change.input, change.value != 0);
        ASSERT_EQ(status, fmi3OK) << fmu.last_message();
    }
}

struct Row {
    double ms;
    std::vector<int> values;  // step, timer, counter, outputs, inpos, error, p_ist, v_ist
};

std::vector<Row> trace_of_nanoplc_sim(const fs::path& folder) {
    const fs::path scenario = folder / "course.scn";
    std::ofstream(scenario) << as_scenario();
    RunOptions options;
    options.program = NPLC_EXAMPLES "/pick_and_place.seq";
    options.scenario = scenario.string();
    options.csv = (folder / "trace.csv").string();
    options.quiet = true;
    const std::sig_atomic_t interrupted = 0;
    EXPECT_EQ(run(options, interrupted), 0);
    std::ifstream file(*options.csv);
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(line, "time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist");
    std::vector<Row> rows;
    while (std::getline(file, line)) {
        std::vector<std::string> fields;
        std::istringstream stream(line);
        for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
        Row row{std::stod(fields.at(0)), {}};
        for (const std::size_t column : {1U, 2U, 3U, 5U, 6U, 7U, 9U, 10U})
            row.values.push_back(std::stoi(fields.at(column)));
        rows.push_back(row);
    }
    return rows;
}

std::vector<int> row_of(const Fmu3& fmu) {
    int outputs = 0;
    for (unsigned i = 0; i < kOutputs; ++i) outputs |= (fmu.truth(behind(Id::out0, i)) ? 1 : 0) << i;
    return {fmu.integer(Id::step), fmu.integer(Id::timer), fmu.integer(Id::counter), outputs,
            fmu.truth(Id::in_pos), fmu.truth(Id::error),   fmu.integer(Id::p_ist),   fmu.integer(Id::v_ist)};
}

TEST(FmuCourse, IsThatOfNanoplcSimsTrace) {
    const UnpackedFmu fmu(packed(options_of("pick_and_place.seq")));
    const std::vector<Row> rows = trace_of_nanoplc_sim(fmu.folder());
    ASSERT_GT(rows.size(), 1000U);
    Fmu3 one(fmu);
    one.start();
    std::size_t row = 0;
    for (int ms = 1; ms <= kEnd; ++ms) {
        set_inputs(one, ms - 1, ms);
        ASSERT_EQ(one.step(1e-3), fmi3OK) << one.last_message();
        while (row + 1 < rows.size() && rows[row + 1].ms <= ms) ++row;
        ASSERT_EQ(row_of(one), rows[row].values) << "at " << ms << " ms";
    }
    EXPECT_GT(one.real(Id::time), 5.59);
}

/// Everything that the FMU shows, of the World that nanoplc-sim runs.
std::map<std::string, double> seen(World& world) {
    const Snapshot snapshot = world.take_snapshot();
    const MacMotor& motor = world.mac();
    constexpr double kTurn = 2 * std::numbers::pi / 4096;
    std::map<std::string, double> all{{"position", motor.plant().position() * kTurn},
                                      {"velocity", motor.plant().velocity() * (15 / 1.92e-3) * kTurn},
                                      {"torque", snapshot.torque * 1.57 / 1023},
                                      {"P_IST", snapshot.p_ist},
                                      {"V_IST", snapshot.v_ist},
                                      {"ERR_STAT", motor.err_stat()},
                                      {"IN_POS", snapshot.in_position},
                                      {"ERROR", snapshot.error},
                                      {"MODE", motor.mode()},
                                      {"step", snapshot.step},
                                      {"timer", snapshot.timer},
                                      {"counter", snapshot.counter},
                                      {"running", snapshot.running},
                                      {"link_up", snapshot.link_up}};
    for (int i = 0; i < 4; ++i) all["OUT" + std::to_string(i)] = snapshot.outputs >> i & 1;
    return all;
}

WorldOptions as_run_has_them() {
    WorldOptions options;
    options.gateway.debounce = base::Microseconds(3000);
    return options;
}

void change(World& world, double from_ms, double to_ms) {
    for (const Change& change : kCourse) {
        if (change.milliseconds < from_ms || change.milliseconds >= to_ms) continue;
        if (change.input == Id::load_torque)
            world.act(action::LoadMotor{.torque = load_units(change.value)});
        else
            world.set_input(static_cast<unsigned>(change.input) - 1, change.value != 0);
    }
}

/// Steps that are multiples of 250 us, and some that are not, and a mixture of all: what happens in between
/// does not depend on where the communication points lie, only on when inputs change.
TEST(FmuCourse, IsTheSameForEveryStepSize) {
    const FmuOptions options = options_of("pick_and_place.seq");
    const UnpackedFmu fmu(packed(options));
    const auto variables = variables_of(options.setup);
    for (const double step_ms : {0.25, 2.0, 50.0, 0.7, 1.92}) {
        World world(*options.setup.table, as_run_has_them());
        Fmu3 one(fmu);
        one.start();
        for (double ms = 0; ms < 1000; ms += step_ms) {
            set_inputs(one, ms - step_ms, ms);
            change(world, ms - step_ms, ms);
            const Time end(std::llround((one.time() + step_ms / 1000) * 1e9));
            while (world.now() < end) world.step(end);
            ASSERT_EQ(one.step(step_ms / 1000), fmi3OK) << one.last_message();
            ASSERT_EQ(one.outputs(variables), seen(world)) << "at " << ms << " ms, steps of " << step_ms;
        }
        EXPECT_GT(std::abs(one.real(Id::position)), 1.0) << step_ms;
    }
}

TEST(FmuCourse, StartsAtAnyTime) {
    const FmuOptions options = options_of("pick_and_place.seq");
    const UnpackedFmu fmu(packed(options));
    const auto variables = variables_of(options.setup);
    Fmu3 early(fmu);
    Fmu3 late(fmu);
    early.start(0);
    late.start(1000);
    for (int ms = 0; ms < 400; ++ms) {
        set_inputs(early, ms, ms + 1);
        set_inputs(late, ms, ms + 1);
        ASSERT_EQ(early.step(1e-3), fmi3OK);
        ASSERT_EQ(late.step(1e-3), fmi3OK);
        ASSERT_EQ(early.outputs(variables), late.outputs(variables)) << ms;
    }
    EXPECT_NEAR(late.real(Id::time), 1000.4, 1e-6);
}

/// Several in one process, one after the other and in turns, do not see each other.
TEST(FmuCourse, OfSeveralInstancesIsThatOfEachAlone) {
    const FmuOptions options = options_of("pick_and_place.seq");
    const UnpackedFmu fmu(packed(options));
    const UnpackedFmu other_fmu(packed(options_of("", registers::Model::mac800)));
    const auto variables = variables_of(options.setup);
    std::vector<std::map<std::string, double>> alone;
    {
        Fmu3 one(fmu);
        one.start();
        for (int ms = 0; ms < 700; ++ms) {
            set_inputs(one, ms, ms + 1);
            ASSERT_EQ(one.step(1e-3), fmi3OK);
            alone.push_back(one.outputs(variables));
        }
    }
    Fmu3 one(fmu);
    Fmu3 idle(fmu);
    Fmu3 motor(other_fmu);
    one.start();
    idle.start();
    motor.start();
    ASSERT_EQ(motor.set(Id::mode_reg, 1), fmi3OK);
    for (std::size_t ms = 0; ms < alone.size(); ++ms) {
        set_inputs(one, static_cast<double>(ms), static_cast<double>(ms) + 1);
        ASSERT_EQ(idle.step(1e-3), fmi3OK);
        ASSERT_EQ(one.step(1e-3), fmi3OK);
        ASSERT_EQ(motor.step(1e-3), fmi3OK);
        ASSERT_EQ(one.outputs(variables), alone[ms]) << ms;
    }
    EXPECT_EQ(idle.integer(Id::p_ist), 0);
}

}  // namespace
}  // namespace nplc::sim::fmu
