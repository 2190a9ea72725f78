#include "semantics/orders.h"

#include "semantics/commands.h"

namespace nplc::seqc {
namespace {

using protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;

MotionEffect motion_effect_of_mode(std::uint32_t mode) {
    constexpr std::uint32_t kTorque = 4;
    if (mode == 0) return MotionEffect::init;
    if (mode == 2) return MotionEffect::place;
    if (mode >= 12 && mode <= 14) return MotionEffect::home;
    return mode == kTorque ? MotionEffect::drive : MotionEffect::run;
}

MotionEffect motion_effect_of_write(const Send& send) {
    switch (send.reg->number) {
        case registers::MODE_REG:
            return motion_effect_of_mode(send.value);
        case registers::V_SOLL:
            return send.value == 0 && send.set_point == 0 ? MotionEffect::stop : MotionEffect::speed;
        case registers::V_REG_P:
            return MotionEffect::speed;
        default:
            return MotionEffect::none;
    }
}

MotionEffect motion_effect_of_number(Number number) {
    switch (number) {
        case Number::clear_p_soll:
        case Number::clear_p_fnc:
            return MotionEffect::target;
        case Number::clear_v_soll:
            return MotionEffect::stop;
        case Number::home:
            return MotionEffect::home;
        case Number::move_p7_by_p_fnc:
        case Number::move_p8_by_p_fnc:
        case Number::move_p7_by_p_soll:
        case Number::move_p8_by_p_soll:
        case Number::use_set_1:
        case Number::use_set_2:
        case Number::use_set_3:
        case Number::use_set_4:
            return MotionEffect::place;
        default:
            return MotionEffect::none;
    }
}

}  // namespace

MotionEffect motion_effect_of(const Send& send) {
    if (send.reg != nullptr) return motion_effect_of_write(send);
    const auto select = select_command(send.command);
    if (!select) return motion_effect_of_number(static_cast<Number>(send.command & 0x1F));
    if (select->mode == Mode::init) return MotionEffect::init;
    if (select->mode == Mode::velocity) return MotionEffect::run;
    return select->selection.group == Group::p ? MotionEffect::place : MotionEffect::hold;
}

const Send* motion_of(const Rule& rule) {
    for (const Send& send : rule.action.sends) {
        if (moves(motion_effect_of(send))) return &send;
    }
    return nullptr;
}

}  // namespace nplc::seqc
