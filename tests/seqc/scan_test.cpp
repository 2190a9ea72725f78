// What a step does in each case, from its bytes, against the machine that runs them and against a reading of
// our own.
#include "lowering/scan.h"

#include <gtest/gtest.h>

#include "random_table.h"
#include "sequencer/engine.h"

namespace nplc::seqc {
namespace {

using sequencer::Engine;
using sequencer::MotorOrder;
using sequencer::State;

std::vector<sequencer::TermView> terms_of(const std::vector<std::uint8_t>& table) {
    std::vector<sequencer::TermView> terms;
    for (std::size_t at = 0; at < table.size(); at += sequencer::kTermBytes)
        terms.push_back(std::span(table).subspan(at).first<sequencer::kTermBytes>());
    return terms;
}

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

State after(const ScanResult& outcome, State state) {
    state.step = outcome.next;
    state.outputs = outcome.outputs.value_or(state.outputs);
    if (outcome.timer != 0) state.timer = outcome.timer;
    if (outcome.counter == CounterChange::clear) state.counter = 0;
    if (outcome.counter == CounterChange::preset) state.counter = outcome.counter_preset;
    if (outcome.counter == CounterChange::count_down && state.counter != 0) --state.counter;
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
            const StepBehaviour behaviour = behaviour_of(step, terms_of(table));
            EXPECT_EQ(static_cast<int>(behaviour.terms), test::terms_of(table, step));
            for (std::size_t c = 0; c < kCases; ++c) {
                const State before = state_in(c, step, static_cast<std::uint8_t>(random() % 16));
                engine.restore(before);
                std::vector<MotorOrder> orders;
                engine.scan(static_cast<std::uint8_t>(c), [&](const MotorOrder& o) { orders.push_back(o); });
                const ScanResult& outcome = behaviour.in(c);
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
            const StepBehaviour behaviour = behaviour_of(step, terms_of(table));
            for (unsigned c = 0; c < kCases; ++c) {
                const ScanResult& outcome = behaviour.in(c);
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

}  // namespace
}  // namespace nplc::seqc
