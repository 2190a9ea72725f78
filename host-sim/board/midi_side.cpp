#include "sim/midi_side.h"

#include <fmt/format.h>

namespace nplc::sim {
namespace {

namespace midi = registers::midi;

constexpr std::int32_t kFullTorque = 1'023;
constexpr std::uint32_t kCanRate = 250'000;

MidiDriveOptions complete(MidiDriveOptions options) {
    if (options.can && options.address == 0) options.address = 1;
    if (options.rate == 0) options.rate = options.can ? kCanRate : midi::kFactoryBaud;
    return options;
}

}  // namespace

void spoil(LineDirection& direction, const action::SpoilLine& what) {
    LineFaults faults = direction.faults();
    faults.drop = what.drop.value_or(faults.drop);
    faults.damage = what.damage.value_or(faults.damage);
    faults.framing = what.framing.value_or(faults.framing);
    faults.delay = what.delay.value_or(faults.delay);
    faults.longest_delay = what.longest_delay.value_or(faults.longest_delay);
    direction.set_faults(faults);
}

MidiSide::MidiSide(const MidiDriveOptions& options, const LineFaults& faults)
    : options_(complete(options)), drive_(options_) {
    drive_.line().to_motor().set_faults(faults);
    drive_.line().from_motor().set_faults(faults);
    drive_.can().lose(faults.drop);
}

motor::Motor& MidiSide::start_driver() {
    driver_.reset();
    motor::MidiLink* link = nullptr;
    if (options_.can) {
        link = &can_.emplace(drive_.can(), motor::MidiCanLink::Settings{.address = options_.address});
    } else {
        link = &v24_.emplace(drive_.serial(), motor::MidiV24Link::Settings{.address = options_.address,
                                                                           .baud = options_.rate});
    }
    return driver_.emplace(*link, motor::MidiMotor::Settings{.model = options_.model});
}

std::string MidiSide::in_words() const {
    return fmt::format("{} over {} at {} {}", midi::facts_of(options_.model).name,
                       options_.can ? "CAN" : "V24", options_.rate, options_.can ? "bit/s" : "baud");
}

std::string MidiSide::note() const {
    using motor::MidiFault;
    const MidiFault fault = driver_->fault();
    if (fault == MidiFault::none) return {};
    std::string text(motor::text_of(fault));
    if (fault == MidiFault::bad_value) text += fmt::format(": {}", midi::text_of(driver_->lack()));
    if (fault != MidiFault::tripped) return text;
    for (const midi::Bit& bit : midi::status_bits()) {
        if ((driver_->drive_status() & midi::kTrips & bit.mask) != 0) text += fmt::format("; {}", bit.text);
    }
    return text;
}

void MidiSide::sample() {
    const std::int32_t now = midi::counts_of_increments(options_.model, drive_.module().position());
    speed_ = now - before_;
    before_ = now;
}

void MidiSide::fill(Snapshot& snapshot) const {
    const MidiModule& module = drive_.module();
    snapshot.p_ist = midi::counts_of_increments(options_.model, module.position());
    snapshot.v_ist = speed_;
    snapshot.shaft = snapshot.p_ist;
    snapshot.torque = kFullTorque * module.torque() / options_.module.imax;
}

void MidiSide::spoil(const action::SpoilLine& faults) {
    if (faults.to_motor) sim::spoil(drive_.line().to_motor(), faults);
    if (faults.from_motor) sim::spoil(drive_.line().from_motor(), faults);
    if (faults.drop) drive_.can().lose(*faults.drop);
}

void MidiSide::load(int torque) {
    drive_.module().set_load(torque * options_.module.imax / kFullTorque);
}

}  // namespace nplc::sim
