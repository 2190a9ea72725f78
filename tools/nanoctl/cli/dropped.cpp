#include "cli/dropped.h"

#include <nlohmann/json.hpp>

namespace nplc::nanoctl::cli {

std::string lines_of(const std::vector<set_points::Dropped>& dropped) {
    std::string lines;
    for (const set_points::Dropped& one : dropped) lines += "\n" + set_points::text_of(one);
    return lines;
}

Json json_of(const std::vector<set_points::Dropped>& dropped) {
    Json all = Json::array();
    for (const set_points::Dropped& one : dropped) {
        all.push_back({{"name", one.name},
                       {"value", one.value},
                       {"recipe", one.recipe},
                       {"why", set_points::key_of(one.why)}});
    }
    return all;
}

}  // namespace nplc::nanoctl::cli
