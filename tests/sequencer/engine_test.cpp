#include "sequencer/engine.h"

#include <gtest/gtest.h>

#include "tables.h"

// A term's bytes: STATE INPUT CARE | NEXT_STATE FAST_COMMAND OUTPUT TIMER_COUNTER(low, high). STATE bits 7
// and 6 set: timer and counter do not matter. FAST_COMMAND bit 7 set: nothing is sent. NEXT_STATE 3Eh: no
// switch.
namespace nplc::sequencer {
namespace {

MotorOrder fast(std::uint8_t command) {
    return {.command = command};
}

TEST(Engine, PowerUpIsStep0TimerCounterAndOutputs0) {
    Bench bench({});
    EXPECT_EQ(bench.state(), (State{0, 0, 0, 0}));
    bench.engine.restore({9, 9, 9, 9});
    bench.engine.reset();
    EXPECT_EQ(bench.state(), (State{0, 0, 0, 0}));
}

TEST(Engine, PowerUpMeetsTimer0AndCounter0) {
    Bench bench({{0x00, 0x00, 0x00, 0x05, 0x80, 0x01, 0x00, 0x00}});
    bench.scan();
    EXPECT_EQ(bench.state().step, 5);
}

TEST(Engine, StatesAreTheSameIfAllOfThemIs) {
    const State state{1, 2, 3, 4};
    for (const State& other : {State{0, 2, 3, 4}, State{1, 0, 3, 4}, State{1, 2, 0, 4}, State{1, 2, 3, 0}})
        EXPECT_FALSE(state == other);
    EXPECT_TRUE(state == (State{1, 2, 3, 4}));
}

TEST(Engine, EmptyTableDoesNothing) {
    Bench bench({});
    const ScanEffect effect = bench.scan(0xFF);
    EXPECT_FALSE(effect.any());
    EXPECT_EQ(bench.state(), State{});
}

TEST(Engine, OnlyTermsOfTheCurrentStepAreTrue) {
    Bench bench({{0xC1, 0, 0, 0x02, 0x11, 0x01, 0, 0}, {0xC0, 0, 0, 0x01, 0x22, 0x02, 0, 0}});
    bench.scan();
    EXPECT_EQ(bench.state(), (State{1, 2, 0, 0}));
    EXPECT_EQ(bench.orders, std::vector{fast(0x22)});
    bench.scan();
    EXPECT_EQ(bench.state(), (State{2, 1, 0, 0}));
    EXPECT_EQ(bench.orders, std::vector{fast(0x11)});
    EXPECT_FALSE(bench.scan().any());
}

// 001 §6.1.5's example, with every image of HW_INP: INPUT0 AND NOT INPUT3 AND INPOS AND NOT ERROR.
TEST(Engine, ManualsConditionExampleForAllImages) {
    for (unsigned image = 0; image < 256; ++image) {
        Bench bench({{0xC0, 0x41, 0x49, 0x01, 0x80, 0, 0, 0}});
        bench.scan(static_cast<InputImage>(image));
        const bool input0 = (image & 0x01) != 0;
        const bool input3 = (image & 0x08) != 0;
        const bool inpos = (image & 0x40) != 0;
        const bool error = (image & 0x80) != 0;
        EXPECT_EQ(bench.state().step == 1, input0 && !input3 && inpos && !error) << image;
    }
}

TEST(Engine, ErrorIsAlwaysCompared) {
    for (const std::uint8_t care : Bytes{0x00, 0x7F}) {
        Bench bench({{0xC0, 0x00, care, 0x01, 0x80, 0, 0, 0}});
        bench.scan(0x80);
        EXPECT_EQ(bench.state().step, 0) << "ERROR is on, the term wants it off";
        bench.scan(0x00);
        EXPECT_EQ(bench.state().step, 1);
    }
    Bench wants_error({{0xC0, 0x80, 0x00, 0x01, 0x80, 0, 0, 0}});
    wants_error.scan(0x00);
    EXPECT_EQ(wants_error.state().step, 0);
    wants_error.scan(0x80);
    EXPECT_EQ(wants_error.state().step, 1);
}

// CARE bit 7 is CMD_FORMAT; it must not act as a mask either.
TEST(Engine, ErrorIsComparedInFlexFormatToo) {
    Bench bench({{0xC0, 0x00, 0x80, 0x05, 0x00, 0x00, 0x00, 0x00}});
    bench.scan(0x80);
    EXPECT_TRUE(bench.orders.empty());
    bench.scan(0x7F);
    EXPECT_EQ(bench.orders.size(), 1U);
}

TEST(Engine, TimerBit0WantsTimer0) {
    Bench bench({{0x40, 0, 0, 0x01, 0x80, 0, 0, 0}});
    bench.engine.restore({.timer = 1});
    bench.scan();
    EXPECT_EQ(bench.state().step, 0);
    bench.engine.elapse(1);
    bench.scan();
    EXPECT_EQ(bench.state().step, 1);
}

TEST(Engine, CounterBit0WantsCounter0) {
    Bench bench({{0x80, 0, 0, 0x01, 0x80, 0, 0, 0}});
    bench.engine.restore({.counter = 1});
    bench.scan();
    EXPECT_EQ(bench.state().step, 0);
    bench.engine.restore({});
    bench.scan();
    EXPECT_EQ(bench.state().step, 1);
}

TEST(Engine, NextState3EMakesNoSwitch) {
    Bench bench({{0xC5, 0, 0, 0x3E, 0x80, 0x0A, 0, 0}});
    bench.engine.restore({.step = 5});
    bench.scan();
    EXPECT_EQ(bench.state(), (State{5, 0x0A, 0, 0}));
}

TEST(Engine, Step62RunsWhenTheStateIsThere) {
    Bench bench({{0xFE, 0, 0, 0x03, 0x80, 0x01, 0, 0}});
    bench.engine.restore({.step = 62});
    bench.scan();
    EXPECT_EQ(bench.state().step, 3);
}

TEST(Engine, Step61CanBeJumpedTo) {
    Bench bench({{0xC0, 0, 0, 0x3D, 0x80, 0, 0, 0}});
    bench.scan();
    EXPECT_EQ(bench.state().step, 61);
}

TEST(Engine, AvailableBitsDoNothing) {
    Bench bench({{0xC0, 0, 0, 0x80 | 0x04, 0x80, 0x35, 0, 0}});
    bench.scan();
    EXPECT_EQ(bench.state(), (State{4, 5, 0, 0}));
}

TEST(Engine, LastTrueTermsOutputByteWinsWhole) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x80, 0xC5, 0, 0},    // outputs 5, clear, decrement
                 {0xC0, 0, 0, 0x3E, 0x80, 0x0A, 0, 0},    // outputs 10, neither
                 {0xC0, 1, 1, 0x3E, 0x80, 0x4F, 0, 0}});  // false: INPUT0
    bench.engine.restore({.counter = 7});
    bench.scan();
    EXPECT_EQ(bench.state(), (State{0, 10, 0, 7}));
}

