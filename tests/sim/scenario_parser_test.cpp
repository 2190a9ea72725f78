#include <gtest/gtest.h>

#include <algorithm>

#include "scenario_bench.h"

namespace nplc::sim {
namespace {

using namespace std::chrono_literals;

TEST(ScenarioParser, EverythingTheReadmeNamesIsTaken) {
    const ParsedScenario parsed = parse(R"scn(
        # comment
        Start := 0                       // at time 0
        at 100 ms IN0 := 1
        at 100ms Start := TRUE, after 50 ms Start := off, after 1 s log "done # not a comment"
        at 1 s pulse Start 50 ms
        at 1 s pulse Start for 50 ms
        toggle IN5
        every 500 ms pulse Start 50 ms
        every 500 ms from 1 s until 2 min toggle Guard
        when OUT0 rises after 300 ms IN2 := 1
        when step = Travel and not (Guard or IN4) IN2 := 1
        expect not step in working or step in Idle at 2 s
        expect step = Idle for pause at Pause
        once IN1 rises after Pause IN2 := 1 for pause
        once P_IST > 4096 counts IN2 := 1
        when P_IST = -1.5 rev +- 2 counts IN2 := 1
        when step changes log "step"
        when ordered "POSITION(P2)" after 10 ms IN3 := 1
        at 2 s line cut
        at 3 s line restored
        at 3 s line drop 1 % damage 0.5% framing 1 % delay 2 % up to 10 ms
        at 3 s line to motor drop 1 %
        at 3 s line from motor clean
        seed 7
        at 4 s motor error
        at 4 s motor power off, after 1 s motor power on
        at 4 s motor load -500
        motor brake 300, after 1 s motor brake 0
        at 4 s motor stop below -2 rev, after 1 s motor stop above 8192 counts spring 5000 per rev
        at 4 s motor stop none
        at 4 s motor sensor on below -1 rev
        motor analogue 0 V
        motor pulses 5000 per s
        motor steps -5000 per s
        at 4 s motor supply 20 V, after 1 s motor supply 48 V
        at 4 s motor logic 15.5 V, motor temperature 90, motor encoder broken
        never TORQUE > 300 or SHAFT < -3 rev
        at 5 s gateway stop, after 1 s gateway run, after 1 s gateway restart
        at 5 s gateway safe, gateway hold, gateway step, gateway scan
        at 5 s gateway break Idle and 2, after 1 s gateway break none
        at 5 s gateway force Start := 1 for 2 s, gateway force Lamp := 0, after 1 s gateway release Lamp
        at 5 s gateway release all
        expect at 3 s step = Idle
        at 3 s expect step = 1
        expect P_IST = 49152 +- 2 counts
        expect P_IST = 60 mm +- 0.1 mm
        expect V_IST = 125 mm/s +- 1 mm/s at 2 s
        expect V_IST < 25 rev / s and V_IST < 7500 mm/min and TORQUE < 30 %
        when Start rises and not Guard IN2 := 1
        when Start rises and (Guard or IN4) for 200 ms from 1 s until 2 s IN2 := 1 for 1 s, cancel Start
        once step = Travel for 3 s cancel all
        end when Lamp for 1 s
        when Grip falls cancel motor, cancel line, cancel gateway, cancel log, cancel end
        IN3 follows Grip after 300 ms back after 100 ms
        IN4 follows not Grip and step = Travel
        IN5 appears for 100 ms every 2 s from 1 s until 9 s
        IN5 appears for 100 ms 300 ms after Grip rises from 1 s
        IN5 disappears after Lamp rises
        IN5 appears at 3 s
        line cut for 200 ms
        expect Grip from 2 s until 5 s
        expect Grip for 200 ms at 3 s
        expect Grip for 200 ms by 5 s
        expect Grip for 200 ms within 1 s after Start rises from 1 s
        expect Grip for 200 ms after Start rises and Guard
        expect Grip for 200 ms 2 times from 1 s until 5 s
        at 3 s expect Grip for 20 ms
        motor stop above 110 mm spring 200 per mm
        expect V_IST = 1500 rpm +- 20 rpm at 2 s
        expect at end Lamp
        expect OUT1 = 1 within 200 ms after IN0 rises
        expect Grip 100 ms after Start rises
        expect eventually COUNTER = 16#0A by 5 s
        expect TIMER <= 500 ms by 5 s
        expect Grip rises 3 times
        expect Grip falls at least 2 times by 9 s
        expect ordered "RESET_ERROR" at most 1 times
        never OUT0 and OUT1
        always INPUTS <> 63 from 1 s until 2 s
        expect never ERROR
        once step = Idle 2 times after 5 ms Start := 1
        once Grip rises and Guard for 20 ms 3 times from 1 s Start := 1
        end when step = Idle after 1 s
        end when step = Idle 2 times from 1 s after 1 s
        end at 10 s
        motor HW_SETUP := XPRINP NOFILT
        motor FLWERRMAX := 0.5 rev
    )scn",
                                        "MAC800");
    for (const Mistake& found : parsed.mistakes) ADD_FAILURE() << found.line << ": " << found.message;
    EXPECT_EQ(parsed.scenario.expectations.size(), 28U);
    EXPECT_EQ(parsed.scenario.when.size(), 18U);
    EXPECT_EQ(parsed.scenario.every.size(), 3U);
    EXPECT_EQ(parsed.scenario.follow.size(), 2U);
    EXPECT_EQ(parsed.scenario.end, Time(10s));
    EXPECT_TRUE(parsed.scenario.can_end());
}

TEST(ScenarioParser, ForcesAndBreakpoints) {
    const auto actions = [](const std::string& text) {
        const ParsedScenario parsed = parse("at 1 s " + text);
        for (const Mistake& found : parsed.mistakes) ADD_FAILURE() << text << ": " << found.message;
        return parsed.scenario.at.at(0).actions;
    };
    const auto force = [](const Action& one) { return std::get<action::ForceSignals>(one.what); };
    const Actions input = actions("gateway force IN2 := 1 for 2 s");
    ASSERT_EQ(input.size(), 2U);
    EXPECT_FALSE(force(input[0]).outputs);
    EXPECT_EQ(force(input[0]).mask, 4);
    EXPECT_EQ(force(input[0]).levels, 4);
    EXPECT_EQ(input[1].after, Time(2s));
    EXPECT_TRUE(force(input[1]).releases);
    EXPECT_EQ(force(input[1]).mask, 4);
    const Actions output = actions("gateway force OUT1 := 0");
    EXPECT_TRUE(force(output[0]).outputs);
    EXPECT_EQ(force(output[0]).mask, 2);
    EXPECT_EQ(force(output[0]).levels, 0);
    EXPECT_EQ(actions("gateway release all").size(), 2U);
    const Actions where = actions("gateway break 1 and 62");
    EXPECT_EQ(std::get<action::Breakpoints>(where[0].what).steps, std::uint64_t{1} << 62 | 2U);
    EXPECT_EQ(std::get<action::Breakpoints>(actions("gateway break none")[0].what).steps, 0U);
    for (const char* text : {"gateway", "gateway pause", "gateway force Start", "gateway force IN7 := 1",
                             "gateway break", "gateway break 63", "gateway release"})
        EXPECT_FALSE(parse(std::string("at 1 s ") + text).mistakes.empty()) << text;
}

TEST(ScenarioParser, AForceOfAnInvertedInputGoesByTheName) {
    Names names;
    names.inputs[2] = "Estop";
    names.inverted_inputs = 0x04;
    const auto levels = [&names](const std::string& text) {
        const ParsedScenario parsed = parse_scenario("at 1 s gateway force " + text, "x.scn", names);
        for (const Mistake& found : parsed.mistakes) ADD_FAILURE() << text << ": " << found.message;
        const auto force = std::get<action::ForceSignals>(parsed.scenario.at.at(0).actions.at(0).what);
        EXPECT_EQ(force.mask, 4) << text;
        return force.levels;
    };
    EXPECT_EQ(levels("Estop := 1"), 0);
    EXPECT_EQ(levels("Estop := 0"), 4);
    EXPECT_EQ(levels("IN2 := 1"), 4);
    EXPECT_EQ(levels("IN2 := 0"), 0);
}

TEST(ScenarioParser, DelaysOfAListAddUp) {
    const auto parsed = parse("at 1 s Start := 1, after 50 ms Start := 0, after 10 ms toggle IN1");
    ASSERT_EQ(parsed.scenario.at.size(), 1U);
    const Actions& actions = parsed.scenario.at[0].actions;
    ASSERT_EQ(actions.size(), 3U);
    EXPECT_EQ(actions[0].after, Time(0));
    EXPECT_EQ(actions[1].after, Time(50ms));
    EXPECT_EQ(actions[2].after, Time(60ms));
}

TEST(ScenarioParser, UnitsBecomeCounts) {
    const auto parsed = parse("expect P_IST = 12 rev +- 0.5 rev\nexpect V_IST < 1500 rpm");
    ASSERT_EQ(parsed.scenario.expectations.size(), 2U);
    EXPECT_EQ(parsed.scenario.expectations[0].condition.operand, 49'152);
    EXPECT_EQ(parsed.scenario.expectations[0].condition.tolerance, 2048);
    // 1500 / 60 rev/s x 4096 counts / 520.8333 samples/s = 196.608
    EXPECT_NEAR(parsed.scenario.expectations[1].condition.operand, 196.608, 1e-9);
}

// 1 rev = 5 mm: 80 mm are 16 revolutions of 4096 counts, 0.1 mm 81.92 counts; 125 mm/s are 25 revolutions a
// second, 25 x 4096 / 520.8333 = 196.608 counts a sample, and so are 7500 mm/min. 30 % of 1023 are 306.9.
TEST(ScenarioParser, UnitsOfTheMachineBecomeCounts) {
    const auto condition = [](const std::string& text) {
        const ParsedScenario parsed = parse("expect " + text);
        EXPECT_TRUE(parsed.mistakes.empty()) << text;
        return parsed.scenario.expectations.at(0).condition;
    };
    EXPECT_EQ(condition("P_IST = 80 mm +- 0.1 mm").operand, 65'536);
    EXPECT_NEAR(condition("P_IST = 80 mm +- 0.1 mm").tolerance, 81.92, 1e-9);
    EXPECT_EQ(condition("SHAFT > -5 mm").operand, -4096);
    EXPECT_NEAR(condition("V_IST < 125 mm/s").operand, 196.608, 1e-9);
    EXPECT_NEAR(condition("V_IST < 7500 mm/min").operand, 196.608, 1e-9);
    EXPECT_NEAR(condition("V_IST < 25 rev/s").operand, 196.608, 1e-9);
    EXPECT_NEAR(condition("TORQUE < 30 %").operand, 306.9, 1e-9);
    const auto stop = parse("motor stop above 110 mm spring 200 per mm");  // 90112 counts; 819.2 counts a mm
    const auto& action = std::get<action::StopMotor>(stop.scenario.at.at(0).actions.at(0).what);
    EXPECT_EQ(action.counts, 90'112);
    EXPECT_NEAR(action.torque_per_count, 200 / 819.2, 1e-12);
}

TEST(ScenarioParser, WhatIsSeenHasTheUnitOfTheMachine) {
    Names names;
    names.machine = {"mm", 5};
    const ParsedScenario parsed =
        parse_scenario("expect P_IST = 80 mm +- 0.1 mm", "x.scn", names);  // 65536 counts, +- 81.92
    ASSERT_TRUE(parsed.mistakes.empty());
    const Condition& condition = parsed.scenario.expectations[0].condition;
    const auto at = [](std::int32_t counts) {
        Snapshot snapshot;
        snapshot.p_ist = counts;
        return snapshot;
    };
    EXPECT_TRUE(condition.holds(at(65'617), names));
    EXPECT_FALSE(condition.holds(at(65'618), names));
    EXPECT_EQ(condition.seen(at(65'618), names), "P_IST = 80.1001 mm");  // 82 x 5 / 4096 = 0.100098
}

TEST(ScenarioParser, ExpectationsKeepTheirText) {
    const auto parsed = parse("\n  expect at 3 s   step = Idle  # why\nnever Grip");
    EXPECT_EQ(parsed.scenario.expectations[0].text, "at 3 s   step = Idle");
    EXPECT_EQ(parsed.scenario.expectations[0].line, 2);
    EXPECT_EQ(parsed.scenario.expectations[1].text, "never Grip");
}

TEST(ScenarioParser, WhatIsBehindTheEndNeverHappens) {
    const Names names = program_names();
    EXPECT_EQ(all_mistakes("Guard := 1\nat 5 s Start := 0\nnever Grip\nend at 2 s", names),
              "2:1: this happens at 5 s, but the scenario ends at 2 s; move one of the two\n");
    EXPECT_EQ(all_mistakes("at 1 s Start := 1, after 3 s Start := 0\nend at 2 s", names),
              "1:1: this happens at 4 s, but the scenario ends at 2 s; move one of the two\n");
    EXPECT_EQ(all_mistakes("end at 2 s\nevery 3 s toggle IN0\nwhen Grip from 4 s Start := 1", names),
              "2:1: this happens at 3 s, but the scenario ends at 2 s; move one of the two\n"
              "3:1: this happens at 4 s, but the scenario ends at 2 s; move one of the two\n");
    EXPECT_EQ(all_mistakes("at 1 s Start := 1 for 5 s\nat 1 s pulse Guard 9 s\nat 2 s Guard := 1\n"
                           "IN2 appears for 3 s at 1 s\nend at 2 s",
                           names),
              "");
    EXPECT_EQ(all_mistakes("at 5 s Start := 0\nend when Grip", names), "");
}

TEST(ScenarioParser, OrdersAreThoseThatCanBe) {
    Names names = program_names();
    names.registers = {{"Long", "P3"}, {"Fast", "V1"}};
    const auto order = [&](const std::string& text) {
        const auto parsed = parse_scenario("never ordered \"" + text + "\"", "x.scn", names);
        EXPECT_TRUE(parsed.mistakes.empty()) << text << ": " << parsed.mistakes.front().message;
        return parsed.mistakes.empty() ? parsed.scenario.expectations[0].condition.parts[0].order : "";
    };
    EXPECT_EQ(order("POSITION(P3)"), "position(p3)");
    EXPECT_EQ(order("Position( long )"), "position(p3)");
    EXPECT_EQ(order("INIT(Fast)"), "init(v1)");
    EXPECT_EQ(order("Fast := -5"), "v1:=-5");
    EXPECT_EQ(order("Long := 40960"), "p3:=40960");
    EXPECT_EQ(order("V1 := 3146"), "v1:=3146");
    for (const char* word : {"STOP", "HOME", "RESET_ERROR", "USE_SET(4)", "NOP(17h)", "MODE_REG := 0"})
        order(word);
    const auto wrong = [&](const std::string& text) {
        return all_mistakes("never ordered \"" + text + "\"", names);
    };
    EXPECT_EQ(wrong("POSITON(P3)"),
              "1:15: \"POSITON(P3)\" can never be ordered; did you mean POSITION(P3)?\n");
    EXPECT_EQ(wrong("POSITION(P9)"),
              "1:15: \"POSITION(P9)\" can never be ordered; did you mean POSITION(P1)?\n");
    EXPECT_EQ(wrong("elephant"),
              "1:15: \"elephant\" can never be ordered; write an order as the timeline prints it, such as "
              "POSITION(P2), RESET_ERROR or V1 := 3146\n");
    EXPECT_EQ(wrong("INIT(V1, A1)"),
              "1:15: each register is an order of its own; write such as ordered \"INIT(V1)\"\n");
    EXPECT_EQ(wrong("V1 := 500 rpm"),
              "1:15: an order has the register's own steps, as the timeline prints it, such as ordered \"V1 "
              ":= 100\"\n");
    EXPECT_EQ(wrong("V1 := 70000"), "1:15: 70000 is no value of v1, so this is never ordered\n");
    EXPECT_EQ(wrong("Slow := 5"),
              "1:15: the motor has no register \"slow\", nor has the program a name for one\n");
}

// 90 mm are 73728 counts; 91 mm are 74547.2.
TEST(ScenarioParser, SetPointsAreComparedInTheirUnits) {
    const Names names = names_with_set_points();
    const auto holds = [&](const std::string& condition, std::array<std::int32_t, 3> values) {
        const auto parsed = parse_scenario("expect at end " + condition, "x.scn", names);
        EXPECT_TRUE(parsed.mistakes.empty()) << condition << ": " << parsed.mistakes.front().message;
        Snapshot snapshot;
        std::copy(values.begin(), values.end(), snapshot.set_points.begin());
        return !parsed.mistakes.empty() || parsed.scenario.expectations[0].condition.holds(snapshot, names);
    };
    const std::array<std::int32_t, 3> values{73'728, 800, 20};
    for (const char* condition :
         {"Length = 90 mm", "length = 90", "Length = 91 mm +- 1 mm", "Length = 91 +- 1", "Length <> 80 mm",
          "Length < 90.01 mm", "Length > 89.9 mm and Length >= 90 mm", "Dwell = 800 ms", "Dwell = 0.8 s",
          "Dwell = 0.8", "Dwell = 1 s +- 200 ms", "Pieces = 20", "Pieces > 19", "Pieces = 25 +- 5"})
        EXPECT_TRUE(holds(condition, values)) << condition;
    for (const char* condition : {"Length = 90.1 mm", "Length = 91.1 mm +- 1 mm", "Length <> 90 mm",
                                  "Length < 90 mm", "Dwell = 900 ms", "Pieces = 21"})
        EXPECT_FALSE(holds(condition, values)) << condition;
    EXPECT_TRUE(holds("Length = 91 mm +- 0 mm", {74'547, 800, 20})) << "rounded to the register's steps";
    const auto parsed = parse_scenario("expect at end Length = 80 mm and Dwell = 1 s", "x.scn", names);
    Snapshot snapshot;
    snapshot.set_points = {73'728, 800, 20};
    EXPECT_EQ(parsed.scenario.expectations[0].condition.seen(snapshot, names),
              "Length = 90 mm, Dwell = 0.8 s");
}

// 40 %peak are 409 of 1023.
TEST(ScenarioParser, AProgramsNameGoesBeforeAWordOfTheLanguage) {
    Names names = names_with_set_points();
    names.inputs = {"Line", "Motor", "Every", "Log", "Ordered", "Pulse"};
    for (const char* name : {"Torque", "Shaft", "Running"}) {
        set_points::SetPoint point = names.set_points.values[0];
        point.name = name;
        point.unit = "%peak";
        point.steps_per_unit = 10.23;
        point.step = 0;
        point.lowest = 1;
        point.highest = 1023;
        names.set_points.values.push_back(point);
    }
    Snapshot snapshot;
    snapshot.set_points = {73'728, 800, 20, 409, 409, 409};
    for (const char* name : {"Torque", "shaft", "RUNNING"}) {
        for (const char* rest : {" = 40 %peak", " = 41 %PEAK +- 2 %peak", " < 50", " <> 41 %peak"}) {
            const std::string condition = std::string(name) + rest;
            const auto parsed = parse_scenario("expect at end " + condition, "x.scn", names);
            ASSERT_TRUE(parsed.mistakes.empty()) << condition << ": " << parsed.mistakes.front().message;
            EXPECT_TRUE(parsed.scenario.expectations[0].condition.holds(snapshot, names)) << condition;
        }
    }
    EXPECT_EQ(all_mistakes("expect Torque = 40 %", names), "1:20: \"%\" is no unit of Torque; write %peak\n");
    EXPECT_EQ(all_mistakes("expect P_IST = 40 %", names),
              "1:19: \"%\" is no unit of P_IST; write counts, rev or mm\n");
    EXPECT_EQ(all_mistakes("Line := 1, Motor := 0, Pulse := 1\n"
                           "at 1 s Log := 1 for 1 s, pulse Pulse 50 ms\n"
                           "Every := 1\n"
                           "Motor follows Line after 5 ms\n"
                           "Every appears at 2 s\n"
                           "expect Ordered and not ordered \"POSITION(P2)\"\n"
                           "when Ordered rises toggle Line, line cut for 5 ms",
                           names),
              "");
}

TEST(ScenarioParser, StepNumbersAreThoseOfTheTable) {
    Names names = program_names();
    EXPECT_EQ(all_mistakes("never step = 40", names), "") << "the table is not known";
    names.numbers = 0b10111;
    EXPECT_EQ(all_mistakes("never step = 40", names), "1:14: the table has no step 40; it has 0..2, 4\n");
    EXPECT_EQ(all_mistakes("never step = 4 and step < 62", names),
              "1:27: the table has no step 62; it has 0..2, 4\n");
    EXPECT_EQ(all_mistakes("expect step = 2", names), "");
}

}  // namespace
}  // namespace nplc::sim
