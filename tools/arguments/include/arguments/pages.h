#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "arguments/arguments.h"

namespace nplc::arguments {

/// What the description of the command line does not contain.
struct About {
    std::string version;
    std::string title;                    ///< "a NanoPLC gateway from a terminal"
    int section = 1;                      ///< of the manual
    std::set<std::string> file_commands;  ///< whose arguments are files
    std::set<std::string> file_options;   ///< with their dashes
    /// Words that a command's arguments may be, as names of registers. One of a group is "group command",
    /// here and in `file_commands`.
    std::map<std::string, std::vector<std::string>> words{};
    std::map<std::string, std::vector<std::string>>
        option_words{};  ///< the same of options, with their dashes
};

/// Adds `help`, `completion` and `man`, written from the command line's own description; `print` is given
/// what the last two say.
void add_pages(App& app, About about, const std::function<void(const std::string& text)>& print);

}  // namespace nplc::arguments
