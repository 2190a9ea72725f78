#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "seqc/diagnostic.h"
#include "seqc/seqc.h"
#include "table/commands.h"

/// The motor's commands as words of the language; what their bytes say is in table/commands.h.
namespace nplc::seqc {

using table::describe_command;
using table::letter_of;
using table::NamedCommand;
using table::register_name;
using table::select_command;
using table::SelectCommand;
using table::Selection;
using table::selection_of;

/// Null if no command has this name.
const NamedCommand* find_command(std::string_view name);
/// Why a sequence may not send a command of the link.
extern const std::string_view kLinkRefusal;
std::vector<std::string_view> command_names();

/// INIT, VELOCITY or POSITION.
std::optional<table::Mode> mode_named(std::string_view name);

/// The program's name of the register.
std::string shown_register(const Symbols& symbols, Selection selection);

/// A statement as written, in one line.
std::string statement_text(std::string_view source, Span statement);

}  // namespace nplc::seqc
