#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string>

#include "files.h"
#include "seqc/seqc.h"

namespace {

namespace fs = std::filesystem;
using nplc::seqc::Compilation;
using nplc::seqc::Severity;
using nplc::seqc::write_files;

enum Exit : int { kOk = 0, kProgramHasErrors = 1, kUsageOrFile = 2 };

int file_problem(const std::string& message) {
    fmt::print(stderr, "seqc: {}\n", message);
    return kUsageOrFile;
}

std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
}

struct Options {
    std::string source;
    std::string output;
    std::string listing;
};

void print_diagnostics(const Compilation& compilation, std::string_view source, const std::string& name) {
    std::size_t errors = 0;
    std::size_t warnings = 0;
    for (const auto& diagnostic : compilation.diagnostics) {
        fmt::print(stderr, "{}", render(diagnostic, source, name));
        ++(diagnostic.severity == Severity::error ? errors : warnings);
    }
    if (errors + warnings == 0) return;
    if (compilation.more_diagnostics)
        fmt::print(stderr, "{}: there are more; only {} are shown, mend these first\n", name,
                   errors + warnings);
    fmt::print(stderr, "{}: {} error{}, {} warning{}\n", name, errors, errors == 1 ? "" : "s", warnings,
               warnings == 1 ? "" : "s");
}

bool is_same_file(const std::string& a, const std::string& b) {
    std::error_code error;
    return fs::equivalent(a, b, error) || fs::path(a).lexically_normal() == fs::path(b).lexically_normal();
}

int build(const Options& options, bool write) {
    for (const std::string& target : {options.output, options.listing}) {
        if (target == "-") return file_problem("build writes files only: name one instead of '-' (or ./-)");
    }
    const auto source = nplc::seqc::read_file(options.source);
    if (!source.error.empty()) return file_problem(source.error);
    const std::string output =
        options.output.empty() ? fs::path(options.source).replace_extension(".bin").string() : options.output;
    if (write) {
        for (const std::string& target : {output, options.listing}) {
            if (!target.empty() && is_same_file(target, options.source)) {
                return file_problem(fmt::format("'{}' is the program itself: name another output", target));
            }
        }
        if (!options.listing.empty() && is_same_file(options.listing, output)) {
            return file_problem(fmt::format("'{}' cannot be both table and listing", output));
        }
    }
    const Compilation compilation = nplc::seqc::compile(source.text);
    print_diagnostics(compilation, source.text, options.source);
    if (!compilation.ok) return kProgramHasErrors;
    if (!write) return kOk;
    std::vector<nplc::seqc::OutputFile> files = {
        {output, {compilation.table.begin(), compilation.table.end()}}};
    if (!options.listing.empty())
        files.push_back({options.listing, listing(compilation, source.text, options.source)});
    const std::string error = write_files(files);
    return error.empty() ? kOk : file_problem(error);
}

int disasm(const Options& options) {
    const auto table = nplc::seqc::read_file(options.source);
    if (!table.error.empty()) return file_problem(table.error);
    const std::vector<std::uint8_t> bytes(table.text.begin(), table.text.end());
    const auto result = nplc::seqc::disassemble(bytes, fs::path(options.source).stem().string());
    if (!result.error.empty()) return file_problem(fmt::format("{}: {}", options.source, result.error));
    if (result.trailing_bytes > 0) {
        fmt::print(stderr, "seqc: {}: {} bytes after the end of the table are left out\n", options.source,
                   result.trailing_bytes);
    }
    if (options.output.empty() || options.output == "-") {
        fmt::print("{}", result.text);
        return std::fflush(stdout) == 0 ? kOk : file_problem("cannot write to standard output");
    }
    if (is_same_file(options.output, options.source)) {
        return file_problem(fmt::format("'{}' is the table itself: name another output", options.output));
    }
    const std::string error = write_files({{options.output, result.text}});
    return error.empty() ? kOk : file_problem(error);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app(
        "Compiles sequence programs into tables for a NanoPLC gateway, and tables back into programs.");
    app.require_subcommand(1);
    app.set_version_flag("--version", std::string("seqc ") + NPLC_VERSION);
    app.footer(
        "Exit codes: 0 done (warnings do not count), 1 the program has errors and nothing was written,\n"
        "2 wrong usage or a file that cannot be read, written or understood.\n"
        "The language is described in tools/seqc/README.md; examples are in tools/seqc/examples.");

    CLI::App* build_command = app.add_subcommand("build", "Compile a program into a raw table");
    build_command->add_option("program", options.source, "The program, F.seq")->required();
    build_command->add_option("-o,--output", options.output,
                              "The table to write (default: F.bin beside the program)");
    build_command->add_option("--listing", options.listing,
                              "Also write each term's bytes, meaning and source line");

    CLI::App* check_command = app.add_subcommand("check", "Report errors and warnings, write nothing");
    check_command->add_option("program", options.source, "The program, F.seq")->required();

    CLI::App* disasm_command =
        app.add_subcommand("disasm", "Print a table as a program of TERM lines, each explained");
    disasm_command
        ->add_option("table", options.source, "The raw table, F.bin: terms of 8 bytes up to STATE 63")
        ->required();
    disasm_command->add_option("-o,--output", options.output,
                               "Write to a file instead of standard output (-)");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        return file_problem(fmt::format("{} (see seqc --help)", one_line(error.what())));
    }
    if (build_command->parsed()) return build(options, true);
    if (check_command->parsed()) return build(options, false);
    return disasm(options);
}
