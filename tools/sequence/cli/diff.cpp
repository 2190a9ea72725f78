#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/input.h"
#include "cli/subcommands.h"
#include "report/table_diff.h"

namespace nplc::seqc::cli {
namespace {

constexpr int kDifferent = 1;

struct DiffArguments {
    std::string before;
    std::string now;
    bool json = false;
};

/// A program with errors returns the exit code for trouble, since 1 means "different".
int diff(const DiffArguments& options) {
    const Input before = read_for_view({options.before, {}});
    const Input now = before.exit_code == kOk ? read_for_view({options.now, {}}) : Input();
    if (before.exit_code != kOk || now.exit_code != kOk) return kUsageOrFile;
    const TableDiff result = diff_of({before.table, names_of(before)}, {now.table, names_of(now)});
    const int printed = print_or_write(options.json ? json_of(result) : text_of(result), "");
    if (printed != kOk) return printed;
    return result.same_behaviour() ? kOk : kDifferent;
}

}  // namespace

void add_diff(arguments::App& app, int& exit_code) {
    const auto options = std::make_shared<DiffArguments>();
    arguments::App& command = *app.add_subcommand("diff", "What B does otherwise than A, in words");
    command.footer(
        "Exit codes: 0 B does the same as A, 1 it does something else,\n"
        "2 wrong usage, a program with errors, or a file that cannot be read or understood.");
    command.add_option("A", options->before, "The older program or table")->required();
    command.add_option("B", options->now, "The newer one")->required();
    command.add_flag("--json", options->json, "JSON for other programs");
    command.callback([options, &exit_code] { exit_code = diff(*options); });
}

}  // namespace nplc::seqc::cli
