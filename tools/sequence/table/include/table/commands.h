#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/fastmac.h"

/// FastMAC commands by the manual's names (001 §5.2.1.4). Bit 7, the toggle, is ignored.
namespace nplc::table {

using protocol::fastmac::Group;
using protocol::fastmac::Mode;

/// A register that a command can select, out of 49..88.
struct Selection {
    Group group;
    std::uint8_t index;  ///< 1..8
};

std::optional<Selection> selection_of(std::uint8_t register_number);
std::uint8_t register_of(Selection selection);
/// P, V, A, T, L or Z.
char letter_of(Group group);
/// "V1".
std::string register_name(Selection selection);

/// INIT, VELOCITY or POSITION with a register.
struct SelectCommand {
    Mode mode;
    Selection selection;
};

/// Empty for what selects no register of its own.
std::optional<SelectCommand> select_command(std::uint8_t command);
std::uint8_t command_byte(Mode mode, Selection selection);
/// "INIT", "VELOCITY" or "POSITION".
std::string_view name_of(Mode mode);

/// A command with a name of its own: all but those of Mode and USE_SET.
struct NamedCommand {
    std::string_view name;
    std::uint8_t command;
    bool is_of_link = false;  ///< changes how gateway and motor talk
};

std::span<const NamedCommand> named_commands();
/// Null if it has no name of its own.
const NamedCommand* named_command(std::uint8_t command);
/// False for 17h - 1Ch, which are further NOPs.
bool has_name(std::uint8_t command);

/// 1..4 of USE_SET(n).
std::optional<std::uint8_t> set_used(std::uint8_t command);
std::uint8_t use_set(std::uint8_t set);

/// MOVE_P7_BY_P_SOLL and its like.
struct RelativeMove {
    std::uint8_t index;  ///< of the distance: P7 or P8
    bool from_p_soll;    ///< else from P_FNC
};
std::optional<RelativeMove> relative_move(std::uint8_t command);

/// Command mode's command with this number.
inline constexpr unsigned kCommandNumbers = 32;
std::uint8_t command_numbered(std::uint8_t number);

/// As written in a program: "POSITION(P2)", "STOP", "NOP (number 16#17)".
std::string describe_command(std::uint8_t command);

/// Commands that change the protocol on the line.
enum class LineChange : std::uint8_t { none, flexmac, safe, rapid };
LineChange line_change_of(std::uint8_t command);
std::uint8_t use_flexmac();

}  // namespace nplc::table
