#pragma once

#include <gtest/gtest.h>

#include "motor/jvl_motor.h"
#include "scripted_line.h"

namespace nplc::motor {

inline Order command(std::uint8_t byte) {
    return {.command = byte};
}
inline Order write(std::uint8_t reg, std::uint16_t value) {
    return {.is_register_write = true, .reg = reg, .value = value};
}

struct MotorTest : testing::Test {
    ScriptedLine line;
    JvlMotor driver{line, {}};
    Script<JvlMotor> motor{line, driver};

    /// Lets the motor answer `before` until the driver has sent `bytes`, then `after` twice.
    void exchange(const Bytes& bytes, std::uint8_t before, std::uint8_t after) {
        for (int i = 0; i < 20 && line.sent.size() < bytes.size(); ++i) motor.hear(before);
        EXPECT_EQ(line.take(), bytes);
        for (std::size_t i = 0; i < bytes.size() && line.in_transmitter != 0; ++i) motor.hear(before);
        motor.hear(after);
        motor.hear(after);
    }
    /// Whatever the toggle `status` shows: safe communication and a NOP, both in each polarity. Ends as it
    /// began.
    void come_up(std::uint8_t status) {
        const auto other = static_cast<std::uint8_t>(status ^ 0x80);
        const auto byte = [&](int command, std::uint8_t shown) {
            return static_cast<std::uint8_t>(command | (~shown & 0x80));
        };
        for (const int command : {0x6B, 0x60}) {
            exchange({byte(command, status), byte(command, status)}, status, other);
            exchange({byte(command, other), byte(command, other)}, other, status);
        }
    }
    void start() {
        motor.hear_times(2, 0x80);
        come_up(0x80);
        ASSERT_EQ(driver.link(), Link::up);
        ASSERT_TRUE(driver.orders_complete());
    }
};

}  // namespace nplc::motor
