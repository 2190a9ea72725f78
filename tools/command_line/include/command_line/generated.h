#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "command_line/program.h"

namespace nplc::command_line {

/// What the command line's description does not tell.
struct About {
    std::string version;
    std::string title;                    ///< "a NanoPLC gateway from a terminal"
    int section = 1;                      ///< of the manual
    std::set<std::string> file_commands;  ///< whose arguments are files
    std::set<std::string> file_options;   ///< with their dashes, beside --port
    /// Words that a command's arguments may be, as names of registers. One of a group is "group command",
    /// here and in `file_commands`.
    std::map<std::string, std::vector<std::string>> words{};
};

/// Adds `completion` and `man`, written from the command line's own description.
void add_generated(arguments::App& app, Common& common, About about);

}  // namespace nplc::command_line
