// What is written for foreign checkers, held against the manual's own example and bytes written by hand.
#include "analysis/emit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "seqc/properties.h"

namespace nplc::verify {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// IF INPUT0 AND NOT INPUT3 AND INPOS AND NOT ERROR (001 §6.1.5), whatever timer and counter are, in step 0:
/// to step 2, outputs 5, timer 300. Then an end term.
Bytes example() {
    return {0xC0, 0x41, 0x49, 0x02, 0x80, 0x05, 0x2C, 0x01, 0x3F, 0, 0, 0, 0, 0, 0, 0};
}

std::vector<Property> properties(const std::string& text) {
    const seqc::PropertyReading reading = seqc::read_properties(text, {});
    EXPECT_TRUE(reading.diagnostics.empty());
    return reading.properties;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(Emit, PromelaHasTheManualsExample) {
    const Emission model = promela_of(example(), properties("PROPERTY P: NEVER step = 2 AND IN1;"));
    EXPECT_TRUE(contains(model.text,
                         "step == 0 -> d_step {\n         if :: in0 && !in3 && inpos && !error -> "
                         "wrote = true; output_byte = 5; next_step = 2; timer_preset = 300 :: else fi;"));
    EXPECT_TRUE(contains(model.text, "ltl p_P { [] !bad_P }"));
    EXPECT_TRUE(contains(model.text, "#define bad_P (scanned && ((step == 2) && in1))"));
    EXPECT_TRUE(contains(model.text, "if :: in1 = 0 :: in1 = 1 fi;"));  // only the property names it
    EXPECT_FALSE(contains(model.text, "in2"));
    EXPECT_TRUE(model.left_out.empty());
}

TEST(Emit, TimerAndCounterBitsThatAre0AskForZero) {
    Bytes table = example();
    table[0] = 0x00;
    EXPECT_TRUE(contains(promela_of(table, properties("PROPERTY P: NEVER ERROR;")).text,
                         "!timer_runs && counter == 0 && in0"));
}

/// Spin refuses a d_step of some 60 terms.
TEST(Emit, ALongStepIsSplitForSpin) {
    Bytes table;
    for (int i = 0; i < 100; ++i) table.insert(table.end(), {0xC0, 0, 0, 0x01, 0x80, 0, 0, 0});
    table.push_back(0x3F);
    table.resize(table.size() + 7);
    const std::string text = promela_of(table, properties("PROPERTY P: NEVER IN0;")).text;
    std::size_t most = 0;
    for (std::size_t at = text.find("step == 0"); at != std::string::npos; at = text.find("d_step", at + 1)) {
        const std::string part = text.substr(at, text.find("d_step", at + 10) - at);
        std::size_t terms = 0;
        for (std::size_t t = part.find("next_step = 1"); t != std::string::npos;
             t = part.find("next_step = 1", t + 1))
            ++terms;
        most = std::max(most, terms);
    }
    EXPECT_EQ(most, 16U);
}

TEST(Emit, WhatLinearTimeCannotSayIsLeftOutOfPromela) {
    const auto asked = properties("PROPERTY A: NEVER IN0; PROPERTY B: ALWAYS POSSIBLE step = 0;");
    EXPECT_EQ(promela_of(example(), asked).left_out, std::vector<std::string>{"B"});
    EXPECT_TRUE(smt2_of(example(), asked).left_out.empty());
}

/// Step 0 orders POSITION(P1), 40h (001 §5.2.1.4), whatever inputs are.
TEST(Emit, MovesAndAssumptionsArePartOfTheModel) {
    const Bytes table = {0xC0, 0, 0, 0x01, 0x40, 0, 0, 0, 0x3F, 0, 0, 0, 0, 0, 0, 0};
    const seqc::PropertyReading reading = seqc::read_properties(
        "ASSUME NEVER IN0 AND IN1; ASSUME moving ENDS WITHIN 20 ms; PROPERTY P: NEVER moving AND IN0;", {});
    const std::string promela = promela_of(table, reading.properties, reading.assumptions).text;
    EXPECT_TRUE(contains(promela, "next_step = 1; motion = 1; moved = 0 :: else fi;"));
    EXPECT_TRUE(contains(promela, "      !(in0 && in1);\n"));
    EXPECT_TRUE(
        contains(promela, "      ((motion != 1 && motion != 8) || moved <= 20 || inpos || error);\n"));
    EXPECT_TRUE(contains(promela, "/* ASSUME moving ENDS WITHIN 20 ms */"));
    const std::string clauses = smt2_of(table, reading.properties, reading.assumptions).text;
    // Timer not running, counter 0, no input: to step 1, nothing preset, outputs 0 written, counter kept,
    // orders 0.
    EXPECT_TRUE(contains(
        clauses, "(rule (Scan #b000000 #b0 #b1 #b00000000 #b000001 #b0 #b0 #b1 #b0000 #b00 #b0 #b0))"));
    // To a place, INPOS seen, no ERROR, orders 1, which are none: in its place. With ERROR instead: for an
    // unknown time. Orders 0 begin the move again, in any state.
    EXPECT_TRUE(contains(clauses, "(rule (Turn #b0001 #b1 #b0 #b1 #b0100 #b0))"));
    EXPECT_TRUE(contains(clauses, "(rule (Turn #b0001 #b0 #b1 #b1 #b0011 #b0))"));
    EXPECT_TRUE(contains(clauses, "(rule (Turn #b0001 #b0 #b0 #b1 #b0001 #b1))"));
    EXPECT_TRUE(contains(clauses, "(rule (Turn #b1000 #b0 #b0 #b0 #b0001 #b0))"));
}

TEST(Emit, WhatIsRememberedIsChosenFirst) {
    const auto asked = properties("PROPERTY A: NEVER IN0; PROPERTY B: IN0 ONLY AFTER IN1;");
    const std::string promela = promela_of(example(), asked).text;
    EXPECT_TRUE(contains(promela, ":: watch = 1; kept_first = 0; kept_second = 0"));
    EXPECT_TRUE(contains(promela, "#define bad_A (scanned && in0)"));
    EXPECT_TRUE(contains(promela, "#define bad_B (scanned && watch == 1 && "));
    EXPECT_TRUE(contains(smt2_of(example(), asked).text, "(declare-rel Watch_B "));
    EXPECT_FALSE(contains(smt2_of(example(), asked).text, "Watch_A"));
}

/// Step 0, timer not running, counter 0, of the image only ERROR's bit, which the property names: to step 2,
/// timer preset and so running, outputs 5 written, counter and motion kept.
TEST(Emit, ClausesSayWhatAScanDoes) {
    const Emission clauses = smt2_of(example(), properties("PROPERTY P: NEVER ERROR;"));
    EXPECT_TRUE(
        contains(clauses.text,
                 "(rule (Scan #b000000 #b0 #b1 #b00000000 #b000010 #b1 #b1 #b1 #b0101 #b00 #b0 #b0))\n"));
    EXPECT_TRUE(
        contains(clauses.text,
                 "(rule (Scan #b000000 #b0 #b1 #b10000000 #b000000 #b0 #b0 #b0 #b0000 #b00 #b0 #b0))\n"));
    EXPECT_FALSE(contains(clauses.text, "(rule (Scan #b000000 #b0 #b1 #b10000000 #b000010"));
    EXPECT_TRUE(contains(clauses.text, "(echo \"P\")\n(query Bad_P)\n"));
}

/// CLR_CNT before a preset before CNT_DWN; presets of 3 take two bits.
TEST(Emit, CounterIsClearedPresetOrCountedDown) {
    const auto counter_part = [](std::uint8_t output, std::uint8_t preset) {
        const Bytes table = {0xC0, 0, 0, 0x7E, 0x80, output, preset, 0,  // step 0, no switch, counter
                             0xC1, 0, 0, 0x7E, 0x80, 0,      3,      0,  // so that there are two bits
                             0x3F, 0, 0, 0,    0,    0,      0,      0};
        const std::string text = smt2_of(table, {}).text;
        const std::string scan = "(rule (Scan #b000000 #b0 #b0 #b00000000 #b000000 #b0 #b0 #b1 #b0000 ";
        const std::size_t at = text.find(scan);
        return at == std::string::npos ? std::string() : text.substr(at + scan.size(), 9);
    };
    EXPECT_EQ(counter_part(0xC0, 3), "#b01 #b00");
    EXPECT_EQ(counter_part(0x80, 3), "#b01 #b11");
    EXPECT_EQ(counter_part(0x80, 0), "#b10 #b00");
    EXPECT_EQ(counter_part(0x00, 0), "#b00 #b00");
}

}  // namespace
}  // namespace nplc::verify
