#include "program.h"

#include <fmt/format.h>

#include <algorithm>

#include "input_file.h"
#include "seqc/seqc.h"
#include "sequencer/table.h"

namespace nplc::sim {
namespace {

Names names_of(const seqc::Symbols& symbols) {
    Names names;
    names.motor = symbols.motor;
    std::copy(symbols.inputs.begin(), symbols.inputs.end(), names.inputs.begin());
    std::copy(symbols.outputs.begin(), symbols.outputs.end(), names.outputs.begin());
    for (std::size_t step = 0; step < symbols.steps.size(); ++step) {
        if (!symbols.steps[step].empty()) names.steps[static_cast<std::uint8_t>(step)] = symbols.steps[step];
    }
    return names;
}

std::string rendered(const seqc::Compilation& compilation, const std::string& source,
                     const std::string& file) {
    std::string text = seqc::render_all(compilation, source, file);
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

Program compile(const std::string& file) {
    const std::string source = read_input(file, "a program for seqc");
    const seqc::Compilation compilation = seqc::compile(source);
    if (!compilation.ok) throw InputError(rendered(compilation, source, file));
    check_table(compilation.table, file);
    Program program{
        .file = file, .table = compilation.table, .names = names_of(compilation.symbols), .remark = {}};
    if (const auto warnings = compilation.diagnostics.size(); warnings != 0) {
        program.remark = fmt::format("{}: {} warning{}; `seqc check {}` shows {}", file, warnings,
                                     warnings == 1 ? "" : "s", file, warnings == 1 ? "it" : "them");
    }
    return program;
}

}  // namespace

Program load_program(const std::string& file) {
    Program program;
    if (has_extension(file, ".seq")) {
        program = compile(file);
    } else {
        program.file = file;
        program.table = read_table(file);
    }
    program.terms = sequencer::Table::load(program.table).table.size();
    return program;
}

}  // namespace nplc::sim
