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
    const bool to_place = before == Motion::to_place || before == Motion::disturbed;
    Motion motion = before;
    if (to_place && seen.in_pos) {
        motion = Motion::none;
    } else if (to_place && seen.disturbs) {
        motion = Motion::disturbed;
    }
    for (const MotorOrder& order : orders) {
        const OrderKind kind = kind_of(order);
        if (ends_motion(kind)) motion = Motion::none;
        if (begins_motion(kind)) motion = kind == OrderKind::velocity ? Motion::endless : Motion::to_place;
    }
    return motion;
}

bool begins_move(std::span<const MotorOrder> orders) {
    return motion_after(Motion::none, {}, orders) == Motion::to_place;
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
