#include "sim/midi_drive.h"

#include <algorithm>

namespace nplc::sim {
namespace {

constexpr std::uint32_t kCanRate = 250'000;
/// Poll interval for a boot-up message of a module on CAN.
constexpr Time kAskPeriod = std::chrono::milliseconds{1};
constexpr int kGateway = 0;
constexpr int kModule = 1;

/// When what would arrive now does.
Time late(Time now, const LineFaults& by) {
    const Time arrival = now + by.late;
    if (by.together == Time(0)) return arrival;
    return arrival + by.together - Time(1) - (arrival - Time(1)) % by.together;
}

std::uint32_t rate_of(const MidiDriveOptions& options) {
    if (options.rate != 0) return options.rate;
    return options.can ? kCanRate : registers::midi::kFactoryBaud;
}

MidiOptions module_options(const MidiDriveOptions& options) {
    MidiOptions module = options.module;
    module.can = options.can;
    module.address = options.address;
    return module;
}

}  // namespace

bool VirtualCanPort::write(const ports::CanFrame& frame) {
    if (state_ == ports::CanState::down || state_ == ports::CanState::bus_off) return false;
    if (!loses(loss_of_sent_)) bus_.send(frame, kGateway);
    return true;
}

bool VirtualCanPort::read(ports::CanFrame& frame) {
    if (received_.empty()) return false;
    frame = received_.front();
    received_.pop_front();
    return true;
}

bool VirtualCanPort::filter(std::span<const ports::CanFilter> filters) {
    filters_.emplace(filters.begin(), filters.end());
    return true;
}

bool VirtualCanPort::restart() {
    if (state_ != ports::CanState::bus_off) return false;
    ++restarts_;
    return true;
}

void VirtualCanPort::receive(const base::CanFrame& frame) {
    const auto lets_in = [&](const ports::CanFilter& f) { return ((frame.id ^ f.id) & f.mask) == 0; };
    if (filters_ && std::none_of(filters_->begin(), filters_->end(), lets_in)) return;
    if (state_ == ports::CanState::down || state_ == ports::CanState::bus_off) return;
    if (loses(loss_of_received_)) return;
    received_.push_back(frame);
}

MidiDrive::MidiDrive(const MidiDriveOptions& options)
    : is_can_(options.can),
      module_(options.model, module_options(options)),
      line_(rate_of(options), options.seed),
      v24_end_(module_),
      can_end_(module_),
      bus_(rate_of(options)),
      can_port_(bus_, options.seed) {}

bool MidiDrive::service(Time now) {
    module_.advance(now);
    return is_can_ ? service_can(now) : service_v24(now);
}

bool MidiDrive::service_v24(Time now) {
    while (const auto byte = line_.to_motor().take(now)) {
        if (module_.is_on()) v24_end_.receive(byte->value, byte->framing_error);
    }
    if (line_.from_motor().free(now)) {
        if (const auto byte = v24_end_.transmit(); byte && module_.is_on())
            line_.from_motor().start(*byte, now);
    }
    return line_.service(now);
}

bool MidiDrive::service_can(Time now) {
    bool any = false;
    if (now - asked_ >= kAskPeriod) asked_ = now;
    for (;;) {
        while (const auto frame = can_end_.transmit()) {
            if (!cut_ && module_.is_on()) bus_.send(*frame, kModule);
        }
        const auto heard = bus_.take(now);
        if (!heard) break;
        if (cut_) continue;
        if (heard->sender == kGateway) {
            can_end_.receive(heard->frame);
        } else {
            coming_.emplace_back(late(now, lateness_), heard->frame);
        }
    }
    for (; !coming_.empty() && coming_.front().first <= now; coming_.pop_front()) {
        can_port_.receive(coming_.front().second);
        any = true;
    }
    return any;
}

Time MidiDrive::next_event(Time now) const {
    Time next = Time::max();
    const auto consider = [&next](std::optional<Time> time) {
        if (time) next = std::min(next, *time);
    };
    if (is_can_) {
        consider(bus_.next_event());
        consider(asked_ + kAskPeriod);
        if (!coming_.empty()) consider(coming_.front().first);
        if (!bus_.is_idle() && !bus_.next_event()) consider(now);
        return next;
    }
    consider(line_.to_motor().next_arrival());
    consider(line_.from_motor().next_arrival());
    if (line_.has_waiting()) consider(line_.to_motor().busy_until());
    if (!line_.from_motor().free(now)) consider(line_.from_motor().busy_until());
    return next;
}

void MidiDrive::cut(bool cut) {
    cut_ = cut;
    cut ? line_.cut() : line_.restore();
}

void MidiDrive::cut(bool to_drive, bool from_drive) {
    can_port_.lose(to_drive ? 1 : 0, from_drive ? 1 : 0);
    line_.to_motor().set_faults({.drop = to_drive ? 1.0 : 0.0});
    LineFaults faults = lateness_;
    faults.drop = from_drive ? 1 : 0;
    line_.from_motor().set_faults(faults);
}

void MidiDrive::delay(Time late, Time together) {
    lateness_ = {.late = late, .together = together};
    line_.from_motor().set_faults(lateness_);
}

void MidiDrive::power(bool on) {
    on ? module_.power_on() : module_.power_off();
}

}  // namespace nplc::sim
