#include "motor_orders.h"

#include <algorithm>
#include <array>

#include "protocol/fastmac.h"
#include "registers/mac.h"

namespace nplc::verify {
namespace {

using protocol::fastmac::Command;
using RegisterGroup = protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;
using sequencer::MotorOrder;

OrderKind kind_of_mode(std::uint32_t mode) {
    constexpr std::array<std::uint32_t, 7> kGears = {3, 17, 18, 19, 20, 21, 24};
    if (mode == 0) return OrderKind::init;
    if (mode == 1 || std::find(kGears.begin(), kGears.end(), mode) != kGears.end())
        return OrderKind::velocity;
    if (mode == 2) return OrderKind::place;
    return mode >= 12 && mode <= 14 ? OrderKind::home : OrderKind::silent;
}

OrderKind kind_of_write(const MotorOrder& order) {
    switch (order.reg) {
        case registers::MODE_REG:
            return kind_of_mode(order.value);
        case registers::V_SOLL:
            return order.value == 0 ? OrderKind::stop : OrderKind::speed;
        case registers::V_REG_P:
            return OrderKind::speed;
        case registers::ERR_STAT:
            return OrderKind::reset_error;
        default:
            return OrderKind::nothing;
    }
}

OrderKind kind_of_number(Number number) {
    switch (number) {
        case Number::reset_error:
            return OrderKind::reset_error;
        case Number::clear_v_soll:
            return OrderKind::stop;
        case Number::move_p7_by_p_fnc:
        case Number::move_p8_by_p_fnc:
        case Number::move_p7_by_p_soll:
        case Number::move_p8_by_p_soll:
            return OrderKind::place;
        case Number::use_set_1:
        case Number::use_set_2:
        case Number::use_set_3:
        case Number::use_set_4:
            return OrderKind::set;
        case Number::home:
            return OrderKind::home;
        default:
            return OrderKind::nothing;
    }
}

/// What an order does to a motion.
enum class Effect : std::uint8_t {
    nothing,
    init,
    run,     ///< velocity and gear modes
    place,   ///< a move to a place
    hold,    ///< position mode, the target stays
    hold_v,  ///< and V_SOLL is something
    home,
    drive,  ///< torque and test modes
    stop,
    speed,
    target,  ///< P_SOLL or P_FNC is another one, the mode stays
    zero,    ///< P_IST is 0
};

Effect effect_of_mode(std::uint32_t mode) {
    constexpr std::array<std::uint32_t, 3> kByAnalogueSpeed = {5, 6,
                                                               16};  // AV, AVG and AVZ: V_SOLL = 0 stops
    constexpr std::uint32_t kStopMode = 11;                          // on the way to INIT
    constexpr std::uint32_t kSafeMode = 15;                          // not entered by the register
    constexpr std::uint32_t kLastMode = 24;
    switch (kind_of_mode(mode)) {
        case OrderKind::init:
            return Effect::init;
        case OrderKind::velocity:
            return Effect::run;
        case OrderKind::place:
            return Effect::place;
        case OrderKind::home:
            return Effect::home;
        default:
            break;
    }
    if (std::find(kByAnalogueSpeed.begin(), kByAnalogueSpeed.end(), mode) != kByAnalogueSpeed.end())
        return Effect::run;
    if (mode == kStopMode) return Effect::init;
    return mode == kSafeMode || mode > kLastMode ? Effect::nothing : Effect::drive;
}

Effect effect_of_write(const MotorOrder& order) {
    switch (order.reg) {
        case registers::MODE_REG:
            return effect_of_mode(order.value);
        case registers::P_SOLL:
        case registers::P_FNC:
        case registers::P_REG_P:
            return Effect::target;
        case registers::V_SOLL:
            return order.value == 0 ? Effect::stop : Effect::speed;
        case registers::V_REG_P:
            return Effect::speed;
        default:
            return Effect::nothing;
    }
}

Effect effect_of(const MotorOrder& order) {
    if (order.is_register_write) return effect_of_write(order);
    const Command command = protocol::fastmac::decode_command(order.command);
    switch (command.mode) {
        case Mode::init:
            return Effect::init;
        case Mode::velocity:
            return Effect::run;
        case Mode::position:
            return command.group == RegisterGroup::p   ? Effect::place
                   : command.group == RegisterGroup::v ? Effect::hold_v
                                                       : Effect::hold;
        case Mode::command:
            break;
    }
    switch (static_cast<Number>(command.number)) {
        case Number::clear_p_soll:
        case Number::clear_p_fnc:
            return Effect::target;
        case Number::clear_p_ist:
            return Effect::zero;
        case Number::clear_v_soll:
            return Effect::stop;
        case Number::home:
            return Effect::home;
        default:
            return begins_motion(kind_of_number(static_cast<Number>(command.number))) ? Effect::place
                                                                                      : Effect::nothing;
    }
}

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

Motion after_effect(Effect effect, Motion before) {
    switch (effect) {
        case Effect::nothing:
        case Effect::zero:
            return before;
        case Effect::init:
            return Motion::none;
        case Effect::run:
            return Motion::endless;
        case Effect::place:
            return Motion::to_place;
        case Effect::hold:
            return held(before);
        case Effect::hold_v:
            return speeded(held(before));
        case Effect::home:
            return Motion::homing;
        case Effect::drive:
            return Motion::driven;
        case Effect::stop:
            return stopped(before);
        case Effect::speed:
            return speeded(before);
        case Effect::target:
            return retargeted(before);
    }
    return before;
}

/// P_IST, P_SOLL and P_FNC cleared in one scan, with no other order to the motion between: nothing moves.
class Zeroing {
  public:
    /// The motion after an order.
    Motion after(const MotorOrder& order, Effect effect, Motion before) {
        const unsigned bit = bit_of(order);
        if (bit == 0) {
            if (effect != Effect::nothing) cleared_ = 0;
            return after_effect(effect, before);
        }
        if (cleared_ == 0) before_ = before;
        cleared_ |= bit;
        return cleared_ == kAll ? before_ : after_effect(effect, before);
    }

