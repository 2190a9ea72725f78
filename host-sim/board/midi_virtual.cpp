#include "sim/midi_virtual.h"

#include <fmt/format.h>

#include <cmath>

namespace nplc::sim {
namespace {

namespace midi = registers::midi;

constexpr std::int32_t kWholeTorque = 1'023;
constexpr std::uint32_t kCanRate = 250'000;

MidiDriveOptions complete(MidiDriveOptions options) {
    if (options.can && options.address == 0) options.address = 1;
    if (options.rate == 0) options.rate = options.can ? kCanRate : midi::kFactoryBaud;
    return options;
}

MidiModule::Input input_of(action::DriveInput input) {
    switch (input) {
        case action::DriveInput::upper_stop:
            return MidiModule::Input::upper_stop;
        case action::DriveInput::lower_stop:
            return MidiModule::Input::lower_stop;
        case action::DriveInput::reference:
            return MidiModule::Input::reference;
        case action::DriveInput::security:
            return MidiModule::Input::security;
    }
    return MidiModule::Input::security;
}

}  // namespace

std::unique_ptr<VirtualDrive> make_midi_drive(const VirtualDriveOptions& options, const LineFaults& faults) {
    return std::make_unique<MidiVirtual>(
        MidiDriveOptions{.model = static_cast<midi::Model>(options.model->index),
                         .can = options.can,
                         .address = options.address,
                         .rate = options.rate,
                         .seed = options.seed},
        faults);
}

MidiVirtual::MidiVirtual(const MidiDriveOptions& options, const LineFaults& faults)
    : options_(sim::complete(options)), drive_(options_) {
    drive_.line().to_motor().set_faults(faults);
    drive_.line().from_motor().set_faults(faults);
    drive_.can().lose(faults.drop);
}

motor::DriverPorts MidiVirtual::ports() {
    if (options_.can) return {.can = &drive_.can()};
    return {.serial = &drive_.serial()};
}

void MidiVirtual::complete(motor::DriverSettings& settings) const {
    settings.address = options_.address;
    settings.baud = options_.rate;
}

std::string MidiVirtual::in_words() const {
    return fmt::format("{} over {} at {} {}", midi::facts_of(options_.model).name,
                       options_.can ? "CAN" : "V24", options_.rate, options_.can ? "bit/s" : "baud");
}

std::string MidiVirtual::note(const motor::AnyDriver& driver) const {
    using motor::MidiFault;
    const auto* motor = driver.get<motor::MidiMotor>();
    const MidiFault fault = motor != nullptr ? motor->fault() : MidiFault::none;
    if (fault == MidiFault::none) return {};
    std::string text(motor::text_of(fault));
    if (fault == MidiFault::bad_value) text += fmt::format(": {}", midi::text_of(motor->lack()));
    if (fault != MidiFault::tripped) return text;
    for (const midi::Bit& bit : midi::status_bits()) {
        if ((motor->drive_status() & midi::kTrips & bit.mask) != 0) text += fmt::format("; {}", bit.text);
    }
    return text;
}

void MidiVirtual::sample() {
    const std::int32_t now = shaft();
    speed_ = now - before_;
    before_ = now;
}

std::int32_t MidiVirtual::shaft() const {
    return midi::counts_of_increments(options_.model, static_cast<std::int32_t>(drive_.module().shaft()));
}

std::int64_t MidiVirtual::increments_of(std::int64_t counts) const {
    const registers::Scale scale = registers::scale_of(registers::Model::mac140);
    return counts * midi::facts_of(options_.model).increments_per_rev / scale.counts_per_rev;
}

void MidiVirtual::fill(Snapshot& snapshot) const {
    const MidiModule& module = drive_.module();
    snapshot.p_ist = midi::counts_of_increments(options_.model, module.position());
    snapshot.v_ist = speed_;
    snapshot.shaft = shaft();
    snapshot.torque = kWholeTorque * module.torque() / options_.module.imax;
}

void MidiVirtual::spoil(const action::SpoilLine& faults) {
    if (faults.to_motor) sim::spoil(drive_.line().to_motor(), faults);
    if (faults.from_motor) sim::spoil(drive_.line().from_motor(), faults);
    if (faults.drop) drive_.can().lose(*faults.drop);
}

bool MidiVirtual::fail() {
    drive_.module().overload_amplifier();
    return true;
}

bool MidiVirtual::load(int torque) {
    drive_.module().set_load(torque * options_.module.imax / kWholeTorque);
    return true;
}

void MidiVirtual::store(const StoredRegister& parameter) {
    drive_.module().execute(parameter.number, 0, parameter.bits);
}

bool MidiVirtual::stop(const action::StopMotor& stop) {
    if (stop.torque_per_count != 0) return false;
    drive_.module().stop_shaft(stop.above, increments_of(stop.counts));
    return true;
}

bool MidiVirtual::set_input(const action::SetDriveInput& input) {
    drive_.module().set_input(input_of(input.input), input.active);
    return true;
}

bool MidiVirtual::connect(const action::DriveSwitch& connected) {
    drive_.module().connect(input_of(connected.input), connected.on_above, increments_of(connected.counts));
    return true;
}

bool MidiVirtual::set_supply(double volts) {
    drive_.module().set_supply(static_cast<std::int32_t>(std::lround(1000 * volts)));
    return true;
}

bool MidiVirtual::set_temperature(int celsius) {
    drive_.module().set_temperature(1000 * celsius);
    return true;
}

bool MidiVirtual::break_encoder() {
    drive_.module().connect_encoder(false);
    return true;
}

}  // namespace nplc::sim
