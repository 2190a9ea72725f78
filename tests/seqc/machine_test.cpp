// A table seen whole: what its steps do, which are reached, which outputs they have, what entering them does.
#include "report/machine.h"

#include <gtest/gtest.h>

#include "random_table.h"
#include "sequencer/engine.h"
#include "support.h"

namespace nplc::seqc {
namespace {

constexpr std::uint8_t kIdle = 1;
constexpr std::uint8_t kRun = 2;
constexpr std::uint8_t kFault = 3;
constexpr std::uint8_t kLost = 4;

Machine machine(std::string_view steps) {
    const std::string source =
        "PROGRAM P MOTOR MAC140; VAR_INPUT A AT IN0; B AT IN1; END_VAR VAR_OUTPUT X AT OUT0; Y AT OUT1; "
        "END_VAR\n"
        "VAR_MOTOR Fast AT V1 := 1000; END_VAR ON ERROR NEXT := Fault;\n"
        "POWER_UP INIT(Fast); NEXT := Idle; END_POWER_UP\n" +
        std::string(steps) + "\nEND_PROGRAM";
    const Compilation compiled = compile(source);
    EXPECT_TRUE(compiled.ok) << test::shown(compiled, source);
    return machine_of(compiled.table);
}

const Machine& example() {
    static const Machine result = machine(
        "STEP Idle: OUT X; IF A THEN NEXT := Run; ELSIF B THEN EVERY_SCAN COUNT_DOWN; END_IF END_STEP\n"
        "STEP Run: OUT Y; OUT X WHEN B; IF NOT A THEN STOP; NEXT := Idle;\n"
        "ELSIF TIMER.Q THEN NEXT := Fault; END_IF END_STEP\n"
        "STEP Fault: OWN ERROR; ENTRY STOP; IF ANY ERROR AND B THEN TIMER := T#5ms; NEXT := Idle; END_IF "
        "END_STEP\n"
        "STEP Lost: OWN ERROR; IF A THEN NEXT := Idle; END_IF END_STEP");
    return result;
}

TEST(Machine, KnowsWhatIsUsedAndReached) {
    EXPECT_EQ(example().used.to_ulong(), 0b11111U);
    EXPECT_EQ(example().reachable.to_ulong(), 0b01111U);
}

TEST(Machine, KnowsTheOutputsOfSteps) {
    EXPECT_EQ(example().entered_with[kIdle], (KnownOutputs{0x0F, 1}));
    EXPECT_EQ(example().held[kIdle], (KnownOutputs{0x0F, 1}));
    EXPECT_EQ(example().entered_with[kRun], (KnownOutputs{0x0F, 2}));
    EXPECT_EQ(example().held[kRun], (KnownOutputs{0x0E, 2}));  // X follows B
    const auto rules = output_rules(example(), kRun);
    ASSERT_EQ(rules.size(), 2U);
    EXPECT_EQ(rules[0].bit, 0);
    EXPECT_EQ(rules[0].kind, OutputRule::Kind::follows);
    EXPECT_TRUE(rules[0].when.test(0x03) && !rules[0].when.test(0x01));  // A and B; A alone
    EXPECT_EQ(rules[1].bit, 1);
    EXPECT_EQ(rules[1].kind, OutputRule::Kind::on);
}

TEST(Machine, ReactionsLeaveOutWhatStaysAsItIs) {
    const auto reactions = reactions_of(example(), kIdle);
    ASSERT_EQ(reactions.size(), 3U);  // A; NOT A AND B; ERROR
    EXPECT_EQ(reactions[0].outcome.next, kRun);
    EXPECT_EQ(reactions[0].when, truth_of_bit(kInput0) & ~truth_of_bit(kErrorBit));
    EXPECT_FALSE(reactions[0].outcome.outputs);  // Run's own
    EXPECT_EQ(reactions[1].outcome.next, kIdle);
    EXPECT_EQ(reactions[1].outcome.counter, table::CounterChange::count_down);
    EXPECT_EQ(reactions[2].outcome.next, kFault);
    EXPECT_TRUE((reactions[2].when & ~truth_of_bit(kErrorBit)).none());
}

TEST(Machine, WhatHoldsWithAndWithoutErrorIsOne) {
    const auto reactions = reactions_of(example(), kFault);
    ASSERT_EQ(reactions.size(), 1U);
    EXPECT_EQ(reactions[0].when, truth_of_bit(kInput0 + 1));
    EXPECT_EQ(reactions[0].outcome.timer, 5);
}

TEST(Machine, FindsWhatEveryWayInDoes) {
    ASSERT_EQ(entry_of(example(), kFault).orders.size(), 1U);
    EXPECT_EQ(entry_of(example(), kFault).orders[0].command, 0x65);  // STOP
    EXPECT_TRUE(entry_of(example(), kIdle).orders.empty());
    EXPECT_TRUE(entry_of(example(), kRun).orders.empty());  // one way only
    const auto values = power_up_orders(example());
    ASSERT_EQ(values.size(), 1U);  // INIT is not sent on ERROR
    EXPECT_EQ(values[0].reg, 65);
    EXPECT_TRUE(entry_of(example(), kLost).orders.empty());
}

/// Where a machine really gets to, with which outputs: random inputs on the engine.
TEST(Machine, NothingTheEngineDoesIsBeyondIt) {
    constexpr unsigned kSeed = 35;
    test::Random random(kSeed);
    std::size_t switches = 0;
    for (int round = 0; round < 100; ++round) {
        const auto table = test::random_table(random, 12, 10 + random() % 50);
        const Machine seen = machine_of(table);
        const auto loaded = sequencer::Table::load(table);
        ASSERT_TRUE(loaded.ok);
        sequencer::Engine engine(loaded.table);
        for (int scan = 0; scan < 500; ++scan) {
            const auto before = engine.state();
            engine.scan(static_cast<std::uint8_t>(random() % 256), [](const auto&) {});
            engine.elapse(random() % 100 == 0 ? 70'000 : 1);
            const auto& state = engine.state();
            SCOPED_TRACE("seed " + std::to_string(kSeed) + ", round " + std::to_string(round));
            ASSERT_TRUE(seen.reachable.test(state.step));
            const KnownOutputs& held = seen.held[state.step];
            ASSERT_EQ(state.outputs & held.known, held.value);
            if (state.step == before.step) continue;
            ++switches;
            const KnownOutputs& entered = seen.entered_with[state.step];
            ASSERT_EQ(state.outputs & entered.known, entered.value);
        }
    }
    EXPECT_GT(switches, 500U);
}

}  // namespace
}  // namespace nplc::seqc