  private:
    static constexpr unsigned kAll = 7;

    static unsigned bit_of(const MotorOrder& order) {
        if (order.is_register_write) return 0;
        const Command command = protocol::fastmac::decode_command(order.command);
        if (command.mode != Mode::command) return 0;
        switch (static_cast<Number>(command.number)) {
            case Number::clear_p_soll:
                return 1;
            case Number::clear_p_ist:
                return 2;
            case Number::clear_p_fnc:
                return 4;
            default:
                return 0;
        }
    }

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

OrderKind kind_of(const MotorOrder& order) {
    if (order.is_register_write) return kind_of_write(order);
    const Command command = protocol::fastmac::decode_command(order.command);
    switch (command.mode) {
        case Mode::init:
            return OrderKind::init;
        case Mode::velocity:
            return OrderKind::velocity;
        case Mode::position:
            return command.group == RegisterGroup::p ? OrderKind::place : OrderKind::holds_place;
        case Mode::command:
            break;
    }
    return kind_of_number(static_cast<Number>(command.number));
}

std::uint8_t selected_register(const MotorOrder& order) {
    if (order.is_register_write) return 0;
    const Command command = protocol::fastmac::decode_command(order.command);
    if (command.mode == Mode::command) return 0;
    constexpr std::array<std::uint8_t, 6> kFirst = {49, 65, 73, 77, 81, 85};  // P V A T L Z
    const unsigned spacing = command.group == RegisterGroup::p ? 2 : 1;
    return static_cast<std::uint8_t>(kFirst[static_cast<std::size_t>(command.group)] +
                                     spacing * (command.index - 1U));
}

std::uint8_t velocity_taken(const MotorOrder& order) {
    constexpr std::uint32_t kVelocities = 8;
    const auto velocity = [](std::uint32_t number) {
        return static_cast<std::uint8_t>(number >= 1 && number <= kVelocities ? registers::V1 + number - 1
                                                                              : 0);
    };
    if (order.is_register_write) return order.reg == registers::V_REG_P ? velocity(order.value) : 0;
    if (const OrderKind kind = kind_of(order); kind == OrderKind::set) {
        const Command command = protocol::fastmac::decode_command(order.command);
        return velocity(command.number - static_cast<unsigned>(Number::use_set_1) + 1U);
    }
    return velocity(selected_register(order) - std::uint32_t{registers::V1} + 1);
}

bool begins_motion(OrderKind kind) {
    return kind == OrderKind::velocity || kind == OrderKind::place || kind == OrderKind::home ||
           kind == OrderKind::set;
}

bool ends_motion(OrderKind kind) {
    return kind == OrderKind::init || kind == OrderKind::stop;
}

Motion motion_after(Motion before, const Seen& seen, std::span<const MotorOrder> orders) {
    Motion motion = seen_by_scan(before, seen);
    Zeroing zeroing;
    for (const MotorOrder& order : orders) motion = zeroing.after(order, effect_of(order), motion);
    return motion;
}

bool begins_move(std::span<const MotorOrder> orders) {
    return is_timed(motion_after(Motion::none, {}, orders));
}

void MotorState::apply(const MotorOrder& order, const ZeroRegisters& zeros) {
    const OrderKind kind = kind_of(order);
    const std::uint8_t taken = velocity_taken(order);
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
        case OrderKind::velocity:
            if (!error) mode = Mode::velocity;
            break;
        case OrderKind::place:
        case OrderKind::holds_place:
            if (!error) mode = Mode::position;
            break;
        case OrderKind::home:
            if (!error) mode = Mode::unknown;
            break;
        case OrderKind::silent:
            mode = Mode::silent;
            break;
        case OrderKind::speed:
        case OrderKind::set:
        case OrderKind::nothing:
            break;
    }
}

}  // namespace nplc::verify
