#include "seqc/properties.h"

#include <gtest/gtest.h>

#include <string>

namespace nplc::seqc {
namespace {

using verify::Form;
using verify::Property;
using verify::View;

Symbols names() {
    Symbols result;
    result.steps[0] = "POWER_UP";
    result.steps[1] = "Idle";
    result.steps[2] = "Push";
    result.inputs = {"Start", "Door", "IN2", "IN3", "IN4", "IN5"};
    result.outputs = {"Clamp", "OUT1", "OUT2", "OUT3"};
    result.groups = {{"Both", 0b110}, {"Nobody", 0}};
    result.times = {{"Pause", 250}};
    return result;
}

/// Line, column, message and help of the first mistake; empty if there is none.
std::string mistake_in(std::string_view text) {
    const PropertyReading reading = read_properties(text, names());
    EXPECT_EQ(reading.diagnostics.empty(), !reading.properties.empty() || !reading.assumptions.empty())
        << text;
    if (reading.diagnostics.empty()) return "";
    const Diagnostic& first = reading.diagnostics.front();
    const std::string shown = render(first, text, "F");
    const std::string place = shown.substr(2, shown.find(": ") - 2);
    return place + ": " + first.message + "; " + first.help;
}

Property only(std::string_view text) {
    const PropertyReading reading = read_properties(text, names());
    EXPECT_EQ(mistake_in(text), "");
    EXPECT_EQ(reading.properties.size(), 1U);
    return reading.properties.empty() ? Property{} : reading.properties[0];
}

bool condition(std::string_view text, std::uint8_t image, const View& view) {
    return holds(only("PROPERTY P: NEVER " + std::string(text) + ";").condition, image, view);
}

TEST(Property, NamesAndAddressesMeanTheSame) {
    const View view{.step = 1, .outputs = 1};
    EXPECT_TRUE(condition("Start AND Clamp AND step = Idle", 0x01, view));
    EXPECT_TRUE(condition("in0 AND OUT0 AND STEP = 1", 0x01, view));
    EXPECT_TRUE(condition("%IX0.0 AND %QX0.0 AND step = idle", 0x01, view));
    EXPECT_FALSE(condition("Door OR OUT1 OR step = Push", 0x01, view));
}

TEST(Property, AGroupIsAnyOfItsSteps) {
    EXPECT_TRUE(condition("step in both", 0, {.step = 1}));
    EXPECT_TRUE(condition("STEP IN Both AND Start", 1, {.step = 2}));
    EXPECT_FALSE(condition("STEP IN Both", 0, {.step = 0}));
    EXPECT_FALSE(condition("STEP IN Nobody", 0, {.step = 0}));
    EXPECT_TRUE(condition("STEP IN Push", 0, {.step = 2}));
    EXPECT_EQ(mistake_in("PROPERTY P: NEVER STEP IN Moving;"),
              "1:27: there is no group 'Moving'; write GROUP Moving: steps; or STEP = Name");
}

TEST(Property, NotBindsTightestAndOrLoosest) {
    EXPECT_TRUE(condition("NOT IN0 AND IN1 OR IN2", 0b100, {}));
    EXPECT_TRUE(condition("IN0 OR IN1 AND IN2", 0b001, {}));
    EXPECT_FALSE(condition("(IN0 OR IN1) AND IN2", 0b001, {}));
    EXPECT_TRUE(condition("IN0 XOR IN1 AND IN2", 0b001, {}));
}

TEST(Property, ErrorCountsOnlyWhereItIsNamed) {
    EXPECT_TRUE(condition("IN0", 0x81, {}));
    EXPECT_TRUE(condition("IN0 AND ERROR", 0x81, {}));
    EXPECT_FALSE(condition("IN0 AND NOT ERROR", 0x81, {}));
    EXPECT_TRUE(condition("INPOS", 0x40, {}));
}

TEST(Property, TimerAndCounterAreTrueAtZero) {
    EXPECT_TRUE(condition("TIMER.Q AND NOT COUNTER.Q", 0, {.timer_zero = true, .counter_zero = false}));
}

TEST(Property, EveryFormIsRead) {
    EXPECT_EQ(only("PROPERTY P: NEVER IN0;").form, Form::never);
    EXPECT_EQ(only("PROPERTY P: ALWAYS IN0;").form, Form::always);
    EXPECT_EQ(only("PROPERTY On: NEVER IN0;").name, "On") << "a word of the language";
    EXPECT_EQ(only("PROPERTY P: ALWAYS POSSIBLE IN0;").form, Form::always_possible);
    EXPECT_EQ(only("PROPERTY P: step = Push IS REACHABLE;").form, Form::reachable);
    const Property property = only("property P : whenever IN0 then IN1 within 1.5 s ; // comment");
    EXPECT_EQ(property.form, Form::whenever);
    EXPECT_EQ(property.within_ms, 1500U);
    EXPECT_EQ(property.text, "whenever IN0 then IN1 within 1.5 s");
    EXPECT_EQ(only("PROPERTY P: NEVER IN0 WHILE IN1 FOR 100 ms;").form, Form::never_while);
    EXPECT_EQ(only("PROPERTY P: WHENEVER IN0 FOR 2 s THEN IN1;").within_ms, 2000U);
    EXPECT_EQ(only("PROPERTY P: WHENEVER IN0 THEN IN1;").form, Form::never);
    EXPECT_EQ(only("PROPERTY P: WHENEVER IN0 FOLLOWED BY IN1 THEN Clamp;").form, Form::followed_by);
    EXPECT_EQ(only("PROPERTY P: AFTER IN0 ALWAYS POSSIBLE step = Idle;").form, Form::after_possible);
    EXPECT_EQ(only("PROPERTY P: BETWEEN step = Push AND step = Idle Clamp STAYS on;").form, Form::stays);
    EXPECT_EQ(only("PROPERTY P: Clamp CHANGES ONLY IN step = Idle;").form, Form::changes_only_in);
    EXPECT_EQ(only("PROPERTY P: Clamp ONLY AFTER IN0 OR IN1;").form, Form::only_after);
    EXPECT_EQ(only("PROPERTY P: Clamp ONLY AFTER IN0 FOLLOWED BY IN1;").form, Form::only_after_both);
    EXPECT_EQ(only("PROPERTY P: Clamp ONLY FROM step = Push AND IN0;").form, Form::only_from);
    EXPECT_EQ(only("PROPERTY P: EVERY_SCAN FROM step = Idle AND IN0 ENDS IN step = Push;").form,
              Form::scan_ends);
    EXPECT_EQ(only("PROPERTY P: WHENEVER IN0 THEN IN1 WITHIN T#1s500ms;").within_ms, 1500U);
    EXPECT_EQ(only("PROPERTY P: WHENEVER IN0 THEN IN1 WITHIN 20ms;").within_ms, 20U);
    EXPECT_EQ(only("PROPERTY P: WHENEVER IN0 THEN IN1 WITHIN 1_500 ms;").within_ms, 1500U);
    EXPECT_EQ(only("PROPERTY P: WHENEVER IN0 THEN IN1 WITHIN TIME#1m30s;").within_ms, 90'000U);
    EXPECT_EQ(only("PROPERTY P: WHENEVER IN0 THEN IN1 WITHIN t#1h;").within_ms, 3'600'000U);
}

TEST(Property, ATimeCanHaveItsName) {
    const Property property = only("PROPERTY P: WHENEVER IN0 THEN IN1 WITHIN pause;");
    EXPECT_EQ(property.within_ms, 250U);
    EXPECT_EQ(property.text, "WHENEVER IN0 THEN IN1 WITHIN 250 ms");
    EXPECT_EQ(only("PROPERTY P: NEVER IN0 WHILE IN1 FOR Pause;").within_ms, 250U);
    EXPECT_EQ(mistake_in("PROPERTY P: NEVER IN0 WHILE IN1 FOR Puase;"),
              "1:37: there is no time 'Puase'; did you mean 'Pause'?");
}

TEST(Property, AssumptionsAreOfInputs) {
    const PropertyReading reading = read_properties(
        "ASSUME Start STABLE FOR 50 ms; ASSUME NEVER Start AND Door; ASSUME NEVER ERROR;"
        "ASSUME moving ENDS WITHIN 2 s;",
        names());
    ASSERT_EQ(reading.assumptions.size(), 4U);
    EXPECT_EQ(reading.assumptions[3].move_ms, 2000U);
    EXPECT_EQ(reading.assumptions[0].stable_ms, 50U);
    EXPECT_EQ(reading.assumptions[1].text, "ASSUME NEVER Start AND Door");
    EXPECT_TRUE(holds(reading.assumptions[2].never, 0x80, {}));
    for (const char* wrong : {"ASSUME NEVER Clamp;", "ASSUME NEVER step = Idle;",
                              "ASSUME Clamp STABLE FOR 5 ms;", "ASSUME NEVER moving;", "ASSUME Start STABLE;",
                              "ASSUME Start;", "ASSUME moving ENDS;", "ASSUME moving ENDS WITHIN 0 ms;",
                              "ASSUME Start ENDS WITHIN 2 s;", "ASSUME moving STABLE FOR 2 s;"})
        EXPECT_NE(mistake_in(wrong), "") << wrong;
}

TEST(Property, MistakesNameTheirPlace) {
    EXPECT_EQ(mistake_in("(* a\n*)\nPROPERTY P: NEVER Stert;"),
              "3:19: there is no input or output 'Stert'; did you mean 'Start'?");
    EXPECT_EQ(mistake_in("(* \u00fc\n *) PROPERTY P: NEVER step = Idel;"),
              "2:30: there is no step 'Idel'; did you mean 'Idle'?");
    EXPECT_EQ(mistake_in("PROPERTY P: NEVER step = Nowhere;"),
              "1:26: there is no step 'Nowhere'; name one of the steps there are");
    EXPECT_EQ(mistake_in("PROPERTY P: NEVER step = 63;"),
              "1:26: there is no step 63; steps are named, or have the numbers 0 to 62");
    EXPECT_EQ(mistake_in("PROPERTY P: NEVER step = Both;"),
              "1:26: there is no step 'Both'; it is the name of several steps: write STEP IN Both");
    EXPECT_NE(mistake_in("PROPERTY P: NEVER IN0"), "");
    EXPECT_NE(mistake_in("PROPERTY P: NEVER step = 5 ms;"), "");
    EXPECT_NE(mistake_in("PROPERTY P: NEVER IN0; STEP Idle: END_STEP"), "");
    EXPECT_EQ(mistake_in("PROPERTY P: NEVER IN0; PROPERTY p: NEVER IN1;"),
              "1:33: property 'p' stands twice; give one of them another name");
    EXPECT_NE(mistake_in("PROPERTY P: WHENEVER IN0 THEN IN1 WITHIN 1.5 ms;"), "");
    EXPECT_NE(mistake_in("PROPERTY P: NEVER " + std::string(200, '(') + "IN0"), "");
}

TEST(Property, AllMistakesOfAFileAreTold) {
    const PropertyReading reading = read_properties(
        "PROPERTY A: NEVER Stert;\nPROPERTY B: NEVR Start;\nASSUME Door STABLE FOR 5;\n", names());
    ASSERT_FALSE(reading.diagnostics.empty());
    EXPECT_TRUE(reading.properties.empty());
    const PropertyReading names_alone =
        read_properties("PROPERTY A: NEVER Stert;\nASSUME Door STABLE FOR 5;\n", names());
    EXPECT_EQ(names_alone.diagnostics.size(), 2U);
}

}  // namespace
}  // namespace nplc::seqc
