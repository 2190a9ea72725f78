#pragma once

#include <filesystem>
#include <string>
#include <string_view>

/// Names of files are UTF-8 in our programs. A std::filesystem::path made of a std::string takes it for
/// something else on Windows, so it is made and read here.
namespace nplc::host {

inline std::filesystem::path path_of(std::string_view name) {
    return std::u8string(name.begin(), name.end());
}

inline std::string name_of(const std::filesystem::path& path) {
    const std::u8string name = path.u8string();
    return {name.begin(), name.end()};
}

}  // namespace nplc::host
