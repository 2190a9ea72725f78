#pragma once

#include <optional>
#include <string>
#include <variant>

#include "fmu_command.h"
#include "run_command.h"

namespace nplc::sim {

struct ScanOptions {
    std::string table;
    std::string stimulus;
};

/// Help or version was requested and printed.
struct NothingToDo {};

/// A text to be printed.
struct Page {
    std::string text;
};

using CommandLine = std::variant<RunOptions, ScanOptions, FmuCommand, Page, NothingToDo>;

/// Throws InputError.
CommandLine parse_command_line(int argc, const char* const* argv);

}  // namespace nplc::sim
