// A line with one client, as a board without an operating system has it: what a listener sees to where there
// are many holds there without one (firmware/boards/README.md).
#include <gtest/gtest.h>

#include "base/crc32.h"
#include "port_bench.h"

namespace nplc::gateway {
namespace {

using reg::Command;
using reg::Result;

const Bytes kOneClientsTable{{0xC0, 0x01, 0x01, 0x01, 0x40, 0x05, 0, 0},
                             {0xC1, 0x02, 0x02, 0x00, 0x80, 0x00, 0, 0}};
const Bytes kAnotherTable{{0xC0, 0, 0, 0x3E, 0x80, 0x0F, 0, 0}};

struct OneClient : testing::Test, PortBench {
    OneClient() : PortBench({.safe_outputs = 0x02, .autostart = false}) {}

    void send(Command what) {
        ask({.kind = mactalk::Kind::write,
             .address = reg::kDefaultAddress,
             .reg = reg::COMMAND,
             .length = 4,
             .value = static_cast<std::uint32_t>(what)});
    }
};

TEST_F(OneClient, WhatArrivedIsReadAtTheNextPollAndInItsOrder) {
    ASSERT_TRUE(upload_and_activate(kOneClientsTable));
    send(Command::run);
    send(Command::stop);
    poll();
    EXPECT_TRUE(line.received.empty());
    run(1s);
    EXPECT_EQ(gateway->run_state(), RunState::stopped);
    EXPECT_EQ(gateway->scans(), 0U);
    EXPECT_EQ(gateway->safe_reason(), SafeReason::stop_command);
}

TEST_F(OneClient, AStopEndsWhatStillWaits) {
    for (const Command waits : {Command::activate, Command::reset}) {
        ASSERT_TRUE(upload_and_activate(kOneClientsTable));
        ASSERT_TRUE(upload(kAnotherTable));
        send(waits);
        run(20ms);
        for (const Command stop : {Command::stop, Command::safe, Command::hold}) {
            send(stop);
            run(3ms);
        }
        run(2s);
        EXPECT_EQ(tables->active_crc(), base::crc32(kOneClientsTable)) << static_cast<int>(waits);
        EXPECT_FALSE(controller->reset_asked());
    }
}

TEST_F(OneClient, AHoldWithNothingToHoldSaysSo) {
    ASSERT_TRUE(upload_and_activate(kOneClientsTable));
    EXPECT_FALSE(command(Command::hold));
    EXPECT_EQ(result(), result_of(Result::not_running, reg::COMMAND));
    ASSERT_TRUE(command(Command::run));
    run(100ms);
    EXPECT_EQ(gateway->run_state(), RunState::running) << "and holds nothing later";
}

TEST_F(OneClient, OneMessageAtATimeWaits) {
    ASSERT_TRUE(upload_and_activate(kOneClientsTable));
    ASSERT_TRUE(upload(kAnotherTable));
    line.sent.clear();
    for (int i = 0; i < 20; ++i) send(Command::activate);
    run(2s);
    EXPECT_EQ(line.sent, accept()) << "of the last one alone";
    EXPECT_EQ(tables->active_crc(), base::crc32(kAnotherTable));
}

TEST_F(OneClient, ItsSilenceEndsItsForces) {
    ASSERT_TRUE(write(reg::FORCE_OUT, 0x0101));
    ASSERT_TRUE(write(reg::FORCE_IN, 0x0101));
    run(4s);
    EXPECT_TRUE(gateway->forces().any());
    ASSERT_TRUE(write(reg::FORCE_LEFT, 0));
    run(4s);
    EXPECT_TRUE(gateway->forces().any());
    EXPECT_TRUE(read(reg::FORCE_LEFT)) << "a read is none of its signs of life";
    run(1s);
    EXPECT_FALSE(gateway->forces().any());
}

}  // namespace
}  // namespace nplc::gateway
