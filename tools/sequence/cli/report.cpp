#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/input.h"
#include "cli/subcommands.h"
#include "report/table_report.h"

namespace nplc::seqc::cli {
namespace {

struct ReportArguments {
    InputFile table;
    std::string output;
    bool json = false;
    bool rapid = false;
    std::uint32_t baud = 19'200;
};

int report(const ReportArguments& options) {
    const Input input = read_for_view(options.table);
    if (input.exit_code != kOk) return input.exit_code;
    if (!options.output.empty() && is_same_file(options.output, options.table.file))
        return file_problem(
            fmt::format("'{}' is the file to report on: name another output", options.output));
    const TableReport result =
        report_of(input.table, names_of(input), {.baud = options.baud, .safe_communication = !options.rapid});
    return print_or_write(options.json ? json_of(result) : text_of(result), options.output);
}

}  // namespace

void add_report(arguments::App& app, int& exit_code) {
    constexpr std::uint32_t kSlowest = 300;
    constexpr std::uint32_t kFastest = 4'000'000;
    const auto options = std::make_shared<ReportArguments>();
    arguments::App& command = *app.add_subcommand(
        "report", "What a program or table uses, and how long its switches keep the motor's line");
    command.add_option("file", options->table.file, "A program, F.seq, or a table")->required();
    add_symbols_option(command, options->table);
    command.add_option("-o,--output", options->output, "Write to a file instead of standard output (-)");
    command.add_flag("--json", options->json, "JSON for other programs");
    command.add_option("--baud", options->baud, "Of the motor's line (default 19200)")
        ->in_range(kSlowest, kFastest);
    command.add_flag("--rapid", options->rapid, "Rapid communication: each command once, not twice");
    command.callback([options, &exit_code] { exit_code = report(*options); });
}

}  // namespace nplc::seqc::cli
