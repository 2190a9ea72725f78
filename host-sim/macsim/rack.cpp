#include "rack.h"

#include <algorithm>

namespace nplc::sim {
namespace {

/// A motor that pauses is asked again after this long.
constexpr Time kLongestStep = std::chrono::microseconds{250};

}  // namespace

Rack::Rack(const RackOptions& options) : fastmac_(options.fastmac_baud), mactalk_(options.mactalk_baud) {
    for (const UnitOptions& unit : options.units) {
        const MacMotorOptions motor{.address = unit.address,
                                    .baud = static_cast<std::int32_t>(options.fastmac_baud),
                                    .old_register_codes = options.old_register_codes};
        units_.push_back({std::make_unique<MacMotor>(unit.model, motor)});
        units_.back().next_sample = units_.back().motor->sample_period();
    }
}

Time Rack::next_event(Time limit) const {
    limit = std::min(limit, now_ + kLongestStep);
    limit = mactalk_.next_event(fastmac_.next_event(limit));
    for (const Unit& unit : units_) limit = std::min(limit, unit.next_sample);
    return std::max(limit, now_);
}

void Rack::advance(Time to) {
    while (now_ < to) {
        fastmac_.start(now_);
        mactalk_.start(now_);
        now_ = next_event(to);
        for (Unit& unit : units_) {
            while (unit.next_sample <= now_) {
                unit.motor->sample();
                unit.next_sample += unit.motor->sample_period();
            }
        }
        serve_fastmac();
        serve_mactalk();
    }
}

void Rack::serve_fastmac() {
    MacMotor& motor = *units_.front().motor;
    const base::Instant at(std::chrono::duration_cast<base::Microseconds>(now_));
    while (const auto byte = fastmac_.to_device.take(now_))
        motor.receive(byte->value, byte->framing_error, at);
    if (fastmac_.from_device.free(now_)) {
        if (const auto byte = motor.transmit(at)) fastmac_.from_device.start(*byte, now_);
    }
    fastmac_.collect(now_);
}

void Rack::serve_mactalk() {
    while (const auto byte = mactalk_.to_device.take(now_)) {
        for (Unit& unit : units_) unit.motor->receive_mactalk(byte->value, byte->framing_error);
    }
    mactalk_.transmit(
        units_, [](Unit& unit) { return unit.motor->transmit_mactalk(); }, now_);
}

}  // namespace nplc::sim
