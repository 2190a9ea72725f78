#include <fmt/format.h>

#include "listing/describe.h"
#include "semantics/motors.h"
#include "seqc/seqc.h"
#include "sequencer/term.h"
#include "views/table_report.h"

namespace nplc::seqc {
namespace {

using sequencer::kTermBytes;

std::string term_line(std::size_t index, sequencer::TermView bytes, const Compilation& compilation,
                      const Positions& positions) {
    std::string hex;
    for (std::uint8_t byte : bytes) hex += fmt::format("{:02X} ", byte);
    const Span span = compilation.origins[index].span;
    const std::string line = span.length == 0 ? "-" : std::to_string(positions.of(span.offset).line);
    return fmt::format("{:5} {:>6}  {} {}\n", index, line, hex, describe(bytes, &compilation.symbols));
}

}  // namespace

std::string listing(const Compilation& compilation, std::string_view source, std::string_view file_name) {
    const Symbols& symbols = compilation.symbols;
    const Positions positions(source);
    const std::size_t terms = compilation.table.size() / kTermBytes;
    std::string text = fmt::format("{}: program {}, {}, {} terms, {} bytes\n\n", file_name, symbols.program,
                                   motor_name(symbols), terms, compilation.table.size());
    text += " term   line  bytes                    what it does\n";
    for (std::size_t i = 0; i < terms; ++i) {
        const auto bytes = std::span(compilation.table).subspan(i * kTermBytes).first<kTermBytes>();
        text += term_line(i, bytes, compilation, positions);
    }
    text += "\nsteps:\n";
    for (std::size_t i = 0; i < symbols.steps.size(); ++i) {
        if (symbols.steps[i].empty()) continue;
        const std::string& why = symbols.made_for[i];
        text += fmt::format("{:5}  {}{}{}\n", i, symbols.steps[i], why.empty() ? "" : "  ", why);
    }
    if (!compilation.roundings.empty())
        text += symbols.drive != nullptr ? fmt::format("\nconstants on a {}:\n", motor_name(symbols))
                                         : std::string("\nrounded constants:\n");
    for (const Rounding& rounding : compilation.roundings) {
        text += fmt::format("{:>12}  {}\n", fmt::format("line {}", positions.of(rounding.span.offset).line),
                            rounding.text);
    }
    return text + "\n" + summary_of(report_of(compilation.table, &symbols, {}));
}

}  // namespace nplc::seqc
