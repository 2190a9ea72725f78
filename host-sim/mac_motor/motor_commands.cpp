#include "sim/motor_commands.h"

namespace nplc::sim {

namespace fastmac = protocol::fastmac;

void MotorCommands::execute(const fastmac::Command& command) {
    if (command.mode == fastmac::Mode::command) {
        return execute_number(static_cast<fastmac::Number>(command.number));
    }
    select(command.group, command.index);
    modes_.request_mode(
        static_cast<std::uint16_t>(command.mode));  // init, velocity and position have MODE_REG's numbers
}

// 001 §5.2.1.4. The link's own commands do not come here.
void MotorCommands::execute_number(fastmac::Number number) {
    const auto set_p_fnc = [&](int n) {
        const std::int64_t follow_error = memory_.get(cell::FLWERR);
        memory_.set(cell::P_FNC, wrap32((follow_error - memory_.get(cell::P1[n - 1])) * 16));
    };
    const auto set_p_soll = [&](int n) {
        memory_.set(cell::P_SOLL, wrap32(std::int64_t{state_.p_ist()} + memory_.get(cell::P1[n - 1]) -
                                         memory_.get(cell::FLWERR)));
    };
    using enum fastmac::Number;
    switch (number) {
        case reset_error:
            return state_.set_error_bits(state_.bits().resettable, false);
        case clear_p_soll:
            memory_.set(cell::P_SOLL, 0);
            return profile_.clear_in_position();
        case clear_p_ist:
            return memory_.set(cell::P_IST, 0);
        case clear_p_fnc:
            memory_.set(cell::P_FNC, 0);
            return profile_.clear_in_position();
        case clear_v_soll:
            return memory_.set(cell::V_SOLL, 0);
        case clear_t_soll:
            return memory_.set(cell::T_SOLL, 0);
        case clear_in_pos:
            return profile_.clear_in_position();
        case move_p7_by_p_fnc:
            return set_p_fnc(7);
        case move_p8_by_p_fnc:
            return set_p_fnc(8);
        case use_set_1:
            return select_set(1);
        case use_set_2:
            return select_set(2);
        case use_set_3:
            return select_set(3);
        case use_set_4:
            return select_set(4);
        case home:
            return modes_.request_home();
        case move_p7_by_p_soll:
            return set_p_soll(7);
        case move_p8_by_p_soll:
            return set_p_soll(8);
        case positions_absolute:
            return set_relative(false, false);
        case positions_relative_p_soll:
            return set_relative(true, false);
        case positions_relative_p_fnc:
            return set_relative(false, true);
        default:
            return;
    }
}

void MotorCommands::select(fastmac::Group group, int index) {
    switch (group) {
        case fastmac::Group::p:
            return profile_.select_position(index);
        case fastmac::Group::v:
            return copy(cell::V1[index - 1], cell::V_SOLL);
        case fastmac::Group::a:
            return copy(cell::A1[index - 1], cell::A_SOLL);
        case fastmac::Group::t:
            return copy(cell::T1[index - 1], cell::T_SOLL);
        case fastmac::Group::l:
            return copy(cell::L1[index - 1], cell::KVOUT);
        case fastmac::Group::z:
            return copy(cell::Z1[index - 1], cell::INPOSWIN);
    }
}

void MotorCommands::select_set(int index) {
    using enum fastmac::Group;
    for (const auto group : {p, v, a, t, l, z}) select(group, index);
}

// 001 §3.2.43 - 48. R: a pointer out of range is not changed and has no effect.
void MotorCommands::act_on_pointers() {
    using enum fastmac::Group;
    struct Pointer {
        Cell cell;
        fastmac::Group group;
        int registers;
    };
    for (const auto& [pointer, group, registers] :
         {Pointer{cell::P_REG_P, p, 8}, Pointer{cell::V_REG_P, v, 8}, Pointer{cell::A_REG_P, a, 4},
          Pointer{cell::T_REG_P, t, 4}, Pointer{cell::L_REG_P, l, 4}, Pointer{cell::Z_REG_P, z, 4}}) {
        const std::int32_t index = memory_.get(pointer);
        if (index < 1 || index > registers) continue;
        select(group, index);
        memory_.set(pointer, 0);
    }
}

void MotorCommands::set_relative(bool p_soll, bool p_fnc) {
    const Cell where = state_.bits().relpos_in_cntrl_bits ? cell::CNTRL_BITS : cell::ERR_STAT;
    auto flags = static_cast<std::uint32_t>(memory_.get(where));
    flags &= ~(state_.bits().relpos_p_soll | state_.bits().relpos_p_fnc);
    if (p_soll) flags |= state_.bits().relpos_p_soll;
    if (p_fnc) flags |= state_.bits().relpos_p_fnc;
    memory_.set(where, static_cast<std::int32_t>(flags));
}

}  // namespace nplc::sim
