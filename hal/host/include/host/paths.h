#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// File names are UTF-8 in these programs. On Windows std::filesystem::path interprets a std::string
/// differently, so the conversion is done here.
namespace nplc::host {

inline std::filesystem::path path_of(std::string_view name) {
    return std::u8string(name.begin(), name.end());
}

inline std::string name_of(const std::filesystem::path& path) {
    const std::u8string name = path.u8string();
    return {name.begin(), name.end()};
}

}  // namespace nplc::host
