#include "sim/midi_virtual.h"

#include <fmt/format.h>

#include "registers/scale.h"
#include "sim/midi_stage.h"
#include "sim/without_effect.h"

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
    if (fault == MidiFault::bad_value) text += fmt::format(": {}", midi::text_of(motor->limitation()));
    if (fault != MidiFault::tripped) return text;
    for (const midi::Bit& bit : midi::status_bits()) {
        if ((motor->drive_status() & midi::kTrips & bit.mask) != 0) text += fmt::format("; {}", bit.text);
    }
    return text;
}

void MidiVirtual::sample() {
    const std::int64_t now = shaft();
    speed_ = static_cast<std::int32_t>(now - before_);
    before_ = now;
}

/// A shaft that slips for minutes leaves 32 bits.
std::int64_t MidiVirtual::shaft() const {
    const std::int64_t turned = drive_.module().shaft();
    const std::int64_t per_rev = midi::facts_of(options_.model).increments_per_rev;
    const auto rest = static_cast<std::int32_t>(turned % per_rev);
    return turned / per_rev * registers::scale_of(registers::Model::mac140).counts_per_rev +
           midi::counts_of_increments(options_.model, rest);
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

void MidiVirtual::store(const StoredRegister& parameter) {
    drive_.module().execute(parameter.number, 0, parameter.bits);
}

std::string MidiVirtual::without_effect(const Action& action) const {
    return sim::without_effect(drive_.module(), drive_.module().is_on(), action);
}

std::string_view MidiVirtual::act(const action::OnMotor& what) {
    return sim::act(drive_.module(), what) ? std::string_view() : missing_for(what);
}

}  // namespace nplc::sim
