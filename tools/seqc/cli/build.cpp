#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/common.h"
#include "cli/files.h"
#include "cli/json.h"
#include "cli/subcommands.h"

namespace nplc::seqc::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::string source;
    std::string output;
    std::string listing;
    bool json = false;
};

constexpr const char* kJsonHelp = "Print the diagnostics as JSON on standard output";

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

std::string written(const Options& options, const Compilation& compilation, const std::string& source) {
    std::vector<OutputFile> files = {{options.output, {compilation.table.begin(), compilation.table.end()}}};
    if (!options.listing.empty())
        files.push_back({options.listing, listing(compilation, source, options.source)});
    return write_files(files);
}

int problem(const Options& options, const std::string& message) {
    return options.json ? print_json(problem_document(options.source, message), kUsageOrFile)
                        : file_problem(message);
}

int report(const Options& options, const Compilation& compilation, const std::string& source) {
    const int exit_code = compilation.ok ? kOk : kProgramHasErrors;
    if (options.json) return print_json(diagnostics_document(compilation, source, options.source), exit_code);
    print_diagnostics(compilation, source, options.source);
    return exit_code;
}

int build(Options options) {
    if (options.output.empty()) options.output = fs::path(options.source).replace_extension(".bin").string();
    if (const std::string target = target_problem(options); !target.empty()) return problem(options, target);
    const auto source = read_file(options.source);
    if (!source.error.empty()) return problem(options, source.error);
    const Compilation compilation = compile(source.text);
    const std::string unwritten = compilation.ok ? written(options, compilation, source.text) : std::string();
    if (unwritten.empty()) return report(options, compilation, source.text);
    if (!options.json) print_diagnostics(compilation, source.text, options.source);
    return problem(options, unwritten);
}

int check(const Options& options) {
    const auto source = read_file(options.source);
    if (!source.error.empty()) return problem(options, source.error);
    return report(options, compile(source.text), source.text);
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
    command.add_flag("--json", options->json, kJsonHelp);
    command.callback([options, &exit_code] { exit_code = build(*options); });
}

void add_check(CLI::App& app, int& exit_code) {
    const auto options = std::make_shared<Options>();
    CLI::App& command = *app.add_subcommand("check", "Report errors and warnings, write nothing");
    command.add_option("program", options->source, "The program, F.seq")->required();
    command.add_flag("--json", options->json, kJsonHelp);
    command.callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace nplc::seqc::cli
