#include "semantics/orders.h"

#include "semantics/commands.h"

namespace nplc::seqc {
namespace {

using protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;

MotionEffect motion_effect_of_mode(std::uint32_t mode) {
    constexpr std::uint32_t kAnalogueTorque = 4;
    if (mode == 0) return MotionEffect::init;
    if (mode == 2) return MotionEffect::place;
    return mode == kAnalogueTorque || (mode >= 12 && mode <= 14) ? MotionEffect::drive : MotionEffect::run;
}

MotionEffect motion_effect_of_number(Number number) {
    switch (number) {
        case Number::clear_v_soll:
            return MotionEffect::stop;
        case Number::home:
            return MotionEffect::drive;
        case Number::move_p7_by_p_fnc:
        case Number::move_p8_by_p_fnc:
        case Number::move_p7_by_p_soll:
        case Number::move_p8_by_p_soll:
            return MotionEffect::place;
        default:
            return MotionEffect::none;
    }
}

}  // namespace

MotionEffect motion_effect_of(const Send& send) {
    if (send.reg != nullptr) {
        if (send.reg->number == registers::MODE_REG) return motion_effect_of_mode(send.value);
        const bool is_stop = send.reg->number == registers::V_SOLL && send.value == 0 && send.set_point == 0;
        return is_stop ? MotionEffect::stop : MotionEffect::none;
    }
    const auto select = select_command(send.command);
    if (!select) return motion_effect_of_number(static_cast<Number>(send.command & 0x1F));
    if (select->mode == Mode::init) return MotionEffect::init;
    if (select->mode == Mode::velocity) return MotionEffect::run;
    return select->selection.group == Group::p ? MotionEffect::place : MotionEffect::none;
}

const Send* motion_of(const Rule& rule) {
    for (const Send& send : rule.action.sends) {
        if (moves(motion_effect_of(send))) return &send;
    }
    return nullptr;
}

}  // namespace nplc::seqc
