#pragma once

#include <vector>

#include "macreg/motor.h"
#include "sim/mac_motor.h"
#include "sim_wire.h"

namespace nplc::macreg {

/// Virtual motors on a MacTalk line that run while time passes. Answers of several at once are joined as open
/// collectors do: a 0 of either wins.
class Units final : public mactalk_client::Unit {
  public:
    sim::MacMotor& add(registers::Model model, std::uint8_t address) {
        motors_.push_back(std::make_unique<Runner>(model, address));
        return motors_.back()->motor;
    }
    void receive(std::uint8_t byte, bool framing_error, base::Instant) override {
        if (dead) return;
        if (bytes_to_live > 0 && --bytes_to_live == 0) dead = true;
        for (auto& one : motors_) one->motor.receive_mactalk(byte, framing_error);
    }
    std::optional<std::uint8_t> transmit(base::Instant) override {
        std::optional<std::uint8_t> sum;
        for (auto& one : motors_) {
            const auto byte = one->motor.transmit_mactalk();
            if (byte) sum = sum ? *sum & *byte : *byte;
        }
        return dead ? std::nullopt : sum;
    }
    void poll(base::Instant now) override {
        for (auto& one : motors_) {
            for (; one->next <= now.time_since_epoch(); one->next += one->motor.sample_period())
                one->motor.sample();
        }
    }

    bool dead = false;
    std::size_t bytes_to_live = 0;  ///< received until it is dead; 0: no end

  private:
    struct Runner {
        Runner(registers::Model model, std::uint8_t address)
            : motor(model, {.address = address, .depth = sim::Servo::Depth::outer_loop}) {}
        sim::MacMotor motor;
        std::chrono::nanoseconds next{0};
    };
    std::vector<std::unique_ptr<Runner>> motors_;
};

inline constexpr std::uint8_t kAddress = 8;

/// One motor, and a client of it.
struct Bench {
    explicit Bench(registers::Model model = registers::Model::mac140, std::uint64_t seed = 1)
        : sim(units.add(model, kAddress)),
          wire(units, 19'200, seed),
          master(wire),
          motor(master, kAddress, model) {}

    void run(base::Milliseconds time) { master.pause(time); }
    std::int64_t at(std::string_view name) const {
        return sim.read(registers::find(motor.model(), name)->number);
    }
    /// In the motor's memory, as a line would write it.
    void put(std::string_view name, std::int64_t raw) {
        sim.write(registers::find(motor.model(), name)->number, static_cast<std::int32_t>(raw));
    }
    const registers::Register& reg(std::string_view name) const {
        return *registers::find(motor.model(), name);
    }

    Units units;
    sim::MacMotor& sim;
    mactalk_client::SimWire wire;
    mactalk_client::Master master;
    Motor motor;
};

}  // namespace nplc::macreg
