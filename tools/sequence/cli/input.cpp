#include "cli/input.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <span>

#include "host/paths.h"
#include "host/printable.h"
#include "intel_hex/intel_hex.h"
#include "seqc/symbol_file.h"
#include "sequencer/table.h"
#include "sequencer/term.h"
#include "table/step.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc::cli {
namespace {

using sequencer::kTermBytes;

bool is_program(const std::string& file) {
    const std::string extension = host::name_of(host::path_of(file).extension());
    return extension == ".seq" || extension == ".SEQ";
}

void compile_into(Input& input, const std::string& text) {
    Sources sources = read_sources(input.file, text);
    Compilation compilation = compile(sources);
    print_diagnostics(compilation, sources);
    if (!compilation.ok) {
        input.exit_code = kProgramHasErrors;
        return;
    }
    input.table = compilation.table;
    input.symbols = compilation.symbols;
    input.sources = std::move(sources);
    input.program = std::move(compilation);
}

void read_table_into(Input& input, const std::string& text, bool is_whole) {
    intel_hex::Image image = intel_hex::bytes_in(input.file, text);
    if (!image.error.empty()) {
        const std::string place = image.line == 0 ? input.file : fmt::format("{}:{}", input.file, image.line);
        const char* advice = image.is_text ? "; a program's name ends in .seq" : "";
        input.exit_code = file_problem(fmt::format("{}: {}{}", place, image.error, advice));
        return;
    }
    std::vector<std::uint8_t> bytes = std::move(image.bytes);
    const std::size_t length = table::length_of(bytes);
    if (length == 0) {
        input.exit_code = file_problem(fmt::format(
            "{}: {} bytes hold {} whole terms, and none has STATE 63: this is no sequence table, or "
            "its end is missing",
            input.file, bytes.size(), bytes.size() / kTermBytes));
        return;
    }
    if (length < bytes.size() && is_whole) {
        input.exit_code =
            file_problem(fmt::format("{}: {} bytes stand behind the end of the table, so this is another "
                                     "file or a damaged one; seqc disasm "
                                     "shows what it reads",
                                     input.file, bytes.size() - length));
        return;
    }
    if (length < bytes.size()) {
        host::complain(fmt::format("seqc: {}: {} bytes after the end of the table are left out", input.file,
                                   bytes.size() - length));
        bytes.resize(length);
    }
    if (length == kTermBytes)
        host::complain(fmt::format("seqc: {}: the table is empty: nothing will happen", input.file));
    input.table = std::move(bytes);
}

/// Symbols named explicitly must fit; those found next to the table need not.
void read_symbols_into(Input& input, const std::string& asked_for) {
    const std::string file = asked_for.empty() ? symbol_file_beside(input.file) : asked_for;
    std::error_code ignored;
    if (asked_for.empty() && !std::filesystem::is_regular_file(host::path_of(file), ignored)) return;
    const whole_files::FileText text = whole_files::read_text(file);
    const SymbolReading reading = text.error.empty() ? read_symbols(text.text, input.table) : SymbolReading{};
    const std::string error = reading.error.empty() ? text.error : fmt::format("{}: {}", file, reading.error);
    if (error.empty()) {
        input.symbols = reading.file.symbols;
    } else if (asked_for.empty()) {
        host::complain(fmt::format("seqc: {}; names are left out", error));
    } else {
        input.table.clear();
        input.exit_code = file_problem(error);
    }
}

}  // namespace

Input read_input(const InputFile& named) {
    Input input;
    input.file = named.file;
    const whole_files::FileText text =
        is_program(named.file) ? whole_files::read_text(named.file) : whole_files::read_file(named.file);
    if (!text.error.empty()) {
        input.exit_code = file_problem(text.error);
    } else if (is_program(named.file)) {
        if (named.symbols.empty()) {
            compile_into(input, text.text);
        } else {
            input.exit_code =
                file_problem(fmt::format("{} brings its own names: leave --symbols out", named.file));
        }
    } else {
        read_table_into(input, text.text, named.is_whole);
        if (input.exit_code == kOk) read_symbols_into(input, named.symbols);
    }
    return input;
}

void add_symbols_option(arguments::App& command, InputFile& named) {
    command
        .add_option("--symbols", named.symbols,
                    "Take a table's names from here (default: F.sym beside F.bin, if it fits)")
        ->type_name("F.sym");
}

Input read_for_view(const InputFile& named) {
    Input input = read_input(named);
    if (input.exit_code != kOk) return input;
    const auto loaded = sequencer::Table::load(input.table);
    if (loaded.ok || loaded.fault.error == base::Error::no_space) return input;
    input = {};
    input.exit_code = file_problem(fmt::format("{}: term {}: {}; no gateway takes this table", named.file,
                                               loaded.fault.term, sequencer::describe(loaded.fault.error)));
    return input;
}

}  // namespace nplc::seqc::cli