TEST(Engine, NextStepIsOverwrittenOnlyByATermThatNamesOne) {
    Bench bench({{0xC0, 0, 0, 0x02, 0x80, 0, 0, 0},
                 {0xC0, 0, 0, 0x07, 0x80, 0, 0, 0},
                 {0xC0, 0, 0, 0x3E, 0x80, 0, 0, 0}});
    bench.scan();
    EXPECT_EQ(bench.state().step, 7);
}

TEST(Engine, PresetsAreOverwrittenOnlyByAWordAbove0) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x80, 0, 0x64, 0x00},         // timer 100
                 {0xC0, 0, 0, 0x3E, 0x80, 0, 0xC8, 0x00},         // timer 200
                 {0xC0, 0, 0, 0x40 | 0x3E, 0x80, 0, 0x03, 0x00},  // counter 3
                 {0xC0, 0, 0, 0x40 | 0x3E, 0x80, 0, 0x00, 0x00},
                 {0xC0, 0, 0, 0x3E, 0x80, 0, 0x00, 0x00}});
    bench.scan();
    EXPECT_EQ(bench.state(), (State{0, 0, 200, 3}));
}

TEST(Engine, TimerAndCounterCanBothBePresetInOneScan) {
    Bench bench({{0xC0, 0, 0, 0x40 | 0x3E, 0x80, 0, 0x05, 0x00}, {0xC0, 0, 0, 0x3E, 0x80, 0, 0x09, 0x00}});
    bench.scan();
    EXPECT_EQ(bench.state(), (State{0, 0, 9, 5}));
}

