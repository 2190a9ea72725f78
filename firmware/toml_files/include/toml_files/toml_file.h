#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nplc::toml_files {

/// A value of a TOML file with the line it stands in. The library that reads it takes long to compile and is
/// known in toml_file.cpp alone.
struct Value {
    enum class Kind : std::uint8_t { none, boolean, integer, real, text, list, table, other };
    Kind kind = Kind::none;
    int line = 0;
    bool boolean = false;
    std::int64_t integer = 0;
    double real = 0;  ///< of an integer too
    std::string text{};
    std::vector<Value> items{};
    std::vector<std::pair<std::string, Value>> entries{};

    /// Of a table; nullptr if the key is not there.
    const Value* find(std::string_view key) const;
};

/// What a text says, or why it is not TOML and in which line.
struct File {
    Value root{};
    int line = 0;
    std::string error{};
};

File read_toml(std::string_view text);

}  // namespace nplc::toml_files
