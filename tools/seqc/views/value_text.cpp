#include "views/value_text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "meaning/units.h"

namespace nplc::seqc {
namespace {

std::optional<LengthUnit> length_of(const Symbols& symbols) {
    if (!symbols.scale) return std::nullopt;
    return LengthUnit{symbols.scale->unit, symbols.scale->length / symbols.scale->revolutions};
}

/// The one in which people speak of it; "" for a plain number.
std::string unit_for(const registers::Register& reg, const std::optional<LengthUnit>& length) {
    const std::vector<std::string> units = fitting_units(reg, length);
    if (units.empty()) return "";
    if (units.front() == "counts") return units.back();
    return units.front() == "samples" ? "ms" : units.front();
}

}  // namespace

std::optional<std::string> with_unit(std::int64_t value, std::uint8_t number, const Symbols* symbols) {
    constexpr int kMostPlaces = 6;
    if (symbols == nullptr) return std::nullopt;
    const registers::Register* reg = registers::find(symbols->motor, number);
    if (reg == nullptr) return std::nullopt;
    const std::optional<LengthUnit> length = length_of(*symbols);
    const std::string unit = unit_for(*reg, length);
    const auto raw = raw_per_unit(*reg, symbols->motor, length, unit);
    if (!raw || *raw == 1) return std::nullopt;
    const double exact = static_cast<double>(value) / *raw;
    std::string text;
    for (int places = 0; places <= kMostPlaces; ++places) {
        text = fmt::format("{:.{}f}", exact, places);
        if (std::llround(std::strtod(text.c_str(), nullptr) * *raw) == value) break;
    }
    return unit.empty() ? text : fmt::format("{} {}", text, unit);
}

}  // namespace nplc::seqc
