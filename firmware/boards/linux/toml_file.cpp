#include "toml_file.h"

#define TOML_EXCEPTIONS 0
#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace nplc::boards {
namespace {

using Kind = TomlValue::Kind;

TomlValue value_of(const toml::node& node) {
    TomlValue value;
    value.line = static_cast<int>(node.source().begin.line);
    if (const auto* table = node.as_table()) {
        value.kind = Kind::table;
        for (const auto& [key, inner] : *table) {
            value.entries.emplace_back(std::string(key.str()), value_of(inner));
            // A table in brackets begins at its first key, a value at itself: the key's line is what is
            // meant.
            const int line = static_cast<int>(key.source().begin.line);
            if (line != 0) value.entries.back().second.line = line;
        }
    } else if (const auto* list = node.as_array()) {
        value.kind = Kind::list;
        for (const auto& inner : *list) value.items.push_back(value_of(inner));
    } else if (const auto* text = node.as_string()) {
        value.kind = Kind::text;
        value.text = text->get();
    } else if (const auto* integer = node.as_integer()) {
        value.kind = Kind::integer;
        value.integer = integer->get();
    } else if (const auto* boolean = node.as_boolean()) {
        value.kind = Kind::boolean;
        value.boolean = boolean->get();
    } else {
        value.kind = Kind::other;
    }
    return value;
}

}  // namespace

const TomlValue* TomlValue::find(std::string_view key) const {
    for (const auto& [name, value] : entries) {
        if (name == key) return &value;
    }
    return nullptr;
}

TomlFile read_toml(std::string_view text) {
    const toml::parse_result parsed = toml::parse(text);
    if (parsed) return {value_of(parsed.table()), {}};
    const toml::parse_error& error = parsed.error();
    return {{},
            {{static_cast<int>(error.source().begin.line), "",
              "this is not TOML: " + std::string(error.description())}}};
}

}  // namespace nplc::boards
