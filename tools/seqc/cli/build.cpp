#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "cli/common.h"
#include "cli/files.h"
#include "cli/subcommands.h"

namespace nplc::seqc::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string source;
    std::string output;
    std::string listing;
};

std::string target_problem(const Options& options) {
    for (const std::string& target : {options.output, options.listing}) {
        if (target == "-") return "build writes files only: name one instead of '-' (or ./-)";
        if (!target.empty() && is_same_file(target, options.source))
            return fmt::format("'{}' is the program itself: name another output", target);
    }
    if (!options.listing.empty() && is_same_file(options.listing, options.output))
        return fmt::format("'{}' cannot be both table and listing", options.output);
    return {};
}

int write_all(const Options& options, const Compilation& compilation, const std::string& source) {
    std::vector<OutputFile> files = {{options.output, {compilation.table.begin(), compilation.table.end()}}};
    if (!options.listing.empty())
        files.push_back({options.listing, listing(compilation, source, options.source)});
    const std::string error = write_files(files);
    return error.empty() ? kOk : file_problem(error);
}

int build(Options options) {
    if (options.output.empty()) options.output = fs::path(options.source).replace_extension(".bin").string();
    if (const std::string problem = target_problem(options); !problem.empty()) return file_problem(problem);
    const auto source = read_file(options.source);
    if (!source.error.empty()) return file_problem(source.error);
    const Compilation compilation = compile(source.text);
    print_diagnostics(compilation, source.text, options.source);
    return compilation.ok ? write_all(options, compilation, source.text) : kProgramHasErrors;
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
    CLI::App& command = *app.add_subcommand("build", "Compile a program into a raw table");
    command.add_option("program", options->source, "The program, F.seq")->required();
    command.add_option("-o,--output", options->output,
                       "The table to write (default: F.bin beside the program)");
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