// 01F4h = 500; low byte first.
TEST(Engine, PresetWordIsLowByteFirst) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x80, 0, 0xF4, 0x01}});
    bench.scan();
    EXPECT_EQ(bench.state().timer, 500);
}

TEST(Engine, PresetOf0UpdatesNothing) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x80, 0, 0, 0}, {0xC0, 0, 0, 0x7E, 0x80, 0, 0, 0}});
    bench.engine.restore({0, 0, 30, 40});
    bench.scan();
    EXPECT_EQ(bench.state(), (State{0, 0, 30, 40}));
}

TEST(Engine, FlexTermsTouchNoTemporaryRegister) {
    Bench bench({{0xC0, 0, 0, 0x02, 0x80, 0x05, 0x09, 0x00}, {0xC0, 0, 0x80, 0xC7, 0xFF, 0xFF, 0xFF, 0xFF}});
    bench.scan();
    EXPECT_EQ(bench.state(), (State{2, 5, 9, 0}));
}

TEST(Engine, OnlyFlexTermsTrueKeepsOutputsStepAndCounter) {
    Bench bench({{0xC6, 0, 0x80, 0x05, 0xFF, 0xFF, 0xFF, 0xFF}});
    bench.engine.restore({6, 11, 12, 13});
    const ScanEffect effect = bench.scan();
    EXPECT_EQ(bench.state(), (State{6, 11, 12, 13}));
    EXPECT_FALSE(effect.changed);
    EXPECT_TRUE(effect.sent);
}

TEST(Engine, NoTrueTermKeepsEverything) {
    Bench bench({{0xC6, 1, 1, 0x01, 0x00, 0xCF, 0xFF, 0xFF}});
    bench.engine.restore({6, 11, 12, 13});
    const ScanEffect effect = bench.scan();
    EXPECT_EQ(bench.state(), (State{6, 11, 12, 13}));
    EXPECT_FALSE(effect.any());
}

TEST(Engine, CntDwnDecrementsOnceAScanHoweverManyTermsAskForIt) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x80, 0x80, 0, 0},
                 {0xC0, 0, 0, 0x3E, 0x80, 0x80, 0, 0},
                 {0xC0, 0, 0, 0x3E, 0x80, 0x80, 0, 0}});
    bench.engine.restore({.counter = 5});
    bench.scan();
    EXPECT_EQ(bench.state().counter, 4);
    bench.scan();
    EXPECT_EQ(bench.state().counter, 3);
}

TEST(Engine, ClearBeatsPresetAndDecrement) {
    Bench bench({{0xC0, 0, 0, 0x7E, 0x80, 0xC0, 0x09, 0x00}});
    bench.engine.restore({.counter = 5});
    bench.scan();
    EXPECT_EQ(bench.state().counter, 0);
}

TEST(Engine, PresetBeatsDecrement) {
    Bench bench({{0xC0, 0, 0, 0x7E, 0x80, 0x80, 0x09, 0x00}});
    bench.engine.restore({.counter = 5});
    bench.scan();
    EXPECT_EQ(bench.state().counter, 9);
}

// CLR_CNT belongs to the OUTPUT byte that the second term overwrites; the preset of the first one stands.
TEST(Engine, ClearOfAnOverwrittenOutputByteIsGone) {
    Bench bench({{0xC0, 0, 0, 0x7E, 0x80, 0x40, 0x09, 0x00}, {0xC0, 0, 0, 0x3E, 0x80, 0x00, 0, 0}});
    bench.engine.restore({.counter = 5});
    bench.scan();
    EXPECT_EQ(bench.state().counter, 9);
}

TEST(Engine, CounterStaysAt0) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x80, 0x80, 0, 0}});
    const ScanEffect effect = bench.scan();
    EXPECT_EQ(bench.state().counter, 0);
    EXPECT_FALSE(effect.any());
}

TEST(Engine, FastDisKeepsTheCommandBack) {
    Bench sends({{0xC0, 0, 0, 0x3E, 0x7F, 0, 0, 0}});
    sends.scan();
    EXPECT_EQ(sends.orders, std::vector{fast(0x7F)});
    Bench silent({{0xC0, 0, 0, 0x3E, 0xFF, 0, 0, 0}});
    EXPECT_FALSE(silent.scan().sent);
    EXPECT_TRUE(silent.orders.empty());
}

