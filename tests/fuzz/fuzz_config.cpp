// Any text is a configuration, or is refused with lines of it and reasons.
#include <algorithm>
#include <cstdint>
#include <string_view>

#include "config.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace nplc::boards;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const ReadConfig read = read_config(text);
    const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
    for (const Mistake& mistake : read.findings.mistakes)
        require(!mistake.text.empty() && mistake.line >= 0 && mistake.line <= lines);
    if (!read.findings.mistakes.empty()) return 0;
    require(!read.config.axes.empty());
    for (const AxisConfig& axis : read.config.axes) require(!axis.name.empty());
    return 0;
}
