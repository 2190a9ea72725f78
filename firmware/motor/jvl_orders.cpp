#include "motor/jvl_orders.h"

#include "protocol/fastmac.h"

namespace nplc::motor {
namespace {

using protocol::fastmac::Command;
using protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;

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

std::uint8_t recoded(std::uint8_t command, protocol::fastmac::RegisterCode code) {
    return protocol::fastmac::encode_command(protocol::fastmac::decode_command(command), code);
}

}  // namespace nplc::motor
