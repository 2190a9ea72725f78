#include "cli/common.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "host/paths.h"
#include "host/printable.h"
#include "host/terminal.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc::cli {

namespace fs = std::filesystem;

ColourChoice& colour_choice() {
    static ColourChoice choice = ColourChoice::automatic;
    return choice;
}

Colour colour_of(std::FILE* stream) {
    const ColourChoice choice = colour_choice();
    if (choice != ColourChoice::automatic) return choice == ColourChoice::always ? Colour::on : Colour::off;
    const char* refused = std::getenv("NO_COLOR");
    const bool wanted = (refused == nullptr || *refused == '\0') && host::is_terminal(stream);
    return wanted ? Colour::on : Colour::off;
}

std::string painted(std::FILE* stream, std::string_view code, std::string_view text) {
    if (colour_of(stream) == Colour::off) return std::string(text);
    return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
}

int file_problem(const std::string& message) {
    host::complain("seqc: " + message);
    return kUsageOrFile;
}

void print_diagnostics(const Compilation& compilation, const Sources& sources) {
    std::fputs(render_all(compilation, sources, colour_of(stderr)).c_str(), stderr);
}

bool is_same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    const fs::path first = host::path_of(a);
    const fs::path second = host::path_of(b);
    return fs::equivalent(first, second, error) || first.lexically_normal() == second.lexically_normal();
}

int print_or_write(const std::string& text, const std::string& output) {
    if (output.empty() || output == "-") {
        fmt::print("{}", text);
        return std::fflush(stdout) == 0 ? kOk : file_problem("cannot write to standard output");
    }
    const std::string error = whole_files::write_files({{output, text}});
    return error.empty() ? kOk : file_problem(error);
}

}  // namespace nplc::seqc::cli
