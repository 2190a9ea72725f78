// The journal's messages on forces.
#include "force_messages.h"

#include <gtest/gtest.h>

#include "registers/gateway.h"

namespace nplc::boards {
namespace {

using registers::gateway::Event;

struct Forcing {
    std::string write(std::uint8_t reg, std::uint8_t mask) {
        const gateway::Force force{.mask = mask};
        reg == registers::gateway::FORCE_IN ? io.set_inputs(force, {}) : io.set_outputs(force, {});
        return said(Event::forced, reg);
    }
    std::string said(Event event, std::uint16_t detail) {
        gateway::EventLog::Entry entry{};
        entry.event = static_cast<std::uint8_t>(event);
        entry.detail = detail;
        const auto message = messages.message(entry, io);
        return message ? message->text : std::string();
    }

    gateway::ForcedIo io;
    ForceMessages messages;
};

constexpr std::uint8_t kIn = registers::gateway::FORCE_IN;
constexpr std::uint8_t kOut = registers::gateway::FORCE_OUT;

TEST(ForceMessages, AWriteThatForcesNothingIsNoForce) {
    Forcing forcing;
    EXPECT_EQ(forcing.write(kIn, 0), "");
    EXPECT_EQ(forcing.write(kOut, 0), "");
    EXPECT_EQ(forcing.write(kIn, 1), "signals are forced over the user's port");
    EXPECT_EQ(forcing.write(kOut, 0), "");
    EXPECT_EQ(forcing.write(kIn, 3), "signals are forced over the user's port");
    EXPECT_EQ(forcing.write(kIn, 0), "forcing of inputs has ended");
    EXPECT_EQ(forcing.write(kIn, 0), "");
    EXPECT_EQ(forcing.write(kOut, 8), "signals are forced over the user's port");
    EXPECT_EQ(forcing.write(kOut, 0), "forcing of outputs has ended");
}

TEST(ForceMessages, WhatHasEndedBySilenceEndsOnce) {
    Forcing forcing;
    forcing.write(kIn, 1);
    forcing.io.end();
    EXPECT_EQ(forcing.said(Event::forces_ended, 1), "forcing has ended: its client is silent");
    EXPECT_EQ(forcing.write(kIn, 0), "");
}

}  // namespace
}  // namespace nplc::boards
