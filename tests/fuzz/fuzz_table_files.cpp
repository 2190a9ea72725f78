// Any text is Intel HEX or refused with a line, and what was read comes back from what is written of it. Any
// text is a symbol file or refused with a reason, and its names are words that can stand in any message.
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "fuzz.h"
#include "intel_hex/intel_hex.h"
#include "seqc/symbol_file.h"

namespace {

using namespace nplc::seqc;
namespace intel_hex = nplc::intel_hex;

void hex(std::string_view text) {
    const intel_hex::Image image = intel_hex::read(text);
    require(image.error.empty() != image.bytes.empty());
    require(image.error.empty() || image.line > 0);
    if (!image.error.empty()) return;
    const intel_hex::Image again = intel_hex::read(intel_hex::write(image.bytes, image.base));
    require(again.error.empty() && again.base == image.base && again.bytes == image.bytes);
}

void symbols(std::string_view text) {
    const SymbolReading reading = read_symbols(text);
    if (!reading.error.empty()) return;
    const Symbols& names = reading.file.symbols;
    const auto is_plain = [](const std::string& name) {
        return std::all_of(name.begin(), name.end(), [](char c) { return c > ' ' && c <= '~'; });
    };
    require(is_plain(names.program));
    require(std::all_of(names.steps.begin(), names.steps.end(), is_plain));
    require(std::all_of(names.inputs.begin(), names.inputs.end(), is_plain));
    require(std::all_of(names.outputs.begin(), names.outputs.end(), is_plain));
    require(reading.file.terms.size() * 8 == reading.file.table_bytes);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    hex(text);
    symbols(text);
    return 0;
}
