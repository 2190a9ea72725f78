#include "panel/names.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace nplc::panel {

bool is_for_table(std::string_view text, std::uint32_t crc) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (!json.is_object()) return false;
    const auto table = json.find("table");
    if (table == json.end() || !table->is_object()) return false;
    const auto found = table->find("crc32");
    return found != table->end() && found->is_string() &&
           found->get<std::string>() == fmt::format("{:08X}", crc);
}

}  // namespace nplc::panel
