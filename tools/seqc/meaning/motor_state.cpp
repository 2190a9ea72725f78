#include "meaning/motor_state.h"

#include <algorithm>
#include <array>

#include "meaning/commands.h"

namespace nplc::seqc {
namespace {

using protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;

void apply_mode(std::uint32_t mode, Span span, MotorState& state) {
    state.modes = mode == 0 ? kInit : mode == 1 ? kVelocity : mode == 2 ? kPosition : kOther;
    if (mode == 0) state.init = span;
    state.homing = is_home_mode(mode);
    state.home = span;
}

void apply_write(const Send& send, MotorState& state) {
    switch (send.reg->number) {
        case registers::MODE_REG:
            apply_mode(send.value, send.span, state);
            break;
        case registers::STARTMODE:
            state.ends_in_position = sets_in_position(send.value);
            state.start_mode = state.ends_in_position ? Span{} : send.span;
            break;
        case registers::V_SOLL:
            state.stopped = send.value == 0;
            state.stop = send.span;
            break;
        case registers::V_REG_P:
            state.stopped = false;
            break;
        default:
            break;
    }
}

void apply_number(Number number, Span span, MotorState& state) {
    switch (number) {
        case Number::clear_v_soll:
            state.stopped = true;
            state.stop = span;
            break;
        case Number::use_set_1:
        case Number::use_set_2:
        case Number::use_set_3:
        case Number::use_set_4:
            state.stopped = false;
            break;
        case Number::home:
            state.modes = kAnyMode;  // STARTMODE takes over when it is done
            state.homing = true;
            state.home = span;
            break;
        default:
            break;
    }
}

}  // namespace

bool sets_in_position(std::uint32_t mode) {
    constexpr std::array<std::uint32_t, 9> kModes = {1, 2, 3, 17, 18, 19, 20, 21, 24};
    return std::find(kModes.begin(), kModes.end(), mode) != kModes.end();
}

bool is_home_mode(std::uint32_t mode) {
    return mode >= 12 && mode <= 14;
}

bool MotorState::join(const MotorState& other) {
    if (modes == 0) {
        *this = other;
        return other.modes != 0;
    }
    const MotorState before = *this;
    if ((modes & kInit) == 0) init = other.init;
    if (!stopped) stop = other.stop;
    if (!homing) home = other.home;
    if (ends_in_position) start_mode = other.start_mode;
    modes |= other.modes;
    stopped = stopped || other.stopped;
    homing = homing || other.homing;
    ends_in_position = ends_in_position && other.ends_in_position;
    return modes != before.modes || stopped != before.stopped || homing != before.homing ||
           ends_in_position != before.ends_in_position;
}

void MotorState::apply(const Send& send) {
    if (send.reg != nullptr) return apply_write(send, *this);
    const auto select = select_command(send.command);
    if (!select) return apply_number(static_cast<Number>(send.command & 0x1F), send.span, *this);
    apply_mode(select->mode == Mode::init ? 0U : select->mode == Mode::velocity ? 1U : 2U, send.span, *this);
    if (select->selection.group == Group::v) stopped = false;
}

}  // namespace nplc::seqc
