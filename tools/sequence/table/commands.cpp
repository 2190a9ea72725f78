#include "table/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace nplc::table {
namespace {

namespace fastmac = protocol::fastmac;
using fastmac::Command;
using fastmac::Number;

constexpr NamedCommand named(std::string_view name, Number number, bool is_of_link = false) {
    return {name, fastmac::command_byte(number), is_of_link};
}

constexpr std::array kCommands = {
    named("NOP", Number::nop),
    named("RESET_ERROR", Number::reset_error),
    named("CLEAR_P_SOLL", Number::clear_p_soll),
    named("CLEAR_P_IST", Number::clear_p_ist),
    named("CLEAR_P_FNC", Number::clear_p_fnc),
    named("STOP", Number::clear_v_soll),
    named("CLEAR_T_SOLL", Number::clear_t_soll),
    named("CLEAR_IN_POS", Number::clear_in_pos),
    named("MOVE_P7_BY_P_FNC", Number::move_p7_by_p_fnc),
    named("MOVE_P8_BY_P_FNC", Number::move_p8_by_p_fnc),
    named("RAPID_COMMUNICATION", Number::rapid_communication, true),
    named("SAFE_COMMUNICATION", Number::safe_communication, true),
    named("HOME", Number::home),
    named("MOVE_P7_BY_P_SOLL", Number::move_p7_by_p_soll),
    named("MOVE_P8_BY_P_SOLL", Number::move_p8_by_p_soll),
    named("TRANSMIT_SLOWLY", Number::transmit_slowly, true),
    named("POSITIONS_ABSOLUTE", Number::positions_absolute),
    named("POSITIONS_RELATIVE_P_SOLL", Number::positions_relative_p_soll),
    named("POSITIONS_RELATIVE_P_FNC", Number::positions_relative_p_fnc),
    named("TRANSMIT_ADDRESS", Number::transmit_address),
    named("USE_FASTMAC", Number::use_fastmac, true),
    named("USE_FLEXMAC", Number::use_flexmac, true),
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

std::optional<Number> number_of(std::uint8_t command) {
    const Command decoded = fastmac::decode_command(command);
    return decoded.mode == Mode::command ? std::optional(static_cast<Number>(decoded.number)) : std::nullopt;
}

}  // namespace

std::optional<Selection> selection_of(std::uint8_t register_number) {
    for (const GroupPlace& place : kGroups) {
        const int offset = register_number - place.first_register;
        if (offset >= 0 && offset % place.spacing == 0 && offset / place.spacing < place.count) {
            return Selection{place.group, static_cast<std::uint8_t>(offset / place.spacing + 1)};
        }
    }
    return std::nullopt;
}

std::uint8_t register_of(Selection selection) {
    const GroupPlace& place = kGroups[static_cast<std::size_t>(selection.group)];
    return static_cast<std::uint8_t>(place.first_register + place.spacing * (selection.index - 1));
}

char letter_of(Group group) {
    return kGroups[static_cast<std::size_t>(group)].letter;
}

std::string register_name(Selection selection) {
    return fmt::format("{}{}", letter_of(selection.group), selection.index);
}

std::optional<SelectCommand> select_command(std::uint8_t command) {
    const Command decoded = fastmac::decode_command(command);
    if (decoded.mode == Mode::command) return std::nullopt;
    return SelectCommand{decoded.mode, {decoded.group, decoded.index}};
}

std::uint8_t command_byte(Mode mode, Selection selection) {
    return fastmac::encode_command({.mode = mode, .group = selection.group, .index = selection.index});
}

std::string_view name_of(Mode mode) {
    constexpr std::array<std::string_view, 3> kNames = {"INIT", "VELOCITY", "POSITION"};
    return kNames.at(static_cast<std::size_t>(mode));
}

std::span<const NamedCommand> named_commands() {
    return kCommands;
}

const NamedCommand* named_command(std::uint8_t command) {
    const auto found = std::find_if(kCommands.begin(), kCommands.end(), [&](const NamedCommand& one) {
        return one.command == (command & fastmac::kCommandBits);
    });
    return found == kCommands.end() ? nullptr : &*found;
}

bool has_name(std::uint8_t command) {
    return select_command(command) || set_used(command) || named_command(command) != nullptr;
}

std::optional<std::uint8_t> set_used(std::uint8_t command) {
    const std::optional<Number> number = number_of(command);
    if (!number || *number < Number::use_set_1 || *number > Number::use_set_4) return std::nullopt;
    return static_cast<std::uint8_t>(static_cast<unsigned>(*number) -
                                     static_cast<unsigned>(Number::use_set_1) + 1U);
}

std::uint8_t use_set(std::uint8_t set) {
    return static_cast<std::uint8_t>(fastmac::command_byte(Number::use_set_1) + set - 1);
}

std::optional<RelativeMove> relative_move(std::uint8_t command) {
    switch (number_of(command).value_or(Number::nop)) {
        case Number::move_p7_by_p_fnc:
            return RelativeMove{7, false};
        case Number::move_p8_by_p_fnc:
            return RelativeMove{8, false};
        case Number::move_p7_by_p_soll:
            return RelativeMove{7, true};
        case Number::move_p8_by_p_soll:
            return RelativeMove{8, true};
        default:
            return std::nullopt;
    }
}

std::uint8_t command_numbered(std::uint8_t number) {
    return fastmac::command_byte(static_cast<Number>(number));
}

std::string describe_command(std::uint8_t command) {
    if (const auto select = select_command(command))
        return fmt::format("{}({})", name_of(select->mode), register_name(select->selection));
    if (const auto set = set_used(command)) return fmt::format("USE_SET({})", *set);
    if (const NamedCommand* own = named_command(command)) return std::string(own->name);
    return fmt::format("NOP (number 16#{:02X})", fastmac::decode_command(command).number);
}

LineChange line_change_of(std::uint8_t command) {
    switch (number_of(command).value_or(Number::nop)) {
        case Number::use_flexmac:
            return LineChange::flexmac;
        case Number::safe_communication:
            return LineChange::safe;
        case Number::rapid_communication:
            return LineChange::rapid;
        default:
            return LineChange::none;
    }
}

std::uint8_t use_flexmac() {
    return fastmac::command_byte(Number::use_flexmac);
}

}  // namespace nplc::table