TEST(Engine, CommandGoesOutInEveryScanInWhichTheTermIsTrue) {
    Bench bench({{0xC0, 1, 1, 0x3E, 0x0C, 0, 0, 0}});
    for (int i = 0; i < 3; ++i) {
        bench.scan(1);
        EXPECT_EQ(bench.orders, std::vector{fast(0x0C)}) << i;
    }
    bench.scan(0);
    EXPECT_TRUE(bench.orders.empty());
}

TEST(Engine, OrdersGoOutInTableOrder) {
    Bench bench({{0xC0, 0, 0x00, 0x3E, 0x10, 0, 0, 0},
                 {0xC0, 0, 0x80, 0x05, 0x34, 0x12, 0x78, 0x56},  // word to register 5
                 {0xC0, 0, 0x00, 0x3E, 0x80, 0, 0, 0},           // nothing
                 {0xC0, 0, 0x80, 0x83, 0x34, 0x12, 0x78, 0x56},  // longword to register 3
                 {0xC0, 0, 0x00, 0x3E, 0x11, 0, 0, 0}});
    bench.scan();
    const MotorOrder word{.is_register_write = true, .reg = 5, .longword = false, .value = 0x1234};
    const MotorOrder longword{.is_register_write = true, .reg = 3, .longword = true, .value = 0x56781234};
    EXPECT_EQ(bench.orders, (std::vector{fast(0x10), word, longword, fast(0x11)}));
}

// Every term is judged by what stood when the scan began, not by what earlier terms ask for.
TEST(Engine, CommandsActAfterAllTermsWereJudged) {
    Bench bench({{0x00, 0, 0, 0x01, 0x80, 0x01, 0x32, 0x00},    // step 1, timer 50
                 {0x00, 0, 0, 0x3E, 0x20, 0x02, 0, 0},          // still timer 0, still step 0
                 {0xC1, 0, 0, 0x02, 0x21, 0x04, 0x00, 0x00}});  // step 1: not in this scan
    bench.scan();
    EXPECT_EQ(bench.orders, std::vector{fast(0x20)});
    EXPECT_EQ(bench.state(), (State{1, 2, 50, 0}));
}

TEST(Engine, TermsOfAStepNeedNotStandTogether) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x01, 0, 0, 0},
                 {0xC9, 0, 0, 0x09, 0x02, 0, 0, 0},
                 {0xC0, 0, 0, 0x05, 0x03, 0, 0, 0}});
    bench.scan();
    EXPECT_EQ(bench.orders, (std::vector{fast(1), fast(3)}));
    EXPECT_EQ(bench.state().step, 5);
}

TEST(Engine, TimerCountsMillisecondsDownTo0AndStays) {
    Bench bench({});
    bench.engine.restore({.timer = 100});
    bench.engine.elapse(0);
    EXPECT_EQ(bench.state().timer, 100);
    bench.engine.elapse(99);
    EXPECT_EQ(bench.state().timer, 1);
    bench.engine.elapse(5);
    EXPECT_EQ(bench.state().timer, 0);
    bench.engine.elapse(5);
    EXPECT_EQ(bench.state().timer, 0);
}

TEST(Engine, TimerTakesPausesLongerThanItsWord) {
    Bench bench({});
    bench.engine.restore({.timer = 65535});
    bench.engine.elapse(65536);
    EXPECT_EQ(bench.state().timer, 0);
    bench.engine.restore({.timer = 65535});
    bench.engine.elapse(0xFFFF'FFFF);
    EXPECT_EQ(bench.state().timer, 0);
}

TEST(Engine, TimerPresetOf1IsGoneAfter1Millisecond) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x80, 0, 0x01, 0x00}});
    bench.engine.restore({.timer = 5000});
    bench.scan();
    EXPECT_EQ(bench.state().timer, 1);
    bench.engine.elapse(1);
    EXPECT_EQ(bench.state().timer, 0);
}

