#pragma once

#include "motor_unit.h"

namespace nplc::macreg {

/// A virtual motor that also runs.
class SamplingUnit final : public mactalk_client::Unit {
  public:
    explicit SamplingUnit(registers::Model model) : motor(model, {.address = 8}) {}

    void receive(std::uint8_t byte, bool framing_error, base::Instant /*now*/) override {
        motor.receive_mactalk(byte, framing_error);
    }
    std::optional<std::uint8_t> transmit(base::Instant /*now*/) override { return motor.transmit_mactalk(); }
    void poll(base::Instant now) override {
        for (; next_ <= now.time_since_epoch(); next_ += motor.sample_period()) motor.sample();
    }

    sim::MacMotor motor;

  private:
    std::chrono::nanoseconds next_{0};
};

}  // namespace nplc::macreg
