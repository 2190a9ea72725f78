#include "gateway/standstill.h"

#include <algorithm>

#include "registers/mac.h"

namespace nplc::gateway {
namespace {

constexpr base::Microseconds kBetween{50'000};
constexpr base::Microseconds kLongest{1'000'000};

}  // namespace

void Standstill::begin(base::Instant now) {
    motor_.drop_access();
    phase_ = Phase::first_position;
    asked_ = false;
    begun_ = now;
}

std::uint8_t Standstill::register_of_phase() const {
    return phase_ == Phase::speed ? registers::V_IST : registers::P_IST;
}

PendingResult Standstill::poll(base::Instant now) {
    if (now - begun_ > kLongest) return CommandResult{Result::link_down};
    if (!asked_) {
        if (phase_ == Phase::second_position && now - position_at_ < kBetween) return std::nullopt;
        asked_ = motor_.begin_access({.reg = register_of_phase(), .longword = !is_word()});
        return std::nullopt;
    }
    switch (motor_.access_state()) {
        case motor::AccessState::waiting:
        case motor::AccessState::under_way:
            return std::nullopt;
        case motor::AccessState::none:
        case motor::AccessState::failed:
            asked_ = false;
            return std::nullopt;
        case motor::AccessState::done:
            break;
    }
    asked_ = false;
    return take(motor_.access_value(), now);
}

base::Instant Standstill::next_poll(base::Instant now) const {
    const base::Instant patience = begun_ + kLongest + base::Microseconds(1);
    if (motor::is_open(motor_.access_state()) || !motor::link_is_usable(motor_.link())) return patience;
    const bool pauses = !asked_ && phase_ == Phase::second_position;
    return std::min(patience, pauses ? std::max(now, position_at_ + kBetween) : now);
}

PendingResult Standstill::take(std::uint32_t value, base::Instant now) {
    switch (phase_) {
        case Phase::first_position:
            position_ = value;
            position_at_ = now;
            phase_ = Phase::speed;
            return std::nullopt;
        case Phase::speed:
            if (value != 0) return CommandResult{Result::moving};
            phase_ = Phase::second_position;
            return std::nullopt;
        case Phase::second_position:
            break;
    }
    const bool still = value - position_ + 1 <= 2;  // modulo 2^32: -1, 0 or 1 count
    return CommandResult{still ? Result::done : Result::moving};
}

}  // namespace nplc::gateway
