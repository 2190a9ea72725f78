// Any text is a value of a register or refused; a value that is taken is inside its register's range, and
// what it is written as is read as the same value.

#include <cstdlib>

#include "registers/convert.h"

using namespace nplc::registers;

namespace {

void check(const Register& reg, Model model, std::string_view text) {
    const Parsed parsed = parse(text, reg, model);
    if (parsed.rounding < -500 || parsed.rounding > 500 || (parsed.exact && parsed.rounding != 0))
        std::abort();
    if (parsed.error != TextError::none) return;
    if (parsed.raw < reg.min || parsed.raw > reg.max) std::abort();
    if (value_of(reg.format, bits_of(reg.format, parsed.raw)) != parsed.raw) std::abort();
    const Parsed again = parse(to_text(parsed.raw, reg, model).view(), reg, model);
    if (again.error != TextError::none || again.raw != parsed.raw) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const Model model = (data[0] & 1) != 0 ? Model::mac800 : Model::mac140;
    const auto map = map_of(model);
    std::string_view text(reinterpret_cast<const char*>(data + 1), size - 1);
    check(map[data[0] / 2 % map.size()], model, text);
    return 0;
}
