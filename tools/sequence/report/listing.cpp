#include <fmt/format.h>

#include <algorithm>

#include "report/describe.h"
#include "report/set_points_text.h"
#include "report/table_report.h"
#include "seqc/seqc.h"
#include "sequencer/term.h"
#include "symbols/motors.h"
#include "table/terms.h"

namespace nplc::seqc {
namespace {

using sequencer::kTermBytes;

std::string term_line(std::size_t index, sequencer::TermView bytes, const Compilation& compilation,
                      const Places& places, std::size_t width) {
    const Span span = compilation.origins[index].span;
    const std::string line = span.length == 0 ? "-" : places.line_text(span.offset);
    return fmt::format("{:5} {:>{}}  {} {}\n", index, line, width, table::hex(bytes),
                       describe(bytes, &compilation.symbols));
}

/// Width of the line numbers, which include the file name for included files.
std::size_t width_of_lines(const Compilation& compilation, const Places& places) {
    std::size_t width = 6;
    for (const TermOrigin& origin : compilation.origins) {
        if (origin.span.length > 0) width = std::max(width, places.line_text(origin.span.offset).size());
    }
    return width;
}

/// The contents of the files that the terms' lines refer to.
std::string files_of(const Sources& sources) {
    std::string text;
    for (const SourceFile& file : sources.files()) {
        if (&file != &sources.program()) text += fmt::format("includes {}\n", file.name);
    }
    return text;
}

}  // namespace

std::string listing(const Compilation& compilation, std::string_view source, std::string_view file_name) {
    return listing(compilation, Sources({std::string(file_name), std::string(source)}));
}

std::string listing(const Compilation& compilation, const Sources& sources) {
    const Symbols& symbols = compilation.symbols;
    const Places places(sources);
    const std::size_t width = width_of_lines(compilation, places);
    const std::size_t terms = compilation.table.size() / kTermBytes;
    std::string text =
        fmt::format("{}: program {}, {}, {} terms, {} bytes\n{}\n", sources.program().name, symbols.program,
                    motor_name(symbols), terms, compilation.table.size(), files_of(sources));
    text += fmt::format(" term {:>{}}  bytes                    what it does\n", "line", width);
    for (std::size_t i = 0; i < terms; ++i) {
        const auto bytes = std::span(compilation.table).subspan(i * kTermBytes).first<kTermBytes>();
        text += term_line(i, bytes, compilation, places, width);
    }
    text += "\nsteps:\n";
    for (std::size_t i = 0; i < symbols.steps.size(); ++i) {
        if (symbols.steps[i].empty()) continue;
        const std::string& why = symbols.made_for[i];
        text += fmt::format("{:5}  {}{}{}\n", i, symbols.steps[i], why.empty() ? "" : "  ", why);
    }
    text += set_points_text(symbols);
    if (!compilation.roundings.empty())
        text += symbols.drive != nullptr ? fmt::format("\nconstants on a {}:\n", motor_name(symbols))
                                         : std::string("\nrounded constants:\n");
    for (const Rounding& rounding : compilation.roundings) {
        text += fmt::format("{:>12}  {}\n", fmt::format("line {}", places.line_text(rounding.span.offset)),
                            rounding.text);
    }
    return text + "\n" + summary_of(report_of(compilation.table, &symbols, {}));
}

}  // namespace nplc::seqc