TEST(Engine, TimeBeforeAPresetIsNotChargedToIt) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x10, 0, 0xF4, 0x01}});
    bench.engine.begin(0);
    ASSERT_TRUE(bench.engine.next());
    bench.engine.elapse(300);  // halted by the queue
    EXPECT_FALSE(bench.engine.next());
    EXPECT_TRUE(bench.engine.finish().timer_preset);
    EXPECT_EQ(bench.state().timer, 500);
}

TEST(Engine, TimerRunsOnWhileTheScanIsHalted) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x10, 0, 0, 0}});
    bench.engine.restore({.timer = 500});
    bench.engine.begin(0);
    ASSERT_TRUE(bench.engine.next());
    bench.engine.elapse(300);
    EXPECT_FALSE(bench.engine.finish().timer_preset);
    EXPECT_EQ(bench.state().timer, 200);
}

TEST(Engine, ConditionsAreFrozenWhileTheScanIsHalted) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x10, 0, 0, 0}, {0x40, 0, 0, 0x3E, 0x11, 0, 0, 0}});
    bench.engine.restore({.timer = 5});
    bench.engine.begin(0);
    ASSERT_TRUE(bench.engine.next());
    bench.engine.elapse(5);  // the timer reaches 0 in mid-scan
    EXPECT_FALSE(bench.engine.next());
    bench.engine.finish();
    bench.engine.begin(0);
    ASSERT_TRUE(bench.engine.next());
    EXPECT_EQ(bench.engine.next(), fast(0x11));
}

TEST(Engine, OutputsDoNotMoveBeforeFinish) {
    Bench bench({{0xC0, 0, 0, 0x02, 0x10, 0x0F, 0, 0}});
    bench.engine.begin(0);
    ASSERT_TRUE(bench.engine.next());
    EXPECT_FALSE(bench.engine.next());
    EXPECT_EQ(bench.state(), State{});
    bench.engine.finish();
    EXPECT_EQ(bench.state(), (State{2, 0x0F, 0, 0}));
}

TEST(Engine, ResetDropsAScanUnderWay) {
    Bench bench({{0xC0, 0, 0, 0x02, 0x10, 0x0F, 0x05, 0x00}, {0xC0, 0, 0, 0x3E, 0x11, 0x0F, 0, 0}});
    bench.engine.begin(0);
    ASSERT_TRUE(bench.engine.next());
    bench.engine.reset();
    EXPECT_FALSE(bench.engine.next());
    EXPECT_FALSE(bench.engine.finish().any());
    EXPECT_EQ(bench.state(), State{});
}

TEST(Engine, EffectTellsChangesFromRepeats) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x80, 0x05, 0, 0}});
    EXPECT_TRUE(bench.scan().changed);
    EXPECT_FALSE(bench.scan().any());
}

TEST(Engine, EffectOfATimerPresetIsAChangeEvenToTheSameValue) {
    Bench bench({{0xC0, 0, 0, 0x3E, 0x80, 0, 0x05, 0x00}});
    bench.scan();
    const ScanEffect again = bench.scan();
    EXPECT_TRUE(again.changed);
    EXPECT_TRUE(again.timer_preset);
}

TEST(Engine, EffectOfAJumpToTheOwnStepIsNone) {
    Bench bench({{0xC0, 0, 0, 0x00, 0x80, 0, 0, 0}});
    EXPECT_FALSE(bench.scan().any());
}

TEST(Engine, KeyIsImageAndTheTwoZeros) {
    Bench bench({});
    EXPECT_EQ(bench.engine.key(0xA5), 0x3A5);
    bench.engine.restore({.timer = 1});
    EXPECT_EQ(bench.engine.key(0xA5), 0x2A5);
    bench.engine.restore({.counter = 1});
    EXPECT_EQ(bench.engine.key(0xA5), 0x1A5);
}

// 001 §6.1.9: what the scan before left half done is no part of the state that the sequence goes on from.
TEST(Engine, RestoreDropsAScanUnderWay) {
    Bench bench({{0x00, 0x00, 0x00, 0x05, 0x0C, 0x00, 0x00, 0x00}});
    bench.engine.begin(0);
    ASSERT_EQ(bench.engine.next(), fast(0x0C));
    bench.engine.restore({.step = 7});
    EXPECT_EQ(bench.engine.next(), std::nullopt);
    const ScanEffect effect = bench.engine.finish();
    EXPECT_FALSE(effect.sent);
    EXPECT_FALSE(effect.changed);
    EXPECT_EQ(bench.state(), (State{.step = 7}));
}

