#include "seqc/decompile.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/input.h"
#include "cli/subcommands.h"
#include "host/paths.h"
#include "host/printable.h"
#include "symbols/motors.h"

namespace nplc::seqc::cli {
namespace {

struct DecompileArguments {
    InputFile table;
    std::string output;
    std::string motor;
};

int decompile(const DecompileArguments& options) {
    DecompileOptions wanted;
    wanted.origin = host::name_of(host::path_of(options.table.file).filename());
    if (!options.motor.empty()) {
        const auto choice = motor_named(options.motor);
        if (!choice)
            return file_problem(fmt::format("there is no motor '{}': {}", options.motor, motor_names_text()));
        wanted.motor = choice->map;
        wanted.drive = choice->drive;
    }
    const Input input = read_input(options.table);
    if (input.exit_code != kOk) return input.exit_code;
    if (!options.output.empty() && is_same_file(options.output, input.file))
        return file_problem(fmt::format("'{}' is the table itself: name another output", options.output));
    if (input.symbols) wanted.symbols = &*input.symbols;
    const Decompilation result = seqc::decompile(input.table, wanted);
    if (!result.lost_set_points.empty())
        host::complain(
            fmt::format("seqc: {}: the program has no set-points: the defaults of {} stand in it as "
                        "constants",
                        input.file, fmt::join(result.lost_set_points, ", ")));
    return result.error.empty() ? print_or_write(result.text, options.output) : file_problem(result.error);
}

}  // namespace

void add_decompile(arguments::App& app, int& exit_code) {
    const auto options = std::make_shared<DecompileArguments>();
    arguments::App& command = *app.add_subcommand(
        "decompile", "Turn a table into a readable program that compiles to the same bytes");
    command
        .add_option("table", options->table.file,
                    "The table, F.bin or F.hex: terms of 8 bytes up to STATE 63")
        ->required();
    add_symbols_option(command, options->table);
    command.add_option("-o,--output", options->output, "Write to a file instead of standard output (-)");
    command.add_option("--motor", options->motor, "The motor the table is for, such as MAC140 or MAC34");
    command.callback([options, &exit_code] { exit_code = decompile(*options); });
}

}  // namespace nplc::seqc::cli
