#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <memory>
#include <vector>

#include "protocol/fastmac.h"
#include "sim/mac_motor.h"

namespace nplc::sim {

/// A motor on a 19200 baud line in virtual time: every character takes 10 bits, both directions run at once,
/// samples come at the motor's own period.
class MotorBench {
    std::unique_ptr<MacMotor> owned_;  // so that a bench can be moved

  public:
    explicit MotorBench(registers::Model model = registers::Model::mac140,
                        const MacMotorOptions& options = {})
        : owned_(std::make_unique<MacMotor>(model, options)),
          motor(*owned_),
          character_(std::chrono::nanoseconds(10'000'000'000 / options.baud)) {}

    void send(std::initializer_list<int> bytes) {
        for (const int byte : bytes) send_one(static_cast<std::uint8_t>(byte));
    }
    void send_one(std::uint8_t byte, bool framing_error = false) {
        pass_character();
        motor.receive(byte, framing_error, at());
    }
    /// A FastMAC command with the next toggle.
    void command(std::uint8_t bits) {
        toggle_ = !motor.link().toggle();
        send_one(protocol::fastmac::with_toggle(bits, toggle_));
    }
    void command(protocol::fastmac::Number number) { command(protocol::fastmac::command_byte(number)); }
    void pause(int characters) {
        for (int i = 0; i < characters; ++i) pass_character();
    }
    void samples(int count) {
        for (int i = 0; i < count; ++i) {
            next_sample_ += motor.sample_period();
            motor.sample();
        }
        now_ = std::max(now_, next_sample_);
    }
    /// Samples until IN_POS, at most `limit`; answers how many it took, or fails the test.
    int until_in_position(int limit = 20'000) {
        for (int i = 1; i <= limit; ++i) {
            samples(1);
            if (motor.in_position()) return i;
        }
        ADD_FAILURE() << "not in position after " << limit << " samples: P_IST " << motor.p_ist();
        return limit;
    }
    /// Samples without a deadline in the motion's favour: long enough for the last count, which friction
    /// holds.
    void settle() { samples(3000); }

    std::uint8_t status() {
        sent.clear();
        pass_character();
        return sent.empty() ? 0 : sent.back();
    }
    std::int32_t reg(int number) const { return motor.read(static_cast<std::uint8_t>(number)); }
    void set(int number, std::int32_t value) { motor.write(static_cast<std::uint8_t>(number), value); }
    base::Instant at() const { return base::Instant(std::chrono::duration_cast<base::Microseconds>(now_)); }

    MacMotor& motor;
    std::vector<std::uint8_t> sent;  ///< by the motor

  private:
    void pass_character() {
        if (const auto byte = motor.transmit(at())) sent.push_back(*byte);
        now_ += character_;
        while (next_sample_ + motor.sample_period() <= now_) {
            next_sample_ += motor.sample_period();
            motor.sample();
        }
    }

    std::chrono::nanoseconds character_;
    std::chrono::nanoseconds now_{0};
    std::chrono::nanoseconds next_sample_{0};
    bool toggle_ = false;
};

}  // namespace nplc::sim
