#include "semantics/commands.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "syntax/names.h"

namespace nplc::seqc {
namespace {

using protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;

constexpr std::string_view kLink =
    "leave it out: it would change how the gateway and the motor talk, which is the gateway's own business";

constexpr std::array kCommands = {
    NamedCommand{"NOP", Number::nop, {}},
    NamedCommand{"RESET_ERROR", Number::reset_error, {}},
    NamedCommand{"CLEAR_P_SOLL", Number::clear_p_soll, {}},
    NamedCommand{"CLEAR_P_IST", Number::clear_p_ist, {}},
    NamedCommand{"CLEAR_P_FNC", Number::clear_p_fnc, {}},
    NamedCommand{"STOP", Number::clear_v_soll, {}},
    NamedCommand{"CLEAR_T_SOLL", Number::clear_t_soll, {}},
    NamedCommand{"CLEAR_IN_POS", Number::clear_in_pos, {}},
    NamedCommand{"MOVE_P7_BY_P_FNC", Number::move_p7_by_p_fnc, {}},
    NamedCommand{"MOVE_P8_BY_P_FNC", Number::move_p8_by_p_fnc, {}},
    NamedCommand{"RAPID_COMMUNICATION", Number::rapid_communication, kLink},
    NamedCommand{"SAFE_COMMUNICATION", Number::safe_communication, kLink},
    NamedCommand{"HOME", Number::home, {}},
    NamedCommand{"MOVE_P7_BY_P_SOLL", Number::move_p7_by_p_soll, {}},
    NamedCommand{"MOVE_P8_BY_P_SOLL", Number::move_p8_by_p_soll, {}},
    NamedCommand{"TRANSMIT_SLOWLY", Number::transmit_slowly, kLink},
    NamedCommand{"POSITIONS_ABSOLUTE", Number::positions_absolute, {}},
    NamedCommand{"POSITIONS_RELATIVE_P_SOLL", Number::positions_relative_p_soll, {}},
    NamedCommand{"POSITIONS_RELATIVE_P_FNC", Number::positions_relative_p_fnc, {}},
    NamedCommand{"TRANSMIT_ADDRESS", Number::transmit_address, {}},
    NamedCommand{"USE_FASTMAC", Number::use_fastmac, kLink},
    NamedCommand{"USE_FLEXMAC", Number::use_flexmac, kLink},
};

/// The register numbers of each group.
struct GroupPlace {
    Group group;
    std::uint8_t first_register;
    std::uint8_t spacing;
    std::uint8_t count;
    char letter;
};

constexpr std::array kGroups = {
    GroupPlace{Group::p, 49, 2, 8, 'P'}, GroupPlace{Group::v, 65, 1, 8, 'V'},
    GroupPlace{Group::a, 73, 1, 4, 'A'}, GroupPlace{Group::t, 77, 1, 4, 'T'},
    GroupPlace{Group::l, 81, 1, 4, 'L'}, GroupPlace{Group::z, 85, 1, 4, 'Z'},
};

constexpr std::array kModeNames = {
    std::pair{std::string_view("INIT"), Mode::init},
    std::pair{std::string_view("VELOCITY"), Mode::velocity},
    std::pair{std::string_view("POSITION"), Mode::position},
};

std::string describe_number(std::uint8_t number) {
    if (number >= 0x0C && number <= 0x0F) return fmt::format("USE_SET({})", number - 0x0C + 1);
    for (const NamedCommand& command : kCommands) {
        if (static_cast<std::uint8_t>(command.number) == number) return std::string(command.name);
    }
    return fmt::format("NOP (number 16#{:02X})", number);
}

}  // namespace

const NamedCommand* find_command(std::string_view name) {
    for (const NamedCommand& command : kCommands) {
        if (same_name(command.name, name)) return &command;
    }
    return nullptr;
}

std::vector<std::string_view> command_names() {
    std::vector<std::string_view> names = {"USE_SET", "COUNT_DOWN", "CLEAR_COUNTER"};
    for (const auto& mode : kModeNames) names.push_back(mode.first);
    for (const NamedCommand& command : kCommands) {
        if (command.refusal.empty()) names.push_back(command.name);
    }
    return names;
}

std::optional<Mode> mode_named(std::string_view name) {
    for (const auto& mode : kModeNames) {
        if (same_name(mode.first, name)) return mode.second;
    }
    return std::nullopt;
}

std::optional<Selection> selection_of(std::uint8_t register_number) {
    for (const GroupPlace& place : kGroups) {
        const int offset = register_number - place.first_register;
        if (offset >= 0 && offset % place.spacing == 0 && offset / place.spacing < place.count) {
            return Selection{place.group, static_cast<std::uint8_t>(offset / place.spacing + 1)};
        }
    }
    return std::nullopt;
}

char letter_of(Group group) {
    return kGroups[static_cast<std::size_t>(group)].letter;
}

std::string register_name(Selection selection) {
    return fmt::format("{}{}", letter_of(selection.group), selection.index);
}

std::string shown_register(const Symbols& symbols, Selection selection) {
    for (const MotorName& named : symbols.motor_names) {
        const auto own = selection_of(named.number);
        if (own && own->group == selection.group && own->index == selection.index) return named.name;
    }
    return register_name(selection);
}

std::optional<SelectCommand> select_command(std::uint8_t command) {
    const auto decoded = protocol::fastmac::decode_command(command);
    if (decoded.mode == Mode::command) return std::nullopt;
    return SelectCommand{decoded.mode, {decoded.group, decoded.index}};
}

std::uint8_t command_byte(Mode mode, Selection selection) {
    return protocol::fastmac::encode_command(
        {.mode = mode, .group = selection.group, .index = selection.index});
}

std::string describe_command(std::uint8_t command) {
    const std::optional<SelectCommand> select = select_command(command);
    if (!select) return describe_number(command & 0x1F);
    return fmt::format("{}({})", kModeNames[static_cast<std::size_t>(select->mode)].first,
                       register_name(select->selection));
}

std::string statement_text(std::string_view source, Span statement) {
    std::string text;
    for (const char c : source.substr(statement.offset, statement.length)) {
        const bool is_blank = c == ' ' || (c >= '\t' && c <= '\r');
        if (!is_blank || (!text.empty() && text.back() != ' ')) text += is_blank ? ' ' : c;
    }
    return text;
}

}  // namespace nplc::seqc
