#include "program.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/crc32.h"
#include "input_file.h"
#include "rehearsal/names.h"
#include "seqc/seqc.h"
#include "seqc/symbol_file.h"
#include "sequencer/table.h"

namespace nplc::sim {
namespace {

std::string rendered(const seqc::Compilation& compilation, const seqc::Sources& sources) {
    std::string text = seqc::render_all(compilation, sources);
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

Program compile(const std::string& file) {
    const std::string source = read_input(file, "a program for seqc");
    const seqc::Sources sources = seqc::read_sources(file, source);
    const seqc::Compilation compilation = seqc::compile(sources);
    if (!compilation.ok) throw InputError(rendered(compilation, sources));
    check_table(compilation.table, file);
    Program program;
    program.file = file;
    program.table = compilation.table;
    program.name = compilation.symbols.program;
    program.names = rehearsal::names_of(compilation.symbols);
    program.drive = compilation.symbols.drive;
    program.symbols_text = seqc::write_symbols(compilation, sources);
    if (const auto warnings = compilation.diagnostics.size(); warnings != 0) {
        program.remark = fmt::format("{}: {} warning{}; `seqc check {}` shows {}", file, warnings,
                                     warnings == 1 ? "" : "s", file, warnings == 1 ? "it" : "them");
    }
    return program;
}

/// A bit for each step that has terms, or is the next step of a term.
std::uint64_t steps_in(std::span<const std::uint8_t> table) {
    std::uint64_t steps = 1;
    for (std::size_t at = 0; at + 2 * sequencer::kTermBytes <= table.size(); at += sequencer::kTermBytes) {
        const sequencer::Term term = sequencer::decode(table.subspan(at).first<sequencer::kTermBytes>());
        steps |= std::uint64_t{1} << (term.condition.step & 63U);
        if (!term.is_flex && term.fast.next_step < sequencer::kNoSwitch)
            steps |= std::uint64_t{1} << term.fast.next_step;
    }
    return steps;
}

/// Throws InputError, also for symbols that do not fit the table.
void take_names(Program& program, const std::string& file, const std::string& otherwise) {
    std::string text = read_input(file, "a symbol file as `seqc build` writes it");
    const seqc::SymbolReading reading = seqc::read_symbols(text, program.table);
    if (!reading.error.empty()) throw InputError(fmt::format("{}: {}; {}", file, reading.error, otherwise));
    program.name = reading.file.symbols.program;
    program.names = rehearsal::names_of(reading.file.symbols);
    program.drive = reading.file.symbols.drive;
    program.symbols = file;
    program.symbols_text = std::move(text);
}

/// Symbols next to a table by chance need not fit.
void take_names_beside(Program& program, const std::string& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return;
    try {
        take_names(program, file, "names are left out");
    } catch (const InputError& misfit) {
        constexpr std::string_view kLeftOut = "; names are left out";
        program.nameless = misfit.what();
        if (!program.nameless.ends_with(kLeftOut)) program.nameless += kLeftOut;
    }
}

}  // namespace

std::vector<std::uint8_t> Program::content() const {
    return set_points::with_record(table, names.set_points);
}

std::string symbols_of(const std::string& file, const std::optional<std::string>& symbols) {
    if (symbols) return *symbols;
    return has_extension(file, ".seq") ? std::string() : seqc::symbol_file_beside(file);
}

Program load_program(const std::string& file, const std::optional<std::string>& symbols) {
    Program program;
    const bool is_source = has_extension(file, ".seq");
    if (is_source && symbols)
        throw InputError(fmt::format("{}: a source brings its own names; leave --symbols out", file));
    if (is_source) {
        program = compile(file);
    } else {
        program.file = file;
        program.table = read_table(file);
    }
    program.terms = sequencer::Table::load(program.table).table.size();
    program.table.resize((program.terms + 1) * sequencer::kTermBytes);
    program.crc32 = base::crc32(program.table);
    if (is_source) return program;
    program.names.numbers = steps_in(program.table);
    if (symbols) {
        take_names(program, *symbols, "name the one that `seqc build` wrote with this table");
    } else {
        take_names_beside(program, symbols_of(file, symbols));
    }
    return program;
}

}  // namespace nplc::sim
