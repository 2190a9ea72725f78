// Any bytes are a table or are refused; a table becomes a program that compiles to the same bytes, whatever
// the motor is and whatever names are given.
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fuzz.h"
#include "seqc/decompile.h"

namespace {

using namespace nplc::seqc;
using Bytes = std::span<const std::uint8_t>;

void round_trip(Bytes table, const DecompileOptions& options) {
    const Decompilation result = decompile(table, options);
    require(result.error.empty() != result.text.empty());
    if (!result.error.empty()) return;
    const Compilation again = compile(result.text);
    require(again.ok);
    require(std::equal(again.table.begin(), again.table.end(), table.begin(),
                       table.end() - static_cast<std::ptrdiff_t>(result.trailing_bytes)));
}

/// Names of three bytes each, whatever they are.
Symbols names_from(Bytes bytes) {
    Symbols symbols;
    std::size_t at = 0;
    const auto take = [&](std::string& name) {
        for (int i = 0; i < 3 && at < bytes.size(); ++i) name += static_cast<char>(bytes[at++]);
    };
    for (std::string& name : symbols.inputs) take(name);
    for (std::string& name : symbols.outputs) take(name);
    for (std::string& name : symbols.steps) take(name);
    take(symbols.program);
    return symbols;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Bytes bytes(data, size);
    if (size == 0 || data[0] % 2 != 0) {
        round_trip(bytes, {});
        return 0;
    }
    std::vector<std::uint8_t> table(data + 1, data + size - (size - 1) % 8);
    table.insert(table.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    const Symbols symbols = names_from(bytes.subspan(1));
    DecompileOptions options;
    options.origin = std::string(bytes.begin(),
                                 bytes.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(size, 9)));
    const int motor = data[0] / 2 % 8;
    if (motor < 5) options.motor = static_cast<nplc::registers::Model>(motor);
    if (data[0] >= 0x80) options.symbols = &symbols;
    round_trip(table, options);
    return 0;
}
