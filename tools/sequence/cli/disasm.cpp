#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/input.h"
#include "cli/subcommands.h"
#include "host/paths.h"

namespace nplc::seqc::cli {
namespace {

struct DisasmArguments {
    InputFile table;
    std::string output;
};

int disasm(const DisasmArguments& options) {
    const Input input = read_input(options.table);
    if (input.exit_code != kOk) return input.exit_code;
    if (!options.output.empty() && is_same_file(options.output, input.file))
        return file_problem(fmt::format("'{}' is the table itself: name another output", options.output));
    const auto result = disassemble(input.table, host::name_of(host::path_of(input.file).stem()),
                                    input.symbols ? &*input.symbols : nullptr);
    return print_or_write(result.text, options.output);
}

}  // namespace

void add_disasm(arguments::App& app, int& exit_code) {
    const auto options = std::make_shared<DisasmArguments>();
    arguments::App& command =
        *app.add_subcommand("disasm", "Print a table as a program of TERM lines, each explained");
    command
        .add_option("table", options->table.file,
                    "The table, F.bin or F.hex: terms of 8 bytes up to STATE 63")
        ->required();
    add_symbols_option(command, options->table);
    command.add_option("-o,--output", options->output, "Write to a file instead of standard output (-)");
    command.callback([options, &exit_code] { exit_code = disasm(*options); });
}

}  // namespace nplc::seqc::cli
