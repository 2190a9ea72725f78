#pragma once

#include "sim/mac_motor.h"
#include "sim_wire.h"

namespace nplc::mactalk_client {

/// A virtual motor's MacTalk end, which can be made slow and deaf.
class MotorUnit final : public Unit {
  public:
    explicit MotorUnit(registers::Model model = registers::Model::mac140, std::uint8_t address = 8)
        : motor(model, {.address = address}) {}

    void receive(std::uint8_t byte, bool framing_error, base::Instant now) override {
        motor.receive_mactalk(byte, framing_error);
        if (!held_ && delay.count() > 0) held_ = now + delay;
    }
    std::optional<std::uint8_t> transmit(base::Instant now) override {
        if (held_ && now < *held_) return std::nullopt;
        const auto byte = motor.transmit_mactalk();
        if (!byte) held_.reset();
        return byte;
    }

    sim::MacMotor motor;
    base::Microseconds delay{0};  ///< of answers, from a message's first byte

  private:
    std::optional<base::Instant> held_;
};

}  // namespace nplc::mactalk_client
