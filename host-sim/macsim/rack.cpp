#include "rack.h"

#include <algorithm>

namespace nplc::sim {
namespace {

/// Poll interval of a motor that pauses.
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
    if (stage_) limit = std::min(limit, stage_->next_due().value_or(limit));
    return std::max(limit, now_);
}

void Rack::sample(Unit& unit) {
    while (unit.next_sample <= now_) {
        is_powered(unit) ? unit.motor->sample() : unit.motor->coast();
        unit.next_sample += unit.motor->sample_period();
    }
}

void Rack::advance(Time to) {
    if (stage_ && now_ == Time{0}) stage_->observe(now_);
    while (now_ < to) {
        fastmac_.start(now_);
        mactalk_.start(now_);
        now_ = next_event(to);
        for (Unit& unit : units_) sample(unit);
        if (stage_) stage_->observe(now_);
        serve_fastmac();
        serve_mactalk();
    }
}

void Rack::serve_fastmac() {
    MacMotor& motor = *units_.front().motor;
    const base::Instant at(std::chrono::duration_cast<base::Microseconds>(now_));
    while (const auto byte = fastmac_.to_device.take(now_)) {
        if (is_powered(units_.front())) motor.receive(byte->value, byte->framing_error, at);
    }
    if (is_powered(units_.front()) && fastmac_.from_device.free(now_)) {
        if (const auto byte = motor.transmit(at)) fastmac_.from_device.start(*byte, now_);
    }
    fastmac_.collect(now_);
}

void Rack::serve_mactalk() {
    while (const auto byte = mactalk_.to_device.take(now_)) {
        for (Unit& unit : units_) {
            if (is_powered(unit)) unit.motor->receive_mactalk(byte->value, byte->framing_error);
        }
    }
    mactalk_.transmit(
        units_,
        [this](Unit& unit) {
            return is_powered(unit) ? unit.motor->transmit_mactalk() : std::optional<std::uint8_t>();
        },
        now_);
}

}  // namespace nplc::sim
