// Any text is compiled or refused with messages; what compiles comes back unchanged from its own disassembly.
// Any bytes are taken apart or refused, and what was taken apart compiles to the same bytes.
#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>

#include "fuzz.h"
#include "seqc/seqc.h"

namespace {

using namespace nplc::seqc;

void round_trip(std::span<const std::uint8_t> table) {
    const Disassembly text = disassemble(table, "Fuzz");
    if (!text.error.empty()) return;
    const Compilation again = compile(text.text);
    require(again.ok);
    require(std::equal(again.table.begin(), again.table.end(), table.begin(),
                       table.end() - static_cast<std::ptrdiff_t>(text.trailing_bytes)));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view source(reinterpret_cast<const char*>(data), size);
    const Compilation compilation = compile(source);
    for (const Diagnostic& diagnostic : compilation.diagnostics) {
        require(!render(diagnostic, source, "fuzz.seq").empty());
    }
    require(compilation.ok == !compilation.table.empty());
    if (compilation.ok) {
        require(!listing(compilation, source, "fuzz.seq").empty());
        round_trip(compilation.table);
    }
    round_trip({data, size});
    return 0;
}
