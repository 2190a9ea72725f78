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

/// When output carries a terminal's colours: `automatic` is when it goes to a terminal and the environment
/// does not set NO_COLOR. For the whole run; `main` sets it from --color.
enum class ColourChoice : std::uint8_t { automatic, always, never };
ColourChoice& colour_choice();
Colour colour_of(std::FILE* stream);

/// The text in the colour of a terminal's code, such as "1;31", if the stream is to carry colours.
std::string painted(std::FILE* stream, std::string_view code, std::string_view text);

/// One line on standard error, and the exit code that belongs to it.
int file_problem(const std::string& message);

/// Diagnostics and their number on standard error.
void print_diagnostics(const Compilation& compilation, const Sources& sources);

/// Whether two names lead to the same file, which need not exist yet.
bool is_same_file(const std::string& a, const std::string& b);

/// Text to standard output, or to a file if `output` names one ("" and "-" do not).
int print_or_write(const std::string& text, const std::string& output);

}  // namespace nplc::seqc::cli
