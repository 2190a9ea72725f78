#include "faces/command.h"

#include <algorithm>

#include "registers/gateway.h"
#include "registers/mac.h"

namespace nplc::faces {

namespace gw = registers::gateway;

std::string describe(const Completion& completion) {
    if (completion.result != Result::stop_unconfirmed) return std::string(gw::describe(completion.result));
    return completion.is_axis_silent
               ? "not confirmed: the motor may be moving; the axis does not answer"
               : "not confirmed: the motor may be moving; mend its supply or line, or give the stop up";
}

Command Command::of(gw::Command command, base::Instant origin) {
    return own(gw::COMMAND, static_cast<std::uint32_t>(command), origin);
}

Command Command::own(std::uint8_t reg, std::uint32_t value, base::Instant origin) {
    Command result;
    result.reg = reg;
    result.value = value;
    result.origin = origin;
    return result;
}

Command Command::table_piece(std::span<const std::uint8_t> piece, base::Instant origin) {
    Command result = own(gw::TABLE_DATA, 0, origin);
    result.size = static_cast<std::uint8_t>(std::min(piece.size(), result.data.size()));
    std::copy_n(piece.begin(), result.size, result.data.begin());
    return result;
}

Command Command::set_points(std::span<const std::uint8_t> request, gw::Origin from, base::Instant origin) {
    Command result = table_piece(request, origin);
    result.reg = gw::SET_POINT_WRITE;
    result.from = from;
    return result;
}

Command Command::motor_write(std::uint8_t reg, bool longword, std::uint32_t value, base::Instant origin) {
    Command result = own(reg, value, origin);
    result.kind = Kind::write_motor;
    result.longword = longword;
    return result;
}

Command Command::reset_error(base::Instant origin) {
    Command result = own(registers::ERR_STAT, 0, origin);
    result.kind = Kind::reset_error;
    return result;
}

Command Command::motor_read(std::uint8_t reg, bool longword, base::Instant origin) {
    Command result = motor_write(reg, longword, 0, origin);
    result.kind = Kind::read_motor;
    return result;
}

bool Command::is_stop() const {
    return kind == Kind::write_own && reg == gw::COMMAND && size == 0 &&
           (value == static_cast<std::uint32_t>(gw::Command::stop) ||
            value == static_cast<std::uint32_t>(gw::Command::safe) ||
            value == static_cast<std::uint32_t>(gw::Command::hold));
}

bool Command::operates() const {
    switch (kind) {
        case Kind::write_own:
            return !is_stop() && !(size == 0 && gw::is_for_everybody(reg, value));
        case Kind::write_motor:
        case Kind::reset_error:
        case Kind::take_seat:
        case Kind::take_over_seat:
            return true;
        case Kind::read_motor:
        case Kind::leave_seat:
            return false;
    }
    return true;
}

}  // namespace nplc::faces
