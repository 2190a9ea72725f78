#include <fmt/format.h>

#include "language/names.h"
#include "language/reserved_words.h"
#include "report/describe.h"
#include "seqc/seqc.h"
#include "sequencer/term.h"
#include "symbols/motors.h"

namespace nplc::seqc {
namespace {

using sequencer::kTermBytes;

std::string term_line(sequencer::TermView bytes, const Symbols* symbols) {
    return fmt::format("{}  // {}\n", byte_line(bytes), describe(bytes, symbols));
}

}  // namespace

Disassembly disassemble(std::span<const std::uint8_t> table, std::string_view program_name,
                        const Symbols* symbols) {
    Disassembly result;
    std::string lines;
    std::size_t at = 0;
    bool ended = false;
    for (; !ended && at + kTermBytes <= table.size(); at += kTermBytes) {
        const auto bytes = table.subspan(at).first<kTermBytes>();
        lines += term_line(bytes, symbols);
        ended = sequencer::is_end(bytes);
    }
    if (!ended) {
        result.error = fmt::format(
            "{} bytes hold {} whole terms, and none has STATE 63: this is no sequence table, or "
            "its end is missing",
            table.size(), at / kTermBytes);
        return result;
    }
    result.trailing_bytes = table.size() - at;
    const std::string name(is_name(program_name) ? program_name : "Table");
    result.text = fmt::format(
        "// {} terms, the end included, one a line: STATE, INPUT, CARE and five bytes of command.\n",
        at / kTermBytes);
    if (symbols != nullptr)
        result.text += fmt::format("// The names are those of program {}, for {}.\n", symbols->program,
                                   motor_name(*symbols));
    if (result.trailing_bytes > 0) {
        result.text +=
            fmt::format("// {} bytes that followed the end are left out.\n", result.trailing_bytes);
    }
    result.text += fmt::format("PROGRAM {}\n{}END_PROGRAM\n", name, lines);
    return result;
}

}  // namespace nplc::seqc
