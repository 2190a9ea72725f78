#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace nplc::boards {

/// Something in a configuration that cannot be used.
struct Mistake {
    int line = 0;
    std::string key;   ///< "axis[x].motor.port"; empty where no key is to blame
    std::string text;  ///< what is wrong and what to do
};

/// What came out of reading a configuration beside its values.
struct Findings {
    std::vector<Mistake> mistakes{};
    std::set<std::string> keys{};  ///< all that may stand in it: "axis.motor.port"
};

/// A value of a TOML file with the line it stands in. The library that reads it takes long to compile and is
/// known in toml_file.cpp alone.
struct TomlValue {
    enum class Kind : std::uint8_t { none, boolean, integer, text, list, table, other };
    Kind kind = Kind::none;
    int line = 0;
    bool boolean = false;
    std::int64_t integer = 0;
    std::string text{};
    std::vector<TomlValue> items{};
    std::vector<std::pair<std::string, TomlValue>> entries{};

    const TomlValue* find(std::string_view key) const;
};

struct TomlFile {
    TomlValue root;
    std::vector<Mistake> mistakes;  ///< one at the most: after a syntax error nothing can be read
};
TomlFile read_toml(std::string_view text);

}  // namespace nplc::boards
