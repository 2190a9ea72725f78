// What a step does in each case, from its bytes, against the machine that runs them and against a reading of
// our own; what orders do to a motion, against the manual's list.

#include <gtest/gtest.h>

#include "compiler/truth.h"
#include "random_table.h"
#include "sequencer/engine.h"
#include "table/orders.h"
#include "table/step.h"

namespace nplc::seqc {
namespace {

using sequencer::Engine;
using sequencer::MotorOrder;
using sequencer::State;
using table::CounterChange;
using table::MotionEffect;
using table::OrderKind;
using table::Outcome;

std::string in_short(const MotorOrder& order) {
    char text[40];
    if (!order.is_register_write) {
        std::snprintf(text, sizeof text, "%02X", order.command);
    } else {
        std::snprintf(text, sizeof text, "%d=%u%s", order.reg, order.value, order.longword ? "L" : "");
    }
    return text;
}

/// A state in which the conditions of case `c` hold.
State state_in(std::size_t c, std::uint8_t step, std::uint8_t outputs) {
    State state{.step = step, .outputs = outputs};
    state.timer = ((c >> kTimerZero) & 1) != 0 ? 0 : 100;
    state.counter = ((c >> kCounterZero) & 1) != 0 ? 0 : 100;
    return state;
}

State after(const Outcome& outcome, State state) {
    outcome.apply(state);
    return state;
}

TEST(Scan, DoesWhatTheEngineDoes) {
    constexpr unsigned kSeed = 31;
    constexpr unsigned kSteps = 4;
    test::Random random(kSeed);
    std::size_t acted = 0;
    for (int round = 0; round < 200; ++round) {
        const auto table = test::random_table(random, kSteps, 1 + random() % 40);
        const auto loaded = sequencer::Table::load(table);
        ASSERT_TRUE(loaded.ok);
        Engine engine(loaded.table);
        for (std::uint8_t step = 0; step < kSteps; ++step) {
            const table::Step behaviour = table::step_of(step, table::terms_of(table));
            EXPECT_EQ(static_cast<int>(behaviour.terms), test::terms_of(table, step));
            for (std::size_t c = 0; c < kCases; ++c) {
                const State before = state_in(c, step, static_cast<std::uint8_t>(random() % 16));
                engine.restore(before);
                std::vector<MotorOrder> orders;
                engine.scan(static_cast<std::uint8_t>(c), [&](const MotorOrder& o) { orders.push_back(o); });
                const Outcome& outcome = behaviour.in(c);
                ASSERT_EQ(after(outcome, before), engine.state()) << "seed " << kSeed << ", round " << round;
                ASSERT_EQ(outcome.orders, orders) << "seed " << kSeed << ", round " << round;
                if (engine.state() != before || !orders.empty()) ++acted;
            }
        }
    }
    EXPECT_GT(acted, 200U * 1024U);
}

TEST(Scan, DoesWhatTheBytesSay) {
    constexpr unsigned kSeed = 32;
    test::Random random(kSeed);
    for (int round = 0; round < 60; ++round) {
        const auto table = test::random_table(random, 3, 1 + random() % 30);
        for (std::uint8_t step = 0; step < 3; ++step) {
            const table::Step behaviour = table::step_of(step, table::terms_of(table));
            for (unsigned c = 0; c < kCases; ++c) {
                const Outcome& outcome = behaviour.in(c);
                const test::Scan scan = test::scan_case(table, step, c);
                std::vector<std::string> sends;
                for (const MotorOrder& order : outcome.orders) sends.push_back(in_short(order));
                ASSERT_EQ(sends, scan.sends) << "seed " << kSeed << ", round " << round << ", case " << c;
                ASSERT_EQ(outcome.next, scan.next.value_or(step));
                ASSERT_EQ(outcome.outputs.has_value(), scan.outputs.has_value());
                ASSERT_EQ(outcome.outputs.value_or(0), scan.outputs.value_or(0));
                ASSERT_EQ(outcome.timer, scan.timer.value_or(0));
                // Clear beats preset beats count-down.
                const CounterChange change = scan.clears    ? CounterChange::clear
                                             : scan.counter ? CounterChange::preset
                                             : scan.counts  ? CounterChange::count_down
                                                            : CounterChange::none;
                ASSERT_EQ(outcome.counter, change);
                ASSERT_EQ(outcome.counter_preset, change == CounterChange::preset ? *scan.counter : 0);
            }
        }
    }
}

/// 001 §5.2.1.4: bits 6..5 the mode, bits 4..0 a register or a number.
TEST(Orders, DoToAMotionWhatTheManualSays) {
    const auto effect_of = [](unsigned command) {
        return table::effect_of(table::kind_of(MotorOrder{.command = static_cast<std::uint8_t>(command)}));
    };
    for (unsigned rest = 0; rest < 32; ++rest) {
        EXPECT_EQ(effect_of(rest), MotionEffect::init);
        EXPECT_EQ(effect_of(0x20 + rest), MotionEffect::run);
        EXPECT_EQ(effect_of(0x40 + rest), rest < 8 ? MotionEffect::place : MotionEffect::hold);
        const bool moves =
            rest == 8 || rest == 9 || (rest >= 0x0C && rest <= 0x0F) || rest == 0x11 || rest == 0x12;
        const MotionEffect wanted = moves                    ? MotionEffect::place
                                    : rest == 2 || rest == 4 ? MotionEffect::target
                                    : rest == 5              ? MotionEffect::stop
                                    : rest == 0x10           ? MotionEffect::home
                                                             : MotionEffect::none;
        EXPECT_EQ(effect_of(0x60 + rest), wanted) << rest;
    }
}

/// 001 §3.2.2 and §4.4: with these values of MODE_REG the motor sets IN_POS.
TEST(Orders, KnowTheModes) {
    for (std::uint32_t mode = 0; mode < 30; ++mode) {
        const MotorOrder order{.is_register_write = true, .reg = 2, .value = mode};
        const OrderKind kind = table::kind_of(order);
        const bool in_position =
            mode == 1 || mode == 2 || mode == 3 || (mode >= 17 && mode <= 21) || mode == 24;
        const bool homes = mode >= 12 && mode <= 14;
        EXPECT_EQ(table::is_silent(kind), !in_position && !homes && mode != 0) << mode;
        EXPECT_EQ(table::outlasts_stop(table::effect_of(kind)),
                  homes || mode == 4 || (mode >= 7 && mode <= 10) || mode == 22 || mode == 23)
            << mode;
    }
}

TEST(Orders, KnowTheRegistersTheyUse) {
    EXPECT_EQ(table::selected_register({.command = 0x47}), 63);  // POSITION(P8)
    EXPECT_EQ(table::velocity_taken({.command = 0x29}), 66);     // VELOCITY(V2)
    EXPECT_EQ(table::velocity_taken({.command = 0x6F}), 68);     // USE_SET(4)
    EXPECT_EQ(table::velocity_taken({.command = 0x65}), 0);
    EXPECT_EQ(table::velocity_taken({.is_register_write = true, .reg = 44, .value = 3}), 67);
    EXPECT_TRUE(table::may_reset_error({.command = 0x61}));
    EXPECT_TRUE(table::may_reset_error({.is_register_write = true, .reg = 35}));
    EXPECT_TRUE(table::may_reset_error({.is_register_write = true, .reg = 34, .longword = true}));
    EXPECT_FALSE(table::may_reset_error({.is_register_write = true, .reg = 34}));
}

}  // namespace
}  // namespace nplc::seqc
