#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nplc::toml_files {

/// A value of a TOML file with its line. The parser library takes long to compile and is used in
/// toml_file.cpp only.
struct Value {
    enum class Kind : std::uint8_t { none, boolean, integer, real, text, list, table, other };
    Kind kind = Kind::none;
    int line = 0;
    bool boolean = false;
    std::int64_t integer = 0;
    double real = 0;  ///< also for an integer
    std::string text{};
    std::vector<Value> items{};
    std::vector<std::pair<std::string, Value>> entries{};

    /// For a table; nullptr if the key is missing.
    const Value* find(std::string_view key) const;
};

/// A parsed text, or a TOML error with its line.
struct File {
    Value root{};
    int line = 0;
    std::string error{};
};

/// The most tables and lists in each other; a key with dots counts as one for each part.
inline constexpr std::size_t kDeepestToml = 16;

/// What lies deeper than kDeepestToml is an error, found before it is built.
File read_toml(std::string_view text);

}  // namespace nplc::toml_files
