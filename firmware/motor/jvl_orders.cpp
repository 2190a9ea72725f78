#include "motor/jvl_orders.h"

#include "protocol/fastmac.h"

namespace nplc::motor {
namespace {

using protocol::fastmac::Command;
using protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;

constexpr std::uint8_t old_base(Group group) {
    switch (group) {
        case Group::a:
            return 0b00000;
        case Group::t:
            return 0b00100;
        case Group::l:
            return 0b01000;
        case Group::z:
            return 0b01100;
        case Group::v:
            return 0b10000;
        case Group::p:
            return 0b11000;
    }
    return 0;
}

bool number_moves(Number number) {
    switch (number) {
        case Number::clear_p_ist:
        case Number::clear_v_soll:
        case Number::clear_t_soll:
        case Number::move_p7_by_p_fnc:
        case Number::move_p8_by_p_fnc:
        case Number::home:
        case Number::move_p7_by_p_soll:
        case Number::move_p8_by_p_soll:
            return true;
        default:
            return false;
    }
}

}  // namespace

bool makes_in_position_stale(const Order& order) {
    if (order.is_register_write) return true;
    const Command command = protocol::fastmac::decode_command(order.command);
    if (command.mode == Mode::command) return number_moves(static_cast<Number>(command.number));
    return command.group != Group::p;
}

std::uint8_t in_old_code(std::uint8_t command) {
    const Command decoded = protocol::fastmac::decode_command(command);
    if (decoded.mode == Mode::command) return command;
    return static_cast<std::uint8_t>((command & 0x60) | old_base(decoded.group) | (decoded.index - 1));
}

}  // namespace nplc::motor
