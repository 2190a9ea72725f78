#include "panel/names.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json_depth.h"

namespace nplc::panel {
namespace {

nlohmann::json json_of(std::string_view text) {
    if (base::is_deeper(text, kDeepestJson)) return {};
    return nlohmann::json::parse(text, nullptr, false);
}

}  // namespace

bool is_for_table(std::string_view text, std::uint32_t crc) {
    const auto json = json_of(text);
    if (!json.is_object()) return false;
    const auto table = json.find("table");
    if (table == json.end() || !table->is_object()) return false;
    const auto found = table->find("crc32");
    return found != table->end() && found->is_string() &&
           found->get<std::string>() == fmt::format("{:08X}", crc);
}

faces::Scaling scale_in(std::string_view text) {
    const auto json = json_of(text);
    const auto scale = json.is_object() ? json.value("scale", nlohmann::json()) : nlohmann::json();
    if (!scale.is_object()) return {};
    const auto number = [&scale](const char* name) {
        const auto found = scale.find(name);
        return found != scale.end() && found->is_number() ? found->get<double>() : 0.0;
    };
    const auto unit = scale.find("unit");
    if (unit == scale.end() || !unit->is_string() || number("revolutions") <= 0 || number("length") <= 0)
        return {};
    return {.unit = unit->get<std::string>(), .per_revolution = number("length") / number("revolutions")};
}

bool is_same(const faces::Scaling& a, const faces::Scaling& b) {
    constexpr double kRounding = 1e-9;
    return a.unit == b.unit &&
           std::abs(a.per_revolution - b.per_revolution) <= kRounding * std::abs(b.per_revolution);
}

std::string in_words(const faces::Scaling& scaling) {
    return fmt::format("{:.9g} {} a revolution", scaling.per_revolution, scaling.unit);
}

}  // namespace nplc::panel
