#include <gtest/gtest.h>

#include <algorithm>

#include "scenario_bench.h"

namespace nplc::sim {
namespace {

using namespace std::chrono_literals;

/// The one mistake of a one-line scenario.
std::string mistake(const std::string& line, std::string_view motor = "MAC140") {
    const ParsedScenario parsed = parse(line, motor);
    return parsed.mistakes.size() == 1 ? parsed.mistakes.front().message : "(no mistake)";
}

TEST(Scenario, WhatMayHaveBeenMeantStandsInPlaceOfTheList) {
    Names names;
    names.inputs[0] = "Start";
    names.outputs[1] = "Grip";
    names.steps[2] = "Travel";
    names.times["Dwell"] = 100;
    const auto message = [&](const std::string& line) {
        const auto parsed = parse_scenario(line, "x.scn", names);
        return parsed.mistakes.size() == 1 ? parsed.mistakes.front().message : "(no mistake)";
    };
    EXPECT_EQ(message("att 10 ms Start := 1"), "\"att\" is not known here; did you mean at?");
    EXPECT_EQ(message("at 1 s pulze IN0 50 ms"), "\"pulze\" is not known here; did you mean pulse?");
    EXPECT_EQ(message("at 1 s Strat := 1"), "\"Strat\" is no input; did you mean Start?");
    EXPECT_EQ(message("when Grpi rises Start := 1"), "\"Grpi\" is not known; did you mean Grip?");
    EXPECT_EQ(message("expect step = Travle"), "the program has no step \"Travle\"; did you mean Travel?");
    EXPECT_EQ(message("at 1 s motor laod 5"), "\"laod\" is out of place; did you mean load?");
    EXPECT_EQ(message("motor P_SOL := 5"), "a MAC140 has no register P_SOL; did you mean P_SOLL?");
    EXPECT_NE(message("at 1 s elephant").find("; write at, every, when"), std::string::npos);
}

TEST(Scenario, OfAThousandMistakesTheFirstTwentyAreTold) {
    std::string text;
    for (int i = 0; i < 2000; ++i) text += "a=\n";
    const auto parsed = parse_scenario(text, "x.scn", Names{});
    EXPECT_EQ(parsed.mistakes.size(), 1000U);
    const std::string told = in_words("x.scn", parsed.mistakes);
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 20);
    EXPECT_TRUE(told.ends_with("x.scn: 980 or more mistakes")) << told;
    EXPECT_EQ(in_words("x.scn", {parsed.mistakes[0]}), "x.scn:1:1: " + parsed.mistakes[0].message);
}

/// `column: message` of the one mistake of a line.
std::string at_column(const std::string& line) {
    const ParsedScenario parsed = parse(line);
    if (parsed.mistakes.size() != 1) return "(no mistake)";
    return std::to_string(parsed.mistakes[0].column) + ": " + parsed.mistakes[0].message;
}

TEST(ScenarioParser, MistakesHaveColumns) {
    EXPECT_EQ(at_column("at 5 IN0 := 1"),
              "4: \"5 IN0\" is not a time; write a number with us, ms, s or min, such as 250 ms");
    EXPECT_EQ(at_column("  at 5 s Start := 2"), "19: \"2\" is out of place; write 0 or 1");
    EXPECT_EQ(at_column("expect Grip and Lamp ="), "23: the line ends too early; write 0 or 1");
    EXPECT_EQ(at_column("log \"\u00fcber\", foo := 1").substr(0, 3), "13:") << "characters, not bytes";
    EXPECT_EQ(at_column("motor load 99999"),
              "12: a load is a whole number -10000 to 10000, 1023 being the motor's full torque");
    EXPECT_EQ(at_column("expect Grip < 1"), "13: a signal is 0 or 1; compare it with = or <>");
    EXPECT_EQ(at_column("expect Grip ; Lamp"),
              "13: \";\" has no meaning here; remove it (comments begin with # or //)");
    EXPECT_EQ(at_column("expect at 100 ms P_IST = 0 mm +- 0,1 mm"),
              "34: a number has a decimal point; write 0.1");
    EXPECT_EQ(at_column("at 0,1 s Start := 1"), "4: a number has a decimal point; write 0.1");
    EXPECT_EQ(at_column("expect Grip & Lamp"), "13: \"&\" is not known here; write and");
    EXPECT_EQ(at_column("expect Grip || Lamp"), "13: \"|\" is not known here; write or");
    EXPECT_EQ(parse("at x").mistakes[0].place(), "1:4");
    EXPECT_EQ(parse("expect at 12 s Grip\nend at 10 s").mistakes[0].place(), "1:11");
}

TEST(ScenarioParser, MistakesInUnits) {
    EXPECT_EQ(at_column("expect P_IST = 80 rpm"),
              "19: \"rpm\" is no unit of P_IST; write counts, rev or mm (V_IST has rpm)");
    EXPECT_EQ(at_column("expect V_IST = 80 mm"),
              "19: \"mm\" is no unit of V_IST; write counts, rpm, rev/s, mm/s or mm/min (P_IST has mm)");
    EXPECT_EQ(at_column("expect V_IST = 80 cm/s"),
              "19: \"cm/s\" is no unit of V_IST; write counts, rpm, rev/s, mm/s or mm/min (80 cm/s are 800 "
              "mm/s)");
    EXPECT_EQ(at_column("expect P_IST = 80 mm/s"),
              "19: \"mm/s\" is no unit of P_IST; write counts, rev or mm (V_IST has mm/s)");
    EXPECT_EQ(at_column("expect P_IST = 80 mmm"), "19: \"mmm\" is no unit of P_IST; did you mean mm?");
    EXPECT_EQ(at_column("expect V_IST = 80 rmp"), "19: \"rmp\" is no unit of V_IST; did you mean rpm?");
    EXPECT_EQ(at_column("expect COUNTER = 5 pcs"), "20: COUNTER has no unit; write the number alone");
    EXPECT_EQ(at_column("expect TIMER = 5 mm"),
              "18: \"mm\" is no unit of TIMER; write ms or s (P_IST has mm)");
    EXPECT_EQ(at_column("expect TIMER = 5 mss"), "18: \"mss\" is no unit of TIMER; did you mean ms?");
    // Words of the language and names are no units, misspelt ones neither.
    for (const char* with :
         {"expect COUNTER = 5 at 3 s", "when COUNTER = 5 log \"x\"", "when COUNTER = 5 Start := 1",
          "when COUNTER = 5 rises pulse Start 50 ms", "expect COUNTER = 5 and Grip by 2 s"})
        EXPECT_TRUE(parse(with).mistakes.empty()) << with;
    EXPECT_EQ(at_column("expect COUNTER = 5 att 3 s"),
              "20: \"att\" is out of place; write one statement in a line, actions separated by commas");
    EXPECT_EQ(at_column("when COUNTER = 5 Strat := 1"), "18: \"Strat\" is no input; did you mean Start?");
    EXPECT_EQ(at_column("expect P_IST = 80 mm +- 0.1"),
              "25: the tolerance has no unit; write mm behind it, or counts, rev or mm");
    EXPECT_EQ(at_column("expect COUNTER = 5 mm"), "20: COUNTER has no unit; write the number alone");
    EXPECT_EQ(at_column("expect TORQUE = 5 Nm"), "19: \"Nm\" is no unit of TORQUE; write %");
    EXPECT_EQ(at_column("expect P_IST > 100"),
              "16: 100 of what? The program has a SCALE; write counts, rev or mm behind it");
    EXPECT_EQ(
        at_column("expect V_IST = -1.5 +- 1 and Grip"),
        "24: -1.5 of what? The program has a SCALE; write counts, rpm, rev/s, mm/s or mm/min behind it");
    for (const char* with : {"P_IST = 0", "V_IST > 0", "P_IST = 0 +- 1 mm", "P_IST = 5 +- 1 counts",
                             "COUNTER = 5", "TORQUE > 5"})
        EXPECT_TRUE(parse(std::string("expect ") + with).mistakes.empty()) << with;
    EXPECT_EQ(at_column("at 1 s motor load 500 for 200 ms"),
              "23: for takes back an input, a force, line cut, motor power off and a MIDI module's inputs "
              "only; write what "
              "follows, such as motor load 500, after 200 ms motor load 0");
    EXPECT_EQ(at_column("motor stop above 5"),
              "18: 5 of what? The program has a SCALE; write counts, rev or mm behind it");
    EXPECT_EQ(at_column("motor sensor on below -2.5"),
              "24: -2.5 of what? The program has a SCALE; write counts, rev or mm behind it");
    EXPECT_TRUE(parse("motor stop above 0, motor stop below -1 rev").mistakes.empty());
    EXPECT_TRUE(parse_scenario("motor stop above 500", "x.scn", Names{}).mistakes.empty());
    EXPECT_TRUE(parse_scenario("expect P_IST > 100", "x.scn", Names{}).mistakes.empty());
    const auto scaleless = parse_scenario("motor stop above 80 mm", "x.scn", Names{});
    ASSERT_EQ(scaleless.mistakes.size(), 1U);
    EXPECT_EQ(scaleless.mistakes[0].message,
              "\"mm\" is no unit of SHAFT; write counts or rev; SCALE 1 rev = 5 mm; in the program adds mm");
    EXPECT_EQ(at_column("motor stop above 3 rev spring 20 per cm"),
              "38: \"cm\" is out of place; write per rev or per mm");
}

TEST(ScenarioParser, MistakesInTimesAndThePlant) {
    EXPECT_EQ(at_column("when Grip from 5 s until 2 s IN2 := 1"),
              "26: this ends at 2 s, before it begins at 5 s; write the earlier time first");
    EXPECT_EQ(at_column("when Grip for 0 s IN2 := 1"),
              "15: what lasts takes longer than 0; write such as for 200 ms");
    EXPECT_EQ(at_column("when step changes for 1 s IN2 := 1"),
              "25: a change or an order is a moment and does not last; remove for and its time");
    EXPECT_EQ(at_column("expect Grip for 1 s from 2 s"),
              "21: this has for and from or until; write one of them, or by and a time");
    EXPECT_EQ(at_column("when Grip cancel Lamp"),
              "18: Lamp is an output: the sequence sets it, a scenario can only watch it; name an input");
    EXPECT_EQ(
        at_column("when Grip cancel"),
        "17: the line ends too early; write an input, motor, line, gateway, log, end or all after cancel");
    EXPECT_EQ(at_column("Grip follows Start"),
              "1: Grip is an output: the sequence sets it, a scenario can only watch it; name an input");
    EXPECT_EQ(at_column("IN3 follows Grip back 100 ms"),
              "23: \"100\" is out of place; write back after and a time, such as back after 100 ms");
    EXPECT_EQ(at_column("IN3 follows Grip\nIN3 follows Lamp"),
              "13: this input follows something already; put both into one condition with and, or");
    EXPECT_EQ(at_column("IN3 appears"),
              "12: the line ends too early; write every 2 s, at 2 s, or 300 ms after and what happens");
    EXPECT_EQ(at_column("IN3 appears every 0 s"),
              "19: a period must be longer than 0; write such as IN2 appears every 2 s");
}

TEST(ScenarioParser, MistakesAboutSetPointsSayWhatToWrite) {
    const Names names = names_with_set_points();
    const auto wrong = [&](const std::string& text) { return all_mistakes(text, names); };
    EXPECT_EQ(wrong("expect Lenght = 90 mm"), "1:8: \"Lenght\" is not known; did you mean Length?\n");
    EXPECT_EQ(wrong("expect Length = 90 cm"),
              "1:20: \"cm\" is no unit of Length; write mm (90 cm are 900 mm)\n");
    EXPECT_EQ(wrong("expect Length = 90 rpm"),
              "1:20: \"rpm\" is no unit of Length; write mm (V_IST has rpm)\n");
    EXPECT_EQ(wrong("expect Length = 90 mmm"), "1:20: \"mmm\" is no unit of Length; did you mean mm?\n");
    EXPECT_EQ(wrong("expect Length = 90 mm/s"),
              "1:20: \"mm/s\" is no unit of Length; write mm (V_IST has mm/s)\n");
    EXPECT_EQ(wrong("expect Length = 90 mm +- 1 ms"),
              "1:28: \"ms\" is no unit of Length; write mm (Dwell has ms)\n");
    EXPECT_EQ(wrong("expect Pieces = 3 pcs"), "1:19: Pieces has no unit; write the number alone\n");
    EXPECT_EQ(wrong("expect Dwell = 2 min"),
              "1:18: \"min\" is no unit of Dwell; write ms or s (2 min are 120000 ms)\n");
    EXPECT_EQ(wrong("expect P_IST = 2 ms"),
              "1:18: \"ms\" is no unit of P_IST; write counts, rev or mm (Dwell has ms)\n");
    EXPECT_EQ(wrong("expect Pieces = 3 mm"), "1:19: Pieces has no unit; write the number alone\n");
    EXPECT_EQ(wrong("expect Dwell = 2 mm"),
              "1:18: \"mm\" is no unit of Dwell; write ms or s (Length has mm)\n");
    EXPECT_EQ(wrong("expect Length = 300 mm"),
              "1:17: 300 mm is out of range; Length takes 10 mm to 200 mm in steps of 0.1 mm\n");
    EXPECT_EQ(wrong("expect Length = 90.05 mm"),
              "1:17: 90.05 mm is between two steps, 90 or 90.1; Length takes 10 mm to 200 mm in steps of 0.1 "
              "mm\n");
    EXPECT_EQ(wrong("expect Length > 90 mm +- 1 mm"), "1:23: a tolerance (+-) goes with = only\n");
    EXPECT_EQ(wrong("expect Length"),
              "1:14: the line ends too early; write a comparison, such as Length = 0\n");
    EXPECT_EQ(wrong("at 1 s Length := 90 mm"),
              "1:8: Length is a set-point; write set Length := and its value\n");
    EXPECT_EQ(wrong("at 1 s recipe save \"Long \""),
              "1:20: 'Long ': a recipe's name neither begins nor ends with a blank\n");
}

TEST(ScenarioParser, WhatNeverChangesIsAMistake) {
    const Names names = program_names();
    EXPECT_EQ(all_mistakes("Start follows Start", names),
              "1:15: an input that follows itself never changes; name what it follows, such as OUT0\n");
    EXPECT_EQ(all_mistakes("Start follows not Start after 1 s", names), "") << "a clock";
    EXPECT_EQ(all_mistakes("Start appears for 2 s every 1 s", names),
              "1:1: it lasts 2 s and comes again every 1 s; make it shorter than that\n");
    EXPECT_EQ(all_mistakes("every 1 s Guard := 1, Start := 1 for 1 s", names),
              "1:1: it lasts 1 s and comes again every 1 s; make it shorter than that\n");
    EXPECT_EQ(all_mistakes("Start appears for 500 ms every 1 s\nevery 1 s pulse Guard 999 ms", names), "");
}

TEST(ScenarioParser, MistakesSayWhatIsWrongAndWhatToWrite) {
    EXPECT_EQ(mistake("at 5 IN0 := 1"),
              "\"5 IN0\" is not a time; write a number with us, ms, s or min, such as 250 ms");
    EXPECT_EQ(mistake("at 5 s Clamp := 1"), "\"Clamp\" is no input; write one of Start, Guard, IN0..IN5");
    EXPECT_EQ(mistake("at 5 s Grip := 1"),
              "Grip is an output: the sequence sets it, a scenario can only watch it; name an input");
    EXPECT_EQ(mistake("at 5 s Start := 2"), "\"2\" is out of place; write 0 or 1");
    EXPECT_EQ(mistake("at 5 s Start = 1"), "\"=\" is out of place; write := and the level, such as IN0 := 1");
    EXPECT_EQ(mistake("expect step in Hold"), "the program has no GROUP \"Hold\"; write one of Working");
    EXPECT_EQ(mistake("expect step in 5"), "\"5\" is out of place; write a group's name");
    EXPECT_EQ(mistake("expect step = Working"), "Working is a group of steps; write step in Working");
    EXPECT_EQ(mistake("expect step = Hold"),
              "the program has no step \"Hold\"; write one of POWER_UP, Idle, Travel");
    EXPECT_EQ(mistake("expect step = 63"), "a step is a whole number 0 to 62");
    EXPECT_EQ(mistake("expect P_IST"), "the line ends too early; write a comparison, such as P_IST = 0");
    EXPECT_EQ(mistake("expect Grip == 1"), "\"==\" is not known here; write = to compare");
    EXPECT_EQ(mistake("expect Grip < 1"), "a signal is 0 or 1; compare it with = or <>");
    EXPECT_EQ(mistake("line drop 1"), "the line ends too early; write a share with its sign, such as 1 %");
    EXPECT_EQ(mistake("line drop 101 %"), "a share is 0 % to 100 %");
    EXPECT_EQ(mistake("expect (Grip and Lamp"), "the line ends too early; write ) to close the parenthesis");
    EXPECT_EQ(mistake("log \"open"), "the text is not closed; end it with \"");
    EXPECT_EQ(mistake("every 0 s toggle IN0"),
              "a period must be longer than 0; write such as every 500 ms pulse IN0 50 ms");
    EXPECT_EQ(mistake("expect P_IST > 5 +- 1"), "a tolerance (+-) goes with = only");
    EXPECT_EQ(mistake("motor power"), "the line ends too early; write motor power off, or motor power on");
    EXPECT_EQ(
        mistake("motor elephant none"),
        "\"elephant\" is out of place; write motor error, motor load, motor brake, motor power, motor stop, "
        "motor sensor, motor analogue, motor pulses, motor steps, motor supply, motor logic, motor "
        "temperature, motor encoder, motor upper_stop, motor lower_stop, motor reference or motor security");
    EXPECT_EQ(mistake("motor supply 20"),
              "the line ends too early; write its unit, such as motor supply 20 V");
    EXPECT_EQ(mistake("motor supply -1 V"), "a supply is 0 V to 600 V");
    EXPECT_EQ(mistake("motor logic 601 V", "MAC800"), "a supply is 0 V to 600 V");
    EXPECT_EQ(mistake("motor temperature 0.5", "MAC800"),
              "a temperature is a whole number -40 to 200, in degrees Celsius");
    EXPECT_EQ(mistake("motor encoder", "MAC800"), "the line ends too early; write motor encoder broken");
    EXPECT_EQ(mistake("motor steps 5 per min", "MAC800"),
              "\"min\" is out of place; write per s, such as motor steps 5000 per s");
    EXPECT_EQ(
        mistake("motor stop -2 rev"),
        "\"-\" is out of place; write above or below and a place, such as motor stop below -2 rev, or motor "
        "stop none");
    EXPECT_EQ(mistake("motor stop below"),
              "the line ends too early; write a place, such as -2 rev or 500 counts");
    EXPECT_EQ(mistake("motor stop below 1e rev"), "\"e\" is no unit of SHAFT; write counts, rev or mm");
    EXPECT_EQ(mistake("motor stop above 300000 rev"),
              "a place is at most 1000000000 counts away; write a nearer one");
    EXPECT_EQ(mistake("motor stop above 3 rev spring 20"),
              "the line ends too early; write per rev, such as spring 2000 per rev");
    EXPECT_EQ(mistake("motor stop above 3 rev spring 20 per"),
              "the line ends too early; write per rev or per mm");
    EXPECT_EQ(mistake("motor stop above 3 rev spring 0 per rev"),
              "a spring is 1 to 1000000 per rev, 1023 being the motor's full torque");
    EXPECT_EQ(mistake("motor sensor below 3 rev"),
              "\"below\" is out of place; write motor sensor on below -1 rev, or motor sensor off above 500 "
              "counts");
    EXPECT_EQ(mistake("motor analogue 12 V"), "the analogue input takes -10 V to 10 V");
    EXPECT_EQ(mistake("motor analogue 5"),
              "the line ends too early; write its unit, such as motor analogue 7.5 V");
    EXPECT_EQ(mistake("motor pulses 5000", "MAC800"),
              "the line ends too early; write per s, such as motor pulses 5000 per s");
    EXPECT_EQ(mistake("motor pulses 0.5 per s", "MAC800"),
              "pulses are a whole number -1000000 to 1000000 per s");
    EXPECT_EQ(mistake("motor load 99999999999"),
              "a load is a whole number -10000 to 10000, 1023 being the motor's full torque");
    EXPECT_EQ(mistake("motor brake", "MAC800"),
              "the line ends too early; write a torque, such as motor brake 300");
    EXPECT_EQ(mistake("motor brake -300", "MAC800"),
              "a brake is a whole number 0 to 10000, 1023 being the motor's full torque");
    EXPECT_EQ(mistake("at 1 s IN0 := 1 IN1 := 1"),
              "\"IN1\" is out of place; write one statement in a line, actions separated by commas");
    EXPECT_EQ(mistake("at 1 s IN0 := 1 \x01"),
              "byte 01h has no meaning here; remove it (comments begin with # or //)");
}

TEST(ScenarioParser, AMisspeltStatementIsNamed) {
    EXPECT_TRUE(
        mistake("wenn Grip IN0 := 1").starts_with("\"wenn\" is not known here; write at, every, when"));
    EXPECT_TRUE(mistake("expect elephant")
                    .starts_with("\"elephant\" is not known; write one of Start, Guard, Grip, Lamp, IN0"));
}

TEST(ScenarioParser, StepNamesNeedAProgramThatHasThem) {
    const auto parsed = parse_scenario("expect step = Idle", "x.scn", Names{});
    ASSERT_EQ(parsed.mistakes.size(), 1U);
    EXPECT_EQ(parsed.mistakes[0].message,
              "\"Idle\": this program has no step names; write the step's number");
}

TEST(ScenarioParser, EveryLineIsJudgedAndCounted) {
    const auto parsed = parse("at x\r\n\r\nStart := 1\r\nfoo\n");
    ASSERT_EQ(parsed.mistakes.size(), 2U);
    EXPECT_EQ(parsed.mistakes[0].line, 1);
    EXPECT_EQ(parsed.mistakes[1].line, 4);
}

TEST(ScenarioParser, LookingBeyondTheEndIsAMistake) {
    const auto parsed = parse("expect at 12 s Grip\nend at 10 s");
    ASSERT_EQ(parsed.mistakes.size(), 1U);
    EXPECT_EQ(parsed.mistakes[0].place(), "1:11");
    EXPECT_EQ(parsed.mistakes[0].message,
              "this looks at 12 s, but the scenario ends at 10 s; move one of the two");
}

TEST(ScenarioParser, LookingBeyondTheEndPointsAtItsTime) {
    const auto place = [](const std::string& line) {
        const auto parsed = parse(line + "\nend at 10 s");
        return parsed.mistakes.size() == 1 ? parsed.mistakes[0].place() : "not one mistake";
    };
    EXPECT_EQ(place("at 12 s expect Grip"), "1:4");
    EXPECT_EQ(place("expect eventually Grip by 12 s"), "1:27");
    EXPECT_EQ(place("expect Grip by 12 s"), "1:16");
    EXPECT_EQ(place("expect Grip for 1 s at 12 s"), "1:24");
    EXPECT_EQ(place("  always Grip from 11 s until 12 s"), "1:31");
    EXPECT_EQ(place("expect not Grip from 12 s"), "1:22");
}

TEST(ScenarioParser, WhatOthersWriteIsAnsweredWithTheWayItIsDone) {
    EXPECT_EQ(
        mistake("expect Grip falls within 1 s after Start rises"),
        "a change is counted, and a state is awaited; write expect not Grip within 200 ms after and what "
        "happens");
    EXPECT_EQ(mistake("expect Grip rises within after Start rises"),
              "a change is counted, and a state is awaited; write expect Grip within 200 ms after and what "
              "happens");
    EXPECT_EQ(mistake("line drop 5 % for 1 s"),
              "a bad line has no end of its own; write what ends it, such as after 1 s line clean");
    EXPECT_EQ(mistake("at 1 s press Start"), "\"press\" is not known here; write pulse IN0 50 ms");
    EXPECT_EQ(mistake("check Grip"),
              "\"check\" is not known here; write expect and what must hold, such as expect at 2 s OUT0");
    EXPECT_EQ(mistake("wait 2 s"),
              "\"wait\" is not known here; write at and the time from the start, such as at 2 s IN0 := 1");
    EXPECT_EQ(mistake("if Grip then Start := 1"),
              "\"if\" is not known here; write when and what happens, such as when OUT0 rises IN0 := 1");
    EXPECT_EQ(mistake("at 1 s set Start"), "an input is switched with := and the level; write Start := 1");
}

TEST(ScenarioParser, TwoEndsAreAMistake) {
    const auto parsed = parse("end at 10 s\nend at 11 s");
    ASSERT_EQ(parsed.mistakes.size(), 1U);
    EXPECT_EQ(parsed.mistakes[0].line, 2);
}

TEST(ScenarioParser, AnyBytesAreSurvived) {
    std::uint32_t random = 12345;
    constexpr std::string_view kPieces[] = {"at ", "1 s ",  "when ",   "IN0 ", ":= ",   "1 ",    "\"",
                                            "(",   "16#F ", "expect ", "and ", "+- ",   "line ", "%",
                                            "\n",  "\x01",  "P_IST ",  "=",    "drop ", "after "};
    for (int round = 0; round < 2000; ++round) {
        std::string text;
        for (int i = 0; i < 12; ++i) {
            random = random * 1664525U + 1013904223U;
            text += kPieces[(random >> 16) % std::size(kPieces)];
            if ((random >> 8) % 16 == 0) text += static_cast<char>(random >> 24);
        }
        parse(text);
    }
}

std::string repeated(const std::string& text, int times) {
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
}

TEST(ScenarioParser, DeepNestingIsRefused) {
    const auto nots = [](int count) { return "expect " + repeated("not ", count) + "IN0"; };
    const auto parentheses = [](int count) {
        return "expect " + repeated("(", count) + "IN0" + repeated(")", count);
    };
    EXPECT_TRUE(parse(nots(100)).mistakes.empty());
    EXPECT_TRUE(parse(parentheses(100)).mistakes.empty());
    for (const std::string& line : {nots(101), nots(40'000), parentheses(101), parentheses(10'000),
                                    "expect " + repeated("not (", 10'000), "when " + repeated("(", 10'000)}) {
        EXPECT_NE(mistake(line).find("more than 100 deep"), std::string::npos) << mistake(line);
    }
}

TEST(ScenarioParser, LongConditionsBesideEachOtherAreNotDeep) {
    EXPECT_TRUE(parse("expect IN0" + repeated(" and not (IN1)", 10'000)).mistakes.empty());
    EXPECT_TRUE(parse("expect IN0" + repeated(" or (IN1 and IN2)", 10'000)).mistakes.empty());
}

TEST(ScenarioParser, AnEndlessLineIsRefused) {
    EXPECT_NE(mistake("# " + std::string(1'000'000, 'x')).find("longer than 1000000"), std::string::npos);
}

}  // namespace
}  // namespace nplc::sim
