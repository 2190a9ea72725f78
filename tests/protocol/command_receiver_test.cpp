#include "protocol/fastmac.h"

#include <gtest/gtest.h>

#include <optional>

namespace nplc::protocol::fastmac {
namespace {

using Accepted = std::optional<std::uint8_t>;

constexpr Accepted kNothing;

// 001 §5.2.1.3: the example's bytes, each with the other toggle; a repeat does nothing.
TEST(CommandReceiver, TakesEachNewToggleOnce) {
    CommandReceiver receiver;
    EXPECT_FALSE(receiver.toggle());
    EXPECT_EQ(receiver.receive(0xE0), Accepted(0x60));
    EXPECT_TRUE(receiver.toggle());
    EXPECT_EQ(receiver.receive(0xE0), kNothing);
    EXPECT_EQ(receiver.receive(0x63), Accepted(0x63));
    EXPECT_FALSE(receiver.toggle());
    EXPECT_EQ(receiver.receive(0x63), kNothing);
    EXPECT_EQ(receiver.receive(0x95), Accepted(0x15));
}

TEST(CommandReceiver, ToggleIsZeroAtPowerUp) {
    CommandReceiver receiver;
    EXPECT_EQ(receiver.receive(0x62), kNothing);
    EXPECT_FALSE(receiver.toggle());
    EXPECT_EQ(receiver.receive(0xE2), Accepted(0x62));
}

// The start of a master without the toggle's state: a NOP in each polarity brings both ends in step.
TEST(CommandReceiver, NopInEachPolarityBringsInStep) {
    for (const bool before : {false, true}) {
        CommandReceiver receiver;
        if (before) receiver.accept_other();
        receiver.receive(0x60);
        receiver.receive(0xE0);
        EXPECT_TRUE(receiver.toggle());
        EXPECT_EQ(receiver.receive(0x45), Accepted(0x45));
    }
}

TEST(CommandReceiver, SafeNeedsTwoEqualBytes) {
    CommandReceiver receiver;
    receiver.set_safe(true);
    EXPECT_EQ(receiver.receive(0xE0), kNothing);
    EXPECT_FALSE(receiver.toggle());
    EXPECT_EQ(receiver.receive(0xE0), Accepted(0x60));
    EXPECT_TRUE(receiver.toggle());
}

TEST(CommandReceiver, SafeThirdEqualByteDoesNothing) {
    CommandReceiver receiver;
    receiver.set_safe(true);
    receiver.receive(0xC5);
    EXPECT_EQ(receiver.receive(0xC5), Accepted(0x45));
    EXPECT_EQ(receiver.receive(0xC5), kNothing);
    EXPECT_EQ(receiver.receive(0xC5), kNothing);
    EXPECT_TRUE(receiver.toggle());
    EXPECT_EQ(receiver.receive(0x44), kNothing);
    EXPECT_EQ(receiver.receive(0x44), Accepted(0x44));
}

TEST(CommandReceiver, SafeRefusesEveryDamagedByte) {
    for (int place = 0; place < 2; ++place) {
        for (int damaged = 0; damaged < 256; ++damaged) {
            if (damaged == 0xC5) continue;
            CommandReceiver receiver;
            receiver.set_safe(true);
            const auto d = static_cast<std::uint8_t>(damaged);
            EXPECT_EQ(receiver.receive(place == 0 ? d : 0xC5), kNothing);
            EXPECT_EQ(receiver.receive(place == 1 ? d : 0xC5), kNothing);
        }
    }
}

// One byte of the first command is lost; neither half makes a pair with the next, and that one's toggle is
// the old one.
TEST(CommandReceiver, SafeLostByteMakesNoPair) {
    CommandReceiver receiver;
    receiver.set_safe(true);
    EXPECT_EQ(receiver.receive(0xC5), kNothing);
    EXPECT_EQ(receiver.receive(0x44), kNothing);
    EXPECT_EQ(receiver.receive(0x44), kNothing);
    EXPECT_FALSE(receiver.toggle());
}

TEST(CommandReceiver, FramingErrorOrPauseBreaksThePair) {
    CommandReceiver receiver;
    receiver.set_safe(true);
    EXPECT_EQ(receiver.receive(0xE0), kNothing);
    receiver.break_pair();
    EXPECT_EQ(receiver.receive(0xE0), kNothing);
    EXPECT_EQ(receiver.receive(0xE0), Accepted(0x60));
}

TEST(CommandReceiver, ChangeOfSafetyBreaksThePair) {
    CommandReceiver receiver;
    EXPECT_EQ(receiver.receive(0xEB), Accepted(0x6B));  // 0Bh, safe communication, in rapid communication
    receiver.set_safe(true);
    EXPECT_TRUE(receiver.safe());
    EXPECT_EQ(receiver.receive(0x60), kNothing);
    receiver.set_safe(true);
    EXPECT_EQ(receiver.receive(0x60), kNothing);
    EXPECT_EQ(receiver.receive(0x60), Accepted(0x60));
    receiver.set_safe(false);
    EXPECT_EQ(receiver.receive(0xE0), Accepted(0x60));
}

// 001 §5.2.2: one toggle for both protocols. The byte before the FlexMAC messages is no half of a pair after
// them.
TEST(CommandReceiver, FlexMacMessageTogglesAndBreaksThePair) {
    CommandReceiver receiver;
    receiver.set_safe(true);
    receiver.receive(0xFF);
    EXPECT_EQ(receiver.receive(0xFF), Accepted(0x7F));
    EXPECT_TRUE(receiver.toggle());
    receiver.accept_other();
    EXPECT_FALSE(receiver.toggle());
    EXPECT_EQ(receiver.receive(0xFF), kNothing);
    EXPECT_FALSE(receiver.toggle());
}

}  // namespace
}  // namespace nplc::protocol::fastmac
