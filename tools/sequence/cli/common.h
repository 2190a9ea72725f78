#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

#include "seqc/seqc.h"

namespace nplc::seqc::cli {

enum Exit : int {
    kOk = 0,
    kProgramHasErrors = 1,
    kUsageOrFile = 2,
};

/// When output is coloured: `automatic` means on a terminal and without NO_COLOR in the environment. For the
/// whole run; `main` sets it from --color.
enum class ColourChoice : std::uint8_t { automatic, always, never };
ColourChoice& colour_choice();
Colour colour_of(std::FILE* stream);

/// The text in a terminal colour such as "1;31", if the stream is to be coloured.
std::string painted(std::FILE* stream, std::string_view code, std::string_view text);

/// Prints one line on standard error; returns its exit code.
int file_problem(const std::string& message);

/// Prints the diagnostics and their number on standard error.
void print_diagnostics(const Compilation& compilation, const Sources& sources);

/// Whether two names refer to the same file, which need not exist yet.
bool is_same_file(const std::string& a, const std::string& b);

/// Prints to standard output, or writes to the file `output` unless that is "" or "-".
int print_or_write(const std::string& text, const std::string& output);

}  // namespace nplc::seqc::cli
