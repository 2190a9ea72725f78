// Holds what a gateway's firmware holds and calls what it calls, so that the size of the image is the size of
// the core. A new part of the core gets an object and a call here.

#include "gateway/gateway.h"
#include "gateway/own_registers.h"
#include "gateway/user_port.h"
#include "motor/jvl_motor.h"
#include "ports/clock.h"
#include "ports/storage.h"
#include "protocol/midi_can.h"
#include "protocol/midi_v24.h"
#include "registers/midi_scale.h"

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
    volatile std::uint8_t flash;
    volatile std::uint8_t flash_order;
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
Line user_line;
Line motor_line;

class Flash final : public ports::Storage {
  public:
    ports::StorageGeometry geometry() const override {
        return {.size = 24 * 1024, .erase_block = 2048, .program_page = 256, .program_unit = 8};
    }
    base::Status read(std::uint32_t, std::span<std::uint8_t> out) override {
        for (auto& byte : out) byte = chip.flash;
        return {};
    }
    base::Status program(std::uint32_t, std::span<const std::uint8_t> bytes) override {
        for (const std::uint8_t byte : bytes) chip.flash = byte;
        return {};
    }
    base::Status erase(std::uint32_t) override {
        chip.flash_order = 1;
        return {};
    }
    ports::StorageState state() override {
        return chip.flash_order != 0 ? ports::StorageState::busy : ports::StorageState::ready;
    }
};
Flash flash;

std::array<std::uint8_t, (sequencer::kMaxTerms + 1) * sequencer::kTermBytes> table;
motor::JvlMotor drive(line, {});
gateway::SettingsKeeper settings(flash, {.begin = 10 * 2048, .slot_bytes = 2048});
gateway::Gateway sequence({inputs, outputs, watchdog, drive}, {}, gateway::StartCause::power_up);
gateway::TableKeeper tables(sequence, drive, flash, {.begin = 0, .slot_bytes = 5 * 2048}, table);
gateway::OwnRegisters registers(sequence, tables, settings);
gateway::UserPort user_port(user_line, &motor_line, sequence, drive, registers, settings);

/// What a driver of a MIDI module calls.
class MidiTraffic {
  public:
    void ask(std::uint32_t speed, std::uint32_t acceleration) {
        const auto* row = registers::midi::find_command(registers::midi::RAMP);
        const auto ramp = registers::midi::ramp_of(speed, acceleration);
        const auto period = registers::midi::period_of_speed(speed);
        const auto torque = registers::midi::torque_of(chip.line, 1023, registers::midi::kMostTorque);
        const auto data = registers::midi::pack(*row, ramp.value_or(torque.value_or(0)));
        v24_.expect({.address = 1, .index = row->number, .data = data.value_or(period.value_or(1))});
        for (const std::uint8_t byte : protocol::midi_v24::encode({.address = 1, .index = row->number}))
            chip.line = byte;
        const auto frame = protocol::midi_can::encode(can_);
        for (const std::uint8_t byte : frame.data) chip.line = byte;
    }
    void hear(std::uint8_t byte) {
        chip.line = static_cast<std::uint8_t>(v24_.receive(byte).value);
        const auto answer = protocol::midi_can::decode_answer({.id = byte, .size = 8, .data = {byte}});
        chip.line = protocol::midi_can::answers(answer, can_) ? 1 : 0;
    }

  private:
    protocol::midi_v24::AnswerDecoder v24_;
    protocol::midi_can::Request can_{.kind = protocol::midi_can::Request::Kind::command, .address = 1};
};
MidiTraffic midi_traffic;

void start(base::Instant now) {
    settings.start({});
    static_cast<void>(sequence.change(gateway::settings_of(settings.values())));
    settings.attach(sequence);
    static_cast<void>(tables.mount());
    tables.start(now);
}

}  // namespace
}  // namespace nplc

void run_firmware() {
    nplc::start(nplc::chip_clock.now());
    for (;;) {
        const nplc::base::Instant now = nplc::chip_clock.now();
        nplc::sequence.poll(now);
        nplc::user_port.poll(now);
        nplc::midi_traffic.ask(nplc::chip.microseconds, nplc::chip.microseconds);
        nplc::midi_traffic.hear(nplc::chip.line);
    }
}
