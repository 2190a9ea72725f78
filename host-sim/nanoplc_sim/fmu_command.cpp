#include "fmu_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string_view>

#include "host/printable.h"
#include "input_file.h"
#include "program.h"
#include "sim/axis.h"
#include "sim/fmu/fmu_file.h"
#include "sim/fmu/machine.h"
#include "whole_files/whole_files.h"

namespace nplc::sim {
namespace {

void check_output(const FmuCommand& command, const std::string& input, std::string_view what) {
    std::error_code error;
    if (input.empty() || !std::filesystem::equivalent(command.output, input, error) || error) return;
    throw InputError(fmt::format("--output {}: this would overwrite the {} {}; name another file",
                                 command.output, what, input));
}

/// Takes the part of a gateway's program that the machine needs.
void take_program(fmu::FmuOptions& options, const FmuCommand& command) {
    const Program program = load_program(command.program, command.symbols);
    check_output(command, command.program, "program");
    check_output(command, symbols_of(command.program, command.symbols), "symbol file");
    for (const std::string& told : {program.nameless, program.remark})
        if (!told.empty()) host::complain(fmt::format("{}", told));
    const std::string_view own =
        program.drive != nullptr ? program.drive->program_name : registers::name_of(program.names.motor);
    if (program.drive != nullptr && !command.motor) {
        throw InputError(fmt::format(
            "{}: is for {}, a {} drive, of which there are no FMUs; with --motor {} a "
            "JVL motor stands in for it",
            program.file, own, program.drive->family->name(), registers::name_of(program.names.motor)));
    }
    const bool another = program.drive != nullptr || (command.motor && *command.motor != program.names.motor);
    if (another && !program.names.steps.empty()) {
        host::complain(fmt::format("{}: was compiled for {} and runs on {}; its register values may not fit",
                                   program.file, own, registers::name_of(*command.motor)));
    }
    options.setup.motor = command.motor.value_or(program.names.motor);
    options.setup.table = program.content();
    options.names = program.names;
    if (!program.name.empty()) options.model_name = program.name;
}

void take_windows(fmu::FmuOptions& options, const FmuCommand& command) {
    if (!command.windows) return;
    check_output(command, *command.windows, "library");
    options.windows_dll = read_bytes(*command.windows, "the library for Windows as a DLL");
    if (!options.windows_dll.starts_with("MZ"))
        throw InputError(fmt::format("{}: is no DLL; name the library that `tools/portable windows` builds",
                                     *command.windows));
}

}  // namespace

void write_fmu(const FmuCommand& command) {
    fmu::FmuOptions options;
    options.fmi = command.fmi;
    if (command.motor) options.setup.motor = *command.motor;
    if (command.program.empty() && command.symbols)
        throw InputError("nanoplc-sim: --symbols without a table; name it with --with-gateway");
    if (!command.program.empty()) take_program(options, command);
    if (command.plant) {
        check_output(command, *command.plant, "plant file");
        const AxisReading axis = read_axis(*command.plant, options.setup.motor);
        if (!axis.error.empty()) throw InputError(axis.error);
        options.setup.plant = axis.load;
    }
    if (options.model_name.empty()) options.model_name = registers::name_of(options.setup.motor);
    take_windows(options, command);
    std::string file;
    try {
        file = fmu::fmu_file(options);
    } catch (const fmu::BadMachine& bad) {
        throw InputError(fmt::format("{}: {}; write the program for {}", command.program, bad.what(),
                                     registers::name_of(options.setup.motor)));
    }
    if (const std::string error = whole_files::write_files({{command.output, std::move(file)}});
        !error.empty())
        throw InputError(error);
}

}  // namespace nplc::sim
