#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/common.h"
#include "cli/subcommands.h"
#include "host/printable.h"
#include "host/terminal.h"
#include "seqc/format.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc::cli {
namespace {

struct FmtArguments {
    std::vector<std::string> programs;
    std::string output;
    bool in_place = false;
    bool check = false;
};

struct Program {
    std::string name;  ///< for messages
    std::string before;
    std::string after;
    bool is_standard_input = false;
    int exit_code = kOk;  ///< not kOk: the reason was printed
};

bool is_standard_input(const std::string& file) {
    return file == "-";
}

Program read_and_format(const std::string& file) {
    Program program;
    program.is_standard_input = is_standard_input(file);
    program.name = program.is_standard_input ? "<stdin>" : file;
    whole_files::FileText text =
        program.is_standard_input ? whole_files::read_standard_input() : whole_files::read_text(file);
    if (!text.error.empty()) {
        program.exit_code = file_problem(text.error);
        return program;
    }
    program.before = std::move(text.text);
    Formatted formatted = format_program(program.before);
    if (!formatted.fault.empty()) {
        program.exit_code = file_problem(fmt::format("{}: internal error of the formatter: {}; left as it is",
                                                     program.name, formatted.fault));
    } else if (!formatted.ok) {
        Compilation refused;
        refused.diagnostics = std::move(formatted.diagnostics);
        refused.more_diagnostics = formatted.more_diagnostics;
        print_diagnostics(refused, Sources({program.name, program.before}));
        program.exit_code = kProgramHasErrors;
    }
    program.after = std::move(formatted.text);
    return program;
}

/// Compared without byte order mark and CR LF, which belong to the file and not to the text.
bool is_formatted(const Program& program) {
    if (program.before != program.after || program.is_standard_input) return program.before == program.after;
    return whole_files::read_file(program.name).text == program.after;
}

int rewrite(const Program& program) {
    if (is_formatted(program)) return kOk;
    return print_or_write(program.after, program.name);
}

/// Comments must not send control characters to a terminal.
int show(const std::string& text, const std::string& output) {
    const bool to_terminal = (output.empty() || output == "-") && host::is_terminal(stdout);
    return print_or_write(to_terminal ? host::printable_lines(text) : text, output);
}

int list_if_different(const Program& program) {
    if (is_formatted(program)) return kOk;
    fmt::print("{}\n", program.name);
    return kProgramHasErrors;
}

std::string usage_problem(const FmtArguments& options) {
    const std::vector<std::string>& files = options.programs;
    const bool reads_input = std::any_of(files.begin(), files.end(), is_standard_input);
    if (options.in_place && reads_input)
        return "standard input cannot be rewritten in place: leave out --in-place, or name the file ./-";
    if (std::count_if(files.begin(), files.end(), is_standard_input) > 1)
        return "standard input (-) can be read only once";
    if (options.in_place || options.check) return {};
    if (files.size() > 1) return "several programs need --in-place or --check";
    if (!options.output.empty() && !reads_input && is_same_file(options.output, files.front()))
        return fmt::format("'{}' is the program itself: use --in-place", options.output);
    return {};
}

int format_files(const FmtArguments& options) {
    if (const std::string problem = usage_problem(options); !problem.empty()) return file_problem(problem);
    int exit_code = kOk;
    for (const std::string& file : options.programs) {
        const Program program = read_and_format(file);
        int own = program.exit_code;
        if (own == kOk && options.check) {
            own = list_if_different(program);
        } else if (own == kOk) {
            own = options.in_place ? rewrite(program) : show(program.after, options.output);
        }
        exit_code = std::max(exit_code, own);
    }
    return exit_code;
}

}  // namespace

void add_fmt(arguments::App& app, int& exit_code) {
    const auto options = std::make_shared<FmtArguments>();
    arguments::App& command =
        *app.add_subcommand("fmt", "Lay a program out in the one style, comments included");
    command.add_option("programs", options->programs, "The programs, F.seq; - is standard input")->required();
    arguments::Option* output =
        command.add_option("-o,--output", options->output, "Write to a file instead of standard output (-)");
    arguments::Option* in_place =
        command.add_flag("-i,--in-place", options->in_place,
                         "Rewrite the files that are not formatted, leave the others alone");
    arguments::Option* check = command.add_flag(
        "--check", options->check, "Write nothing; list the files that are not formatted, exit code 1");
    in_place->excludes(output)->excludes(check);
    check->excludes(output);
    command.callback([options, &exit_code] { exit_code = format_files(*options); });
}

}  // namespace nplc::seqc::cli
