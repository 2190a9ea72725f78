#include "midi_can_rack.h"

#include <algorithm>

namespace nplc::sim {
namespace {

namespace can = protocol::midi_can;

constexpr std::size_t kMostWaiting = 256;
constexpr Time kRestartEvery = std::chrono::seconds{1};

bool is_ours(const ports::CanFrame& frame) {
    return ports::is_valid(frame) && !frame.extended && !frame.remote;
}

can::Frame message_in(const ports::CanFrame& frame) {
    return {.id = static_cast<std::uint16_t>(frame.id), .size = frame.length, .data = frame.data};
}

ports::CanFrame frame_of(const can::Frame& message) {
    return {.id = message.id, .length = message.size, .data = message.data};
}

}  // namespace

MidiCanRack::MidiCanRack(const std::vector<MidiUnit>& units, ports::CanPort& port) : port_(port) {
    for (const MidiUnit& unit : units)
        modules_.emplace_back(unit.model, MidiOptions{.can = true, .address = unit.address});
    for (MidiModule& module : modules_) ends_.emplace_back(module);
}

void MidiCanRack::advance(Time to) {
    now_ = std::max(now_, to);
    for (MidiModule& module : modules_) module.advance(now_);
    hear();
    speak();
}

void MidiCanRack::hear() {
    ports::CanFrame frame;
    while (port_.read(frame)) {
        if (!is_ours(frame)) continue;
        for (MidiCanEnd& end : ends_) end.receive(message_in(frame));
    }
}

void MidiCanRack::speak() {
    const ports::CanState state = port_.state();
    for (MidiCanEnd& end : ends_) {
        while (const auto message = end.transmit()) {
            if (waiting_.size() < kMostWaiting) waiting_.push_back(frame_of(*message));
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
