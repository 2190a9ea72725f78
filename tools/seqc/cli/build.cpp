#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "cli/build_targets.h"
#include "cli/common.h"
#include "cli/files.h"
#include "cli/subcommands.h"

namespace nplc::seqc::cli {
namespace {

using Options = BuildOptions;

int write_all(const Options& options, const BuildTargets& targets, const Compilation& compilation,
              const std::string& source) {
    if (!has_room(targets, compilation.table.size()))
        return file_problem(
            fmt::format("--base-address {}: the table would end beyond 4 GiB", options.base_address));
    const std::string error = write_files(files_of(targets, options, compilation, source));
    if (!error.empty()) return file_problem(error);
    if (!options.quiet) fmt::print("{}", summary(targets, compilation));
    return std::fflush(stdout) == 0 ? kOk : file_problem("cannot write to standard output");
}

int build(const Options& options) {
    const BuildTargets targets = targets_of(options);
    if (!targets.problem.empty()) return file_problem(targets.problem);
    const auto source = read_file(options.source);
    if (!source.error.empty()) return file_problem(source.error);
    const Compilation compilation = compile(source.text);
    print_diagnostics(compilation, source.text, options.source);
    return compilation.ok ? write_all(options, targets, compilation, source.text) : kProgramHasErrors;
}

int check(const std::string& file) {
    const auto source = read_file(file);
    if (!source.error.empty()) return file_problem(source.error);
    const Compilation compilation = compile(source.text);
    print_diagnostics(compilation, source.text, file);
    return compilation.ok ? kOk : kProgramHasErrors;
}

}  // namespace

void add_build(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *app.add_subcommand("build", "Compile a program into a table");
    command.add_option("program", options->source, "The program, F.seq")->required();
    command.add_option("-o,--output", options->output,
                       "The table to write (default: F.bin beside the program); .hex or .ihx: Intel HEX");
    command.add_option("--format", options->format, "bin or hex, whatever the table's file is called");
    command.add_option("--base-address", options->base_address,
                       "Where Intel HEX puts the table's first byte (0), such as 0x08010000");
    command.add_option("--symbols", options->symbols,
                       "The file for the names and source lines (default: F.sym beside the table)");
    command.add_flag("--no-symbols", options->no_symbols, "Write no F.sym");
    command.add_flag("--quiet", options->quiet, "Do not say what was written");
    command.add_option("--listing", options->listing,
                       "Also write each term's bytes, meaning and source line");
    command.callback([options, &exit_code] { exit_code = build(*options); });
}

void add_check(CLI::App& app, int& exit_code) {
    const auto file = std::make_shared<std::string>();
    CLI::App& command = *app.add_subcommand("check", "Report errors and warnings, write nothing");
    command.add_option("program", *file, "The program, F.seq")->required();
    command.callback([file, &exit_code] { exit_code = check(*file); });
}

}  // namespace nplc::seqc::cli
