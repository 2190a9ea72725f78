#include "motor_orders.h"

#include "registers/mac.h"

namespace nplc::verify {
namespace {

using sequencer::MotorOrder;
using table::MotionEffect;
using table::OrderKind;

Motion stopped(Motion before) {
    switch (before) {
        case Motion::to_place:
        case Motion::disturbed:
            return Motion::halted;
        case Motion::endless:
            return Motion::halted_run;
        case Motion::in_place:
            return Motion::stopped_in_place;
        default:
            return before;
    }
}

Motion speeded(Motion before) {
    switch (before) {
        case Motion::halted:
            return Motion::disturbed;
        case Motion::halted_run:
            return Motion::endless;
        case Motion::stopped_in_place:
            return Motion::in_place;
        default:
            return before;
    }
}

Motion retargeted(Motion before) {
    switch (before) {
        case Motion::to_place:
        case Motion::in_place:
            return Motion::disturbed;
        case Motion::stopped_in_place:
            return Motion::halted;
        default:
            return before;
    }
}

/// Position mode with the target that stands: where that is, is not known after another mode.
Motion held(Motion before) {
    switch (before) {
        case Motion::halted_run:
            return Motion::halted;
        case Motion::none:
        case Motion::endless:
        case Motion::homing:
        case Motion::homing_disturbed:
        case Motion::driven:
            return Motion::disturbed;
        default:
            return before;
    }
}

Motion after_order(OrderKind kind, const MotorOrder& order, Motion before) {
    switch (table::effect_of(kind)) {
        case MotionEffect::none:
            return before;
        case MotionEffect::init:
            return Motion::none;
        case MotionEffect::run:
            return Motion::endless;
        case MotionEffect::place:
            return Motion::to_place;
        case MotionEffect::hold:
            return table::velocity_taken(order) != 0 ? speeded(held(before)) : held(before);
        case MotionEffect::home:
            return Motion::homing;
        case MotionEffect::drive:
            return Motion::driven;
        case MotionEffect::stop:
            return stopped(before);
        case MotionEffect::speed:
            return speeded(before);
        case MotionEffect::target:
            return retargeted(before);
    }
    return before;
}

/// P_IST, P_SOLL and P_FNC cleared in one scan, with no other order to the motion between: nothing moves.
class Zeroing {
  public:
    /// The motion after an order.
    Motion after(const MotorOrder& order, Motion before) {
        const OrderKind kind = table::kind_of(order);
        const unsigned bit = cleared_by(kind);
        if (bit == 0) {
            if (table::effect_of(kind) != MotionEffect::none) cleared_ = 0;
            return after_order(kind, order, before);
        }
        if (cleared_ == 0) before_ = before;
        cleared_ |= bit;
        return cleared_ == kAllCleared ? before_ : after_order(kind, order, before);
    }

  private:
    unsigned cleared_ = 0;
    Motion before_ = Motion::none;
};

Motion seen_by_scan(Motion before, const Seen& seen) {
    const bool homing = before == Motion::homing || before == Motion::homing_disturbed;
    if (before != Motion::to_place && before != Motion::disturbed && !homing) return before;
    if (seen.in_pos) return Motion::in_place;
    if (!seen.disturbs) return before;
    return homing ? Motion::homing_disturbed : Motion::disturbed;
}

}  // namespace

bool begins_motion(const MotorOrder& order) {
    const OrderKind kind = table::kind_of(order);
    return table::moves(table::effect_of(kind)) && !table::is_silent(kind);
}

bool ends_motion(const MotorOrder& order) {
    const OrderKind kind = table::kind_of(order);
    return kind == OrderKind::init || kind == OrderKind::stop;
}

unsigned cleared_by(OrderKind kind) {
    switch (kind) {
        case OrderKind::clears_p_soll:
            return 1;
        case OrderKind::clears_p_ist:
            return 2;
        case OrderKind::clears_p_fnc:
            return 4;
        default:
            return 0;
    }
}

Motion motion_after(Motion before, const MotorOrder& order) {
    return after_order(table::kind_of(order), order, before);
}

Motion motion_after(Motion before, const Seen& seen, std::span<const MotorOrder> orders) {
    Motion motion = seen_by_scan(before, seen);
    Zeroing zeroing;
    for (const MotorOrder& order : orders) motion = zeroing.after(order, motion);
    return motion;
}

bool begins_move(std::span<const MotorOrder> orders) {
    return is_timed(motion_after(Motion::none, {}, orders));
}

void MotorState::apply(const MotorOrder& order, const ZeroRegisters& zeros) {
    const OrderKind kind = table::kind_of(order);
    const std::uint8_t taken = table::velocity_taken(order);
    if (taken != 0 || kind == OrderKind::speed) {
        const bool is_zero = zeros[taken != 0 ? taken : std::uint8_t{registers::V_SOLL}];
        speed = is_zero ? Speed::zero : Speed::some;
    }
    switch (kind) {
        case OrderKind::reset_error:
            error = false;
            break;
        case OrderKind::stop:
            speed = Speed::stopped;
            break;
        case OrderKind::init:
            mode = Mode::init;
            break;
        case OrderKind::run:
            if (!error) mode = Mode::velocity;
            break;
        case OrderKind::place:
        case OrderKind::moves_by:
        case OrderKind::hold:
            if (!error) mode = Mode::position;
            break;
        case OrderKind::home:
            if (!error) mode = Mode::unknown;
            break;
        default:
            if (table::is_silent(kind)) mode = Mode::silent;
            break;
    }
}

}  // namespace nplc::verify
