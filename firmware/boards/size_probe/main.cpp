// Holds what a gateway's firmware holds and calls what it calls, so that the size of the image is the size of
// the core. A new part of the core gets an object and a call here.

#include "gateway/gateway.h"
#include "motor/jvl_motor.h"
#include "ports/clock.h"

namespace nplc {
namespace {

// Stand for the chip's registers: what is read from them or ends in them cannot be optimised away.
struct Chip {
    volatile std::uint32_t microseconds;
    volatile std::uint8_t inputs;
    volatile std::uint8_t outputs;
    volatile std::uint8_t line;
    volatile std::uint8_t line_status;
    volatile std::uint8_t watchdog;
    volatile std::uint8_t user_order;
    volatile std::uint8_t user_status;
};
Chip chip;

class Clock final : public ports::Clock {
  public:
    base::Instant now() override { return base::Instant(base::Microseconds(chip.microseconds)); }
};

class Inputs final : public ports::DigitalInputs {
  public:
    std::uint8_t read() override { return chip.inputs; }
};

class Outputs final : public ports::DigitalOutputs {
  public:
    void write(std::uint8_t levels) override { chip.outputs = levels; }
};

class Watchdog final : public ports::Watchdog {
  public:
    void feed() override { chip.watchdog = 1; }
};

class Line final : public ports::SerialPort {
  public:
    std::size_t write(std::span<const std::uint8_t> bytes) override {
        for (const std::uint8_t byte : bytes) chip.line = byte;
        return bytes.size();
    }
    std::size_t read(std::span<ports::ReceivedByte> out) override {
        for (auto& received : out) received = {chip.line, (chip.line_status & 1) != 0};
        return out.size();
    }
    bool transmitter_idle() override { return (chip.line_status & 2) != 0; }
};

Clock chip_clock;
Inputs inputs;
Outputs outputs;
Watchdog watchdog;
Line line;

std::array<std::uint8_t, (sequencer::kMaxTerms + 1) * sequencer::kTermBytes> table;
motor::JvlMotor drive(line, {});
gateway::Gateway sequence({inputs, outputs, watchdog, drive}, {}, gateway::StartCause::power_up);

void serve_user(base::Instant now) {
    switch (chip.user_order) {
        case 1:
            chip.user_status = sequence.load(table, now).ok;
            break;
        case 2:
            chip.user_status = sequence.run().ok();
            break;
        case 3:
            sequence.stop(now);
            break;
        default:
            table[chip.user_order] = chip.user_order;
    }
}

}  // namespace
}  // namespace nplc

void run_firmware() {
    for (;;) {
        const nplc::base::Instant now = nplc::chip_clock.now();
        nplc::serve_user(now);
        nplc::drive.poll(now);
        nplc::sequence.poll(now);
    }
}
