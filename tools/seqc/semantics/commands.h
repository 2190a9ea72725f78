#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/fastmac.h"
#include "seqc/diagnostic.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// A command-mode command by its name in the language (001 §5.2.1.4).
struct NamedCommand {
    std::string_view name;
    protocol::fastmac::Number number;
    std::string_view refusal;  ///< why a sequence may not send it; empty if allowed
};

const NamedCommand* find_command(std::string_view name);
std::vector<std::string_view> command_names();

/// INIT, VELOCITY or POSITION.
std::optional<protocol::fastmac::Mode> mode_named(std::string_view name);

/// A register that a FastMAC byte can select, out of 49..88.
struct Selection {
    protocol::fastmac::Group group;
    std::uint8_t index;  ///< 1..8
};

std::optional<Selection> selection_of(std::uint8_t register_number);
/// P, V, A, T, L or Z.
char letter_of(protocol::fastmac::Group group);
/// "V1".
std::string register_name(Selection selection);

/// The program's name of the register.
std::string shown_register(const Symbols& symbols, Selection selection);

/// A decoded selecting command; empty for a command-mode byte.
struct SelectCommand {
    protocol::fastmac::Mode mode;
    Selection selection;
};

std::optional<SelectCommand> select_command(std::uint8_t command);
std::uint8_t command_byte(protocol::fastmac::Mode mode, Selection selection);

/// As written in a program: "POSITION(P2)", "STOP", "NOP".
std::string describe_command(std::uint8_t command);

/// A statement as written, in one line.
std::string statement_text(std::string_view source, Span statement);

}  // namespace nplc::seqc
