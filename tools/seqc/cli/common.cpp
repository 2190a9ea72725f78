#include "cli/common.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "cli/files.h"

namespace nplc::seqc::cli {

namespace fs = std::filesystem;

int file_problem(const std::string& message) {
    fmt::print(stderr, "seqc: {}\n", message);
    return kUsageOrFile;
}

void print_diagnostics(const Compilation& compilation, std::string_view source,
                       const std::string& file_name) {
    std::size_t errors = 0;
    std::size_t warnings = 0;
    for (const auto& diagnostic : compilation.diagnostics) {
        fmt::print(stderr, "{}", render(diagnostic, source, file_name));
        ++(diagnostic.severity == Severity::error ? errors : warnings);
    }
    if (errors + warnings == 0) return;
    if (compilation.more_diagnostics)
        fmt::print(stderr, "{}: there are more; only {} are shown, mend these first\n", file_name,
                   errors + warnings);
    fmt::print(stderr, "{}: {} error{}, {} warning{}\n", file_name, errors, errors == 1 ? "" : "s", warnings,
               warnings == 1 ? "" : "s");
}

bool is_same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    return fs::equivalent(a, b, error) || fs::path(a).lexically_normal() == fs::path(b).lexically_normal();
}

int print_or_write(const std::string& text, const std::string& output) {
    if (output.empty() || output == "-") {
        fmt::print("{}", text);
        return std::fflush(stdout) == 0 ? kOk : file_problem("cannot write to standard output");
    }
    const std::string error = write_files({{output, text}});
    return error.empty() ? kOk : file_problem(error);
}

}  // namespace nplc::seqc::cli
