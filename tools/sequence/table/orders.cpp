#include "table/orders.h"

#include <array>

#include "protocol/fastmac.h"
#include "registers/mac.h"

namespace nplc::table {
namespace {

using protocol::fastmac::Command;
using protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;
using sequencer::MotorOrder;

OrderKind kind_of_write(const MotorOrder& order) {
    switch (order.reg) {
        case registers::MODE_REG:
            return kind_of_mode(order.value);
        case registers::P_SOLL:
        case registers::P_FNC:
        case registers::P_REG_P:
            return OrderKind::target;
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
        case Number::clear_p_soll:
            return OrderKind::clears_p_soll;
        case Number::clear_p_ist:
            return OrderKind::clears_p_ist;
        case Number::clear_p_fnc:
            return OrderKind::clears_p_fnc;
        case Number::clear_v_soll:
            return OrderKind::stop;
        case Number::move_p7_by_p_fnc:
        case Number::move_p8_by_p_fnc:
        case Number::move_p7_by_p_soll:
        case Number::move_p8_by_p_soll:
            return OrderKind::moves_by;
        case Number::use_set_1:
        case Number::use_set_2:
        case Number::use_set_3:
        case Number::use_set_4:
            return OrderKind::set;
        case Number::home:
            return OrderKind::home;
        case Number::positions_absolute:
            return OrderKind::absolute;
        case Number::positions_relative_p_soll:
        case Number::positions_relative_p_fnc:
            return OrderKind::relative;
        case Number::clear_t_soll:
        case Number::clear_in_pos:
        case Number::rapid_communication:
        case Number::safe_communication:
        case Number::transmit_slowly:
        case Number::transmit_address:
        case Number::use_fastmac:
        case Number::use_flexmac:
            return OrderKind::service;
        case Number::nop:
            break;
    }
    return OrderKind::nothing;
}

}  // namespace

OrderKind kind_of_mode(std::uint32_t mode) {
    using enum OrderKind;
    constexpr std::array<OrderKind, 25> kModes = {
        init,  run,   place,     run,  drive, analogue_run, analogue_run, drive,        drive,
        drive, drive, stop_mode, home, home,  home,         other_mode,   analogue_run, run,
        run,   run,   run,       run,  drive, drive,        run};
    return mode < kModes.size() ? kModes[mode] : other_mode;
}

OrderKind kind_of(const MotorOrder& order) {
    if (order.is_register_write) return kind_of_write(order);
    const Command command = protocol::fastmac::decode_command(order.command);
    switch (command.mode) {
        case Mode::init:
            return OrderKind::init;
        case Mode::velocity:
            return OrderKind::run;
        case Mode::position:
            return command.group == Group::p ? OrderKind::place : OrderKind::hold;
        case Mode::command:
            break;
    }
    return kind_of_number(static_cast<Number>(command.number));
}

bool is_silent(OrderKind kind) {
    return kind == OrderKind::analogue_run || kind == OrderKind::drive || kind == OrderKind::stop_mode ||
           kind == OrderKind::other_mode;
}

MotionEffect effect_of(OrderKind kind) {
    switch (kind) {
        case OrderKind::init:
        case OrderKind::stop_mode:
            return MotionEffect::init;
        case OrderKind::run:
        case OrderKind::analogue_run:  // V_SOLL = 0 stops these too
            return MotionEffect::run;
        case OrderKind::place:
        case OrderKind::moves_by:
        case OrderKind::set:
            return MotionEffect::place;
        case OrderKind::hold:
            return MotionEffect::hold;
        case OrderKind::home:
            return MotionEffect::home;
        case OrderKind::drive:
            return MotionEffect::drive;
        case OrderKind::stop:
            return MotionEffect::stop;
        case OrderKind::speed:
            return MotionEffect::speed;
        case OrderKind::clears_p_soll:
        case OrderKind::clears_p_fnc:
        case OrderKind::target:
            return MotionEffect::target;
        case OrderKind::nothing:
        case OrderKind::service:
        case OrderKind::reset_error:
        case OrderKind::clears_p_ist:
        case OrderKind::absolute:
        case OrderKind::relative:
        case OrderKind::other_mode:
            break;
    }
    return MotionEffect::none;
}

std::uint8_t selected_register(const MotorOrder& order) {
    if (order.is_register_write) return 0;
    const Command command = protocol::fastmac::decode_command(order.command);
    if (command.mode == Mode::command) return 0;
    constexpr std::array<std::uint8_t, 6> kFirst = {49, 65, 73, 77, 81, 85};  // P V A T L Z
    const unsigned spacing = command.group == Group::p ? 2 : 1;
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
    if (kind_of(order) == OrderKind::set) {
        const Command command = protocol::fastmac::decode_command(order.command);
        return velocity(command.number - static_cast<unsigned>(Number::use_set_1) + 1U);
    }
    return velocity(selected_register(order) - std::uint32_t{registers::V1} + 1);
}

bool may_reset_error(const MotorOrder& order) {
    const bool reaches = order.is_register_write && order.longword && order.reg == registers::ERR_STAT - 1;
    return reaches || kind_of(order) == OrderKind::reset_error;
}

}  // namespace nplc::table
