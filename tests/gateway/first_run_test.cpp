// A sequence starts by itself only from a store that records a commanded run; the record is written before
// the first scan of that run.
#include <gtest/gtest.h>

#include <iostream>
#include <utility>

#include "port_bench.h"

namespace nplc::gateway {
namespace {

using reg::Command;
using store::Setting;

// Step 0: IN0 -> step 1 with outputs 5, sends 40h (P1). Step 1: IN1 -> step 0, outputs 0.
const Bytes kFirstTable{{0xC0, 0x01, 0x01, 0x01, 0x40, 0x05, 0, 0},
                        {0xC1, 0x02, 0x02, 0x00, 0x80, 0x00, 0, 0}};
constexpr Settings kStartsByItself{.safe_outputs = 0x02, .autostart = true};
constexpr std::uint32_t kNewStore = 8;  // STORE_FLAGS

struct FirstRun : testing::Test, PortBench {
    FirstRun() : PortBench(kStartsByItself) {
        keeps_mark = true;
        restart();
    }

    void restart(StartCause why = StartCause::power_up) {
        cause = why;
        start(kStartsByItself);
        run(10ms);
    }
    void keep(Setting setting, std::uint32_t value) {
        ASSERT_TRUE(write(reg::register_of(setting), value));
        ASSERT_TRUE(command(Command::keep_settings));
    }
    bool runs() const { return gateway->run_state() == RunState::running; }
    void run_once() {
        ASSERT_TRUE(command(Command::run));
        ASSERT_TRUE(command(Command::stop));
    }
    /// The command, and what it waits for, without the client that receives its answer.
    void ask_to_run() {
        ask({.kind = mactalk::Kind::write,
             .address = reg::kDefaultAddress,
             .reg = reg::COMMAND,
             .length = 4,
             .value = static_cast<std::uint32_t>(Command::run)});
    }
};

TEST_F(FirstRun, ANewStoreWaitsForIt) {
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    for (int i = 0; i < 3; ++i) {
        restart();
        EXPECT_FALSE(runs());
        EXPECT_EQ(read(reg::STORE_FLAGS), kNewStore);
        EXPECT_EQ(read(reg::SAFE_REASON), 1U) << "not started";
    }
    ASSERT_TRUE(command(Command::run));
    run(5ms);
    EXPECT_TRUE(runs());
    EXPECT_EQ(read(reg::STORE_FLAGS), 0U);
    restart();
    EXPECT_TRUE(runs());
    flash = sim::SimStorage(kFlash);
    restart();
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    restart();
    EXPECT_FALSE(runs()) << "erased";
    EXPECT_EQ(read(reg::STORE_FLAGS), kNewStore);
}

TEST_F(FirstRun, ABoardThatKnowsWhatWasThereSaysSoUntilTheRun) {
    for (const auto& [trace, flags] :
         {std::pair{StoreTrace::lost, 8U | 16U}, {StoreTrace::anothers, 8U | 32U}}) {
        flash = sim::SimStorage(kFlash);
        restart();
        controller->registers().store_traces().note(trace);
        EXPECT_EQ(read(reg::STORE_FLAGS), flags);
        ASSERT_TRUE(command(Command::stop));
        EXPECT_EQ(read(reg::STORE_FLAGS), flags);
        ASSERT_TRUE(upload_and_activate(kFirstTable));
        ASSERT_TRUE(command(Command::run));
        EXPECT_EQ(read(reg::STORE_FLAGS), 0U);
    }
}

TEST_F(FirstRun, AScanAndAStepAreRunsToo) {
    for (const Command order : {Command::scan, Command::step}) {
        flash = sim::SimStorage(kFlash);
        restart();
        ASSERT_TRUE(upload_and_activate(kFirstTable));
        ASSERT_TRUE(command(order));
        restart();
        EXPECT_TRUE(runs());
    }
}

TEST_F(FirstRun, WithoutAutostartItWaitsEachTime) {
    keep(Setting::autostart, 0);
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    run_once();
    restart();
    EXPECT_FALSE(runs());
    EXPECT_EQ(read(reg::STORE_FLAGS), 0U);
}

TEST_F(FirstRun, InServiceItIsForTheNextStart) {
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    restart(StartCause::service);
    EXPECT_EQ(read(reg::STORE_FLAGS), kNewStore);
    EXPECT_FALSE(command(Command::run));
    EXPECT_EQ(result(), result_of(reg::Result::not_enabled, reg::COMMAND));
    run(100ms);
    EXPECT_EQ(gateway->run_state(), RunState::stopped);
    EXPECT_EQ(read(reg::STORE_FLAGS), 0U);
    restart();
    EXPECT_TRUE(runs());
}

/// At each of its operations, in every way.
TEST_F(FirstRun, APowerCutBeforeItStandsThereLeavesAMachineThatWaits) {
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    keep(Setting::longest_wait, 700);
    keep(Setting::longest_wait, 800);
    struct Cut {
        sim::SimStorage device;
        bool scanned;
    };
    std::vector<Cut> cuts;
    const std::uint32_t before = gateway->scans();
    flash.watch([&](const sim::StorageOperation& operation) {
        for (const sim::Tear& tear : sim::tears_of(operation, kFlash))
            cuts.push_back({flash.torn(operation, tear), gateway->scans() != before});
    });
    ASSERT_TRUE(command(Command::run));
    run(100ms);
    ASSERT_TRUE(runs());
    flash.watch({});
    unsigned waited = 0;
    unsigned ran = 0;
    for (const Cut& cut : cuts) {
        flash = cut.device;
        restart();
        ++(runs() ? ran : waited);
        EXPECT_FALSE(cut.scanned) << "before it was written";
        EXPECT_EQ(manager->get(Setting::longest_wait), 800U);
    }
    std::cout << cuts.size() << " cuts: " << waited << " wait, " << ran << " had it\n";
    EXPECT_GT(waited, 10U);
    EXPECT_GT(ran, 0U);
}

TEST_F(FirstRun, WhatCannotBeWrittenDoesNotStartAndSaysSo) {
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    keep(Setting::longest_wait, 800);
    run(100ms);
    const sim::SimStorage sound = flash;
    unsigned refused = 0;
    for (std::uint64_t number = 0;; ++number) {
        flash = sound;
        restart();
        flash.fail_operation(number);
        const auto scans = gateway->scans();
        if (command(Command::run)) break;
        ++refused;
        EXPECT_EQ(result(), result_of(reg::Result::storage_failed, reg::COMMAND));
        EXPECT_EQ(read(reg::SAFE_REASON), 10U) << "bad run mark";
        run(1s);
        EXPECT_EQ(gateway->run_state(), RunState::stopped);
        EXPECT_EQ(gateway->scans(), scans);
        EXPECT_EQ(board.out, 0x02);
        EXPECT_TRUE(command(Command::run)) << "it works again";
        run(5ms);
        EXPECT_TRUE(runs());
    }
    EXPECT_GT(refused, 2U);
}

TEST_F(FirstRun, AStopMeanwhileIsAStop) {
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    flash.work_for(1'000);
    ask_to_run();
    run(20ms);
    EXPECT_EQ(gateway->run_state(), RunState::waiting_for_motor);
    EXPECT_TRUE(command(Command::stop));
    run(10s);
    EXPECT_EQ(gateway->run_state(), RunState::stopped);
    EXPECT_EQ(gateway->scans(), 0U);
    EXPECT_EQ(read(reg::SAFE_REASON), 2U);
    EXPECT_TRUE(command(Command::run)) << "it has been written";
    EXPECT_TRUE(runs() || gateway->run_state() == RunState::waiting_for_motor);
}

TEST_F(FirstRun, ItKeepsNoSettings) {
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    keep(Setting::longest_wait, 700);
    ASSERT_TRUE(write(reg::register_of(Setting::longest_wait), 900));
    run_once();
    EXPECT_NE(status() & reg::kSettingsDiffer, 0U);
    restart();
    EXPECT_EQ(manager->get(Setting::longest_wait), 700U);
    EXPECT_TRUE(runs());
}

TEST_F(FirstRun, SettingsThatAreBeingKeptAreKeptWithIt) {
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    ASSERT_TRUE(write(reg::register_of(Setting::longest_wait), 900));
    flash.work_for(20);
    ask({.kind = mactalk::Kind::write,
         .address = reg::kDefaultAddress,
         .reg = reg::COMMAND,
         .length = 4,
         .value = static_cast<std::uint32_t>(Command::keep_settings)});
    run(3ms);
    ASSERT_TRUE(command(Command::run));
    restart();
    EXPECT_EQ(manager->get(Setting::longest_wait), 900U);
    EXPECT_TRUE(runs());
}

TEST_F(FirstRun, NoRegisterGivesIt) {
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    EXPECT_FALSE(write(reg::SETTINGS, 1));
    EXPECT_EQ(result(), result_of(reg::Result::no_register, reg::SETTINGS));
    keep(Setting::longest_wait, 900);
    restart();
    EXPECT_FALSE(runs());
}

TEST_F(FirstRun, ACrashTakesItBackThroughAnyNumberOfOrderlyStarts) {
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    keep(Setting::longest_wait, 900);
    run_once();
    restart(StartCause::watchdog);
    run(100ms);
    for (int i = 0; i < 3; ++i) {
        restart();
        EXPECT_FALSE(runs());
        EXPECT_EQ(read(reg::SAFE_REASON), 6U) << "watchdog";
        EXPECT_EQ(read(reg::STORE_FLAGS), 0U) << "not new";
    }
    const std::uint64_t written = flash.operations();
    restart(StartCause::watchdog);
    run(100ms);
    EXPECT_EQ(flash.operations(), written)
        << "a board that crashes again and again does not wear its memory out";
    run_once();
    restart();
    EXPECT_TRUE(runs());
    EXPECT_EQ(manager->get(Setting::longest_wait), 900U);
}

TEST_F(FirstRun, DamagedSettingsWaitForItToo) {
    ASSERT_TRUE(upload_and_activate(kFirstTable));
    run_once();
    flash.flip(store::Layout(kFlash, kSettings).content(0) + 2, 0);
    restart(StartCause::watchdog);
    EXPECT_EQ(read(reg::SAFE_REASON), 9U) << "bad settings";
    EXPECT_FALSE(command(Command::run));
    run(100ms);
    restart();
    EXPECT_EQ(read(reg::SAFE_REASON), 9U) << "a crash does not hide it";
    ASSERT_TRUE(command(Command::keep_settings));
    EXPECT_EQ(gateway->run_state(), RunState::stopped);
    EXPECT_EQ(read(reg::STORE_FLAGS), kNewStore);
    run_once();
    restart();
    EXPECT_TRUE(runs());
}

}  // namespace
}  // namespace nplc::gateway