TEST(Engine, AScanInPartsTellsTheSameEffect) {
    Bench bench({{0x00, 0x00, 0x00, 0x05, 0x0C, 0x00, 0x00, 0x00}});
    bench.engine.begin(0);
    while (bench.engine.next()) {
    }
    const ScanEffect effect = bench.engine.finish();
    EXPECT_TRUE(effect.sent);
    EXPECT_TRUE(effect.changed);
    EXPECT_FALSE(effect.timer_preset);
}

// 001 §6.1.7: a command is one byte, and the shortest preset 1 ms.
TEST(Engine, ACommandIsNoRegisterWriteAndOneMillisecondIsAPreset) {
    Bench bench({{0xC0, 0x00, 0x00, 0x3E, 0x0C, 0x00, 0x01, 0x00}});
    EXPECT_TRUE(bench.scan().timer_preset);
    ASSERT_EQ(bench.orders.size(), 1U);
    EXPECT_FALSE(bench.orders[0].is_register_write);
    EXPECT_FALSE(bench.orders[0].longword);
    EXPECT_EQ(bench.orders[0].reg, 0);
    EXPECT_EQ(bench.orders[0].value, 0U);
    bench.engine.begin(0);
    while (bench.engine.next()) {
    }
    EXPECT_TRUE(bench.engine.finish().timer_preset);
}

TEST(Engine, WithoutAScanNothingHasAnEffect) {
    const Bytes bytes = table_of({});
    const Table table = Table::load(bytes).table;
    Engine engine(table);
    const ScanEffect effect = engine.finish();
    EXPECT_FALSE(effect.any());
    EXPECT_FALSE(effect.timer_preset);
}

TEST(Engine, AnyEffectIsAChangeOrAnOrder) {
    EXPECT_FALSE((ScanEffect{}.any()));
    EXPECT_TRUE((ScanEffect{.changed = true}.any()));
    EXPECT_TRUE((ScanEffect{.sent = true}.any()));
}

// Fill three boxes: IN0 starts; each IN_POS counts one down and waits 20 ms; at 0 output 3 signals done.
TEST(Engine, WalkThroughFillAndCount) {
    Bench bench({
        {0xC0, 0x01, 0x01, 0x41, 0x80, 0x00, 0x03, 0x00},  // 0: IN0 -> 1, counter 3
        {0xC1, 0x00, 0x00, 0x02, 0x0C, 0x01, 0x00, 0x00},  // 1: -> 2, send 0Ch, OUT0
        {0xC2, 0x40, 0x40, 0x03, 0x80, 0x80, 0x14, 0x00},  // 2: IN_POS -> 3, count down, timer 20 ms
        {0x43, 0x00, 0x00, 0x01, 0x80, 0x00, 0x00, 0x00},  // 3: timer 0 -> 1
        {0x03, 0x00, 0x00, 0x04, 0x80, 0x08, 0x00, 0x00},  // 3: timer 0, counter 0 -> 4, OUT3 (last one wins)
    });
    bench.scan(0);
    EXPECT_EQ(bench.state(), State{});
    bench.scan(1);
    EXPECT_EQ(bench.state(), (State{1, 0, 0, 3}));
    for (std::uint16_t left = 2;; --left) {
        bench.scan(0);
        EXPECT_EQ(bench.orders, std::vector{fast(0x0C)});
        EXPECT_EQ(bench.state(), (State{2, 1, 0, static_cast<std::uint16_t>(left + 1)}));
        bench.scan(0);
        EXPECT_EQ(bench.state().step, 2);
        bench.scan(0x40);
        EXPECT_EQ(bench.state(), (State{3, 0, 20, left}));
        bench.engine.elapse(19);
        bench.scan(0);
        EXPECT_EQ(bench.state(), (State{3, 0, 1, left}));
        bench.engine.elapse(1);
        bench.scan(0);
        if (left == 0) break;
        EXPECT_EQ(bench.state(), (State{1, 0, 0, left}));
    }
    EXPECT_EQ(bench.state(), (State{4, 8, 0, 0}));
}

}  // namespace
}  // namespace nplc::sequencer
