#include "macreg/words.h"

#include <fmt/format.h>

#include <algorithm>

#include "registers/convert.h"
#include "registers/details.h"
#include "registers/layout.h"
#include "registers/scale.h"

namespace nplc::macreg {

namespace reg = registers;

namespace {

constexpr std::size_t kWordBytes = 2;

std::string field_words(const reg::Field& field, std::uint32_t bits) {
    const std::uint32_t value = reg::value_in(field, bits);
    if (const reg::NamedValue* name = reg::named(field, value)) return std::string(name->name);
    return fmt::format("{}", value);
}

/// Flags that are set by name, wider fields with their value; the number alone if it is one whole field.
std::string bits_words(std::span<const reg::Field> fields, std::uint32_t bits) {
    if (fields.size() == 1 && fields.front().first == 0 && fields.front().width >= 16)
        return field_words(fields.front(), bits);
    std::string out;
    for (const reg::Field& field : fields) {
        const std::uint32_t value = reg::value_in(field, bits);
        if (value == 0) continue;
        if (!out.empty()) out += ' ';
        out += field.name;
        if (field.width > 1) out += "=" + field_words(field, bits);
    }
    return out.empty() ? "nothing set" : out;
}

}  // namespace

std::string register_words(reg::Model model, std::uint8_t number) {
    const reg::Register* found = reg::holder_of(model, number);
    if (found == nullptr) return fmt::format("register {}", number);
    if (reg::is_second_half(model, number)) return fmt::format("upper word of {} ({})", found->name, number);
    return fmt::format("{} ({})", found->name, number);
}

std::string_view shown_unit(const reg::Register& reg) {
    if (reg.unit == reg::Unit::counts || reg.unit == reg::Unit::counts_16) return "counts";
    const auto units = reg::units_of(reg.unit);
    return units.empty() ? std::string_view() : units.front();
}

std::string value_words(reg::Model model, const reg::Register& reg, std::int64_t raw) {
    const auto fields = reg::fields_of(model, reg.number);
    if (!fields.empty()) return bits_words(fields, reg::bits_of(reg.format, raw));
    if (reg.unit == reg::Unit::bits) return fmt::format("{}", raw);
    return std::string(reg::to_text(raw, reg, model, shown_unit(reg)).view());
}

std::string bytes_words(reg::Model model, std::uint8_t number, std::uint32_t value, std::size_t bytes) {
    const reg::Register* found = reg::find(model, number);
    const std::size_t own = found != nullptr              ? reg::bytes_of(model, *found)
                            : model == reg::Model::mac800 ? std::size_t{4}
                                                          : kWordBytes;
    const std::size_t shown = std::min(own, bytes);
    const std::uint32_t kept = shown == kWordBytes ? value & 0xFFFF : value;
    const std::string hex = fmt::format("{:0{}X}", kept, 2 * shown);
    if (found == nullptr || shown < own) return hex;
    return fmt::format("{} = {}", hex, value_words(model, *found, reg::value_of(found->format, value)));
}

std::string hex_words(std::span<const std::uint8_t> bytes) {
    return fmt::format("{:02X}", fmt::join(bytes, " "));
}

}  // namespace nplc::macreg
