#pragma once

#include <cstddef>
#include <string_view>

namespace nplc::base {

/// Whether lists and objects of a JSON text lie more than `most` deep in each other. Libraries copy and write
/// what they read by functions that call themselves for each level, so that depth from outside must be
/// bounded before.
constexpr bool is_deeper(std::string_view json, std::size_t most) {
    std::size_t depth = 0;
    bool is_in_text = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (is_in_text && c == '\\') {
            ++i;
        } else if (c == '"') {
            is_in_text = !is_in_text;
        } else if (is_in_text) {
            continue;
        } else if (c == '[' || c == '{') {
            if (++depth > most) return true;
        } else if ((c == ']' || c == '}') && depth > 0) {
            --depth;
        }
    }
    return false;
}

}  // namespace nplc::base
