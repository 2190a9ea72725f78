#include "midi_rack.h"

#include <algorithm>
#include <optional>

namespace nplc::sim {
namespace {

/// A module that pauses is asked again after this long.
constexpr Time kLongestStep = std::chrono::microseconds{250};

}  // namespace

MidiRack::MidiRack(const std::vector<MidiUnit>& units, std::uint32_t baud)
    : follows_(baud == 0), baud_(follows_ ? registers::midi::kFactoryBaud : baud), line_(baud_) {
    for (const MidiUnit& unit : units)
        modules_.emplace_back(unit.model, MidiOptions{.address = unit.address});
    for (MidiModule& module : modules_) ends_.emplace_back(module);
}

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

/// A module at another rate hears framing errors. Modules that answer at once disturb each other: on the
/// wires a 0 wins over a 1.
void MidiRack::serve() {
    while (const auto byte = line_.to_device.take(now_)) {
        for (std::size_t i = 0; i < size(); ++i) {
            const bool other_rate = modules_[i].baud() != baud_;
            ends_[i].receive(byte->value, byte->framing_error || other_rate);
        }
    }
    if (line_.from_device.free(now_)) {
        std::optional<std::uint8_t> together;
        for (MidiV24End& end : ends_) {
            const auto byte = end.transmit();
            if (byte) together = static_cast<std::uint8_t>(together.value_or(0xFF) & *byte);
        }
        if (together) line_.from_device.start(*together, now_);
    }
    line_.collect(now_);
}

}  // namespace nplc::sim
