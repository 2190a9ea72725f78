#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/build_targets.h"
#include "cli/common.h"
#include "cli/json.h"
#include "cli/subcommands.h"
#include "host/printable.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kJsonHelp = "Print the diagnostics as JSON on standard output";

std::string written(const BuildOptions& options, const BuildTargets& targets, const Compilation& compilation,
                    const Sources& sources) {
    if (!has_room(targets, compilation.table.size()))
        return fmt::format("--base-address {}: the table would end beyond 4 GiB", options.base_address);
    return whole_files::write_files(files_of(targets, compilation, sources));
}

int problem(const BuildOptions& options, const std::string& message) {
    return options.json ? print_json(problem_document(options.source, message), kUsageOrFile)
                        : file_problem(message);
}

int report(const BuildOptions& options, const Compilation& compilation, const Sources& sources) {
    const int exit_code = compilation.ok ? kOk : kProgramHasErrors;
    if (options.json) return print_json(diagnostics_document(compilation, sources), exit_code);
    print_diagnostics(compilation, sources);
    return exit_code;
}

int build(const BuildOptions& options) {
    const BuildTargets targets = targets_of(options);
    if (!targets.problem.empty()) return problem(options, targets.problem);
    const auto source = whole_files::read_text(options.source);
    if (!source.error.empty()) return problem(options, source.error);
    const Sources sources = read_sources(options.source, source.text);
    const Compilation compilation = compile(sources);
    if (const std::string overwritten = overwritten_source(targets, sources); !overwritten.empty())
        return problem(options, overwritten);
    const std::string unwritten =
        compilation.ok ? written(options, targets, compilation, sources) : std::string();
    if (!unwritten.empty()) {
        if (!options.json) print_diagnostics(compilation, sources);
        return problem(options, unwritten);
    }
    const int exit_code = report(options, compilation, sources);
    if (exit_code == kOk && !options.quiet && !options.json)
        fmt::print("{}", host::printable_lines(summary(targets, compilation)));
    return std::fflush(stdout) == 0 ? exit_code : file_problem("cannot write to standard output");
}

struct CheckOptions {
    std::vector<std::string> programs;
    bool json = false;
};

int check(const CheckOptions& options) {
    int exit_code = kOk;
    Json documents = Json::array();
    for (const std::string& program : options.programs) {
        const auto source = whole_files::read_text(program);
        if (!source.error.empty()) {
            exit_code = kUsageOrFile;
            options.json ? documents.push_back(problem_document(program, source.error))
                         : static_cast<void>(file_problem(source.error));
            continue;
        }
        const Sources sources = read_sources(program, source.text);
        const Compilation compilation = compile(sources);
        exit_code = std::max<int>(exit_code, compilation.ok ? kOk : kProgramHasErrors);
        options.json ? documents.push_back(diagnostics_document(compilation, sources))
                     : print_diagnostics(compilation, sources);
    }
    if (!options.json) return exit_code;
    return print_json(documents.size() == 1 ? documents[0] : documents, exit_code);
}

}  // namespace

void add_build(arguments::App& app, int& exit_code) {
    const auto options = std::make_shared<BuildOptions>();
    arguments::App& command = *app.add_subcommand("build", "Compile a program into a table");
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
    command.add_flag("--json", options->json, kJsonHelp);
    command.callback([options, &exit_code] { exit_code = build(*options); });
}

void add_check(arguments::App& app, int& exit_code) {
    const auto options = std::make_shared<CheckOptions>();
    arguments::App& command = *app.add_subcommand("check", "Report errors and warnings, write nothing");
    command.add_option("programs", options->programs, "The programs, F.seq")->required();
    command.add_flag("--json", options->json, fmt::format("{}; of several programs a list", kJsonHelp));
    command.callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace nplc::seqc::cli
