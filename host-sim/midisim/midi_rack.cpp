#include "midi_rack.h"

#include <algorithm>

namespace nplc::sim {
namespace {

/// Poll interval of a module that pauses.
constexpr Time kLongestStep = std::chrono::microseconds{250};

constexpr std::size_t kMostWaiting = 256;
constexpr Time kRestartEvery = std::chrono::seconds{1};

bool is_ours(const ports::CanFrame& frame) {
    return base::is_valid(frame) && !frame.extended && !frame.remote;
}

}  // namespace

MidiRack::MidiRack(const std::vector<MidiUnit>& units, std::uint32_t baud)
    : MidiModules(units, false),
      follows_(baud == 0),
      baud_(follows_ ? registers::midi::kFactoryBaud : baud),
      line_(baud_) {}

/// Between characters only.
void MidiRack::follow_baud() {
    const std::uint32_t wanted = modules_.front().baud();
    if (!follows_ || wanted == baud_ || !line_.is_quiet(now_)) return;
    baud_ = wanted;
    line_.set_baud(wanted);
}

void MidiRack::advance(Time to) {
    while (now_ < to) {
        follow_baud();
        line_.start(now_);
        now_ = std::max(line_.next_event(std::min(to, now_ + kLongestStep)), now_);
        for (MidiModule& module : modules_) module.advance(now_);
        serve();
    }
}

/// A module at another baud rate receives framing errors.
void MidiRack::serve() {
    while (const auto byte = line_.to_device.take(now_)) {
        for (std::size_t i = 0; i < size(); ++i) {
            const bool other_rate = modules_[i].baud() != baud_;
            ends_[i].receive(byte->value, byte->framing_error || other_rate);
        }
    }
    line_.transmit(
        ends_, [](MidiV24End& end) { return end.transmit(); }, now_);
}

MidiCanRack::MidiCanRack(const std::vector<MidiUnit>& units, ports::CanPort& port)
    : MidiModules(units, true), port_(port) {}

void MidiCanRack::advance(Time to) {
    now_ = std::max(now_, to);
    for (MidiModule& module : modules_) module.advance(now_);
    receive();
    transmit();
}

void MidiCanRack::receive() {
    ports::CanFrame frame;
    while (port_.read(frame)) {
        if (!is_ours(frame)) continue;
        for (MidiCanEnd& end : ends_) end.receive(frame);
    }
}

void MidiCanRack::transmit() {
    const ports::CanState state = port_.state();
    for (MidiCanEnd& end : ends_) {
        while (const auto message = end.transmit()) {
            if (waiting_.size() < kMostWaiting) waiting_.push_back(*message);
        }
    }
    if (state == ports::CanState::bus_off && now_ >= next_restart_) {
        next_restart_ = now_ + kRestartEvery;
        static_cast<void>(port_.restart());
    }
    if (state == ports::CanState::bus_off || state == ports::CanState::down) waiting_.clear();
    while (!waiting_.empty() && port_.write(waiting_.front())) waiting_.pop_front();
}

}  // namespace nplc::sim
