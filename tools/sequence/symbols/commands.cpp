#include "symbols/commands.h"

#include <array>

#include "language/names.h"

namespace nplc::seqc {
namespace {

constexpr std::array kModes = {table::Mode::init, table::Mode::velocity, table::Mode::position};

}  // namespace

const std::string_view kLinkRefusal =
    "leave it out: it would change how the gateway and the motor talk, which only the gateway may change";

const NamedCommand* find_command(std::string_view name) {
    for (const NamedCommand& command : table::named_commands()) {
        if (same_name(command.name, name)) return &command;
    }
    return nullptr;
}

std::vector<std::string_view> command_names() {
    std::vector<std::string_view> names = {"USE_SET", "COUNT_DOWN", "CLEAR_COUNTER"};
    for (const table::Mode mode : kModes) names.push_back(table::name_of(mode));
    for (const NamedCommand& command : table::named_commands()) {
        if (!command.is_of_link) names.push_back(command.name);
    }
    return names;
}

std::optional<table::Mode> mode_named(std::string_view name) {
    for (const table::Mode mode : kModes) {
        if (same_name(table::name_of(mode), name)) return mode;
    }
    return std::nullopt;
}

std::string shown_register(const Symbols& symbols, Selection selection) {
    for (const MotorName& named : symbols.motor_names) {
        if (named.number == table::register_of(selection)) return named.name;
    }
    return register_name(selection);
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
