#include "macreg/monitor.h"

#include <fmt/format.h>

#include <algorithm>

#include "macreg/values.h"
#include "registers/convert.h"
#include "registers/layout.h"
#include "registers/scale.h"

namespace nplc::macreg {

namespace reg = registers;

namespace {

constexpr std::size_t kWordBytes = 2;

}  // namespace

std::string register_words(reg::Model model, std::uint8_t number) {
    const reg::Register* found = reg::holder_of(model, number);
    if (found == nullptr) return fmt::format("register {}", number);
    if (reg::is_second_half(model, number)) return fmt::format("upper word of {} ({})", found->name, number);
    return fmt::format("{} ({})", found->name, number);
}

std::string bytes_words(reg::Model model, std::uint8_t number, std::uint32_t value, std::size_t bytes) {
    const reg::Register* found = reg::find(model, number);
    const std::size_t own = found != nullptr              ? reg::bytes_of(model, *found)
                            : model == reg::Model::mac800 ? std::size_t{4}
                                                          : kWordBytes;
    const std::size_t shown = std::min(own, bytes);
    const std::uint32_t kept = shown == kWordBytes ? value & 0xFFFF : value;
    std::string hex = fmt::format("{:0{}X}", kept, 2 * shown);
    if (found == nullptr || shown < own) return hex;
    const std::int64_t raw = reg::value_of(reg::format_on_line(model, *found), value);
    return fmt::format("{} = {}", hex, value_text(*found, model, raw));
}

std::string hex_words(std::span<const std::uint8_t> bytes) {
    return fmt::format("{:02X}", fmt::join(bytes, " "));
}

}  // namespace nplc::macreg
