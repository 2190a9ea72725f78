#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "toml_files/toml_file.h"

namespace nplc::boards {

using TomlValue = toml_files::Value;

/// An invalid entry of a configuration.
struct Mistake {
    int line = 0;
    std::string key;   ///< "axis[x].motor.port"; empty if it is not about a key
    std::string text;  ///< the mistake and its remedy
};

/// Results of reading a configuration, besides its values.
struct Findings {
    std::vector<Mistake> mistakes{};
    std::set<std::string> keys{};  ///< all allowed keys: "axis.motor.port"
};

/// The word most similar to `word`; empty if none is.
std::string nearest(std::string_view word, const std::set<std::string>& words);

/// A table of the configuration. Every key that is queried counts as allowed; `finish` reports all others.
/// Mistakes are collected, and an invalid value reads as if it were missing.
class Section {
  public:
    /// `value`: a table, or nullptr if it is missing. `path`: "axis[x].motor".
    Section(const TomlValue* value, std::string path, Findings& findings);

    const std::string& path() const { return path_; }
    int line() const { return value_ == nullptr ? 0 : value_->line; }
    bool is_there() const { return value_ != nullptr; }

    std::optional<std::string> text(const std::string& key);
    std::optional<std::int64_t> number(const std::string& key, std::int64_t lowest, std::int64_t highest);
    std::optional<bool> flag(const std::string& key);
    /// Index of the value in `words`.
    std::optional<std::size_t> choice(const std::string& key, const std::vector<std::string>& words);
    /// A value of any type; nullptr if it is missing.
    const TomlValue* any(const std::string& key);
    const TomlValue* table(const std::string& key);
    const TomlValue* list(const std::string& key, const std::string& example);

    int line_of(const std::string& key) const;
    void complain(const std::string& key, const std::string& text);
    void complain(int line, const std::string& key, const std::string& text);
    void finish();

  private:
    const TomlValue* of_kind(const std::string& key, TomlValue::Kind kind, const std::string& wanted);

    const TomlValue* value_;
    std::string path_;
    Findings& findings_;
    std::set<std::string> known_;
};

/// A text of the configuration with its position.
struct LocatedText {
    std::string text{};
    int line = 0;
    std::string key{};
    bool is_there() const { return !text.empty(); }
};

/// Empty if the key is missing or "none".
LocatedText located_text(Section& section, const std::string& key);

bool is_endpoint(const std::string& port);

/// Checks for a device, or, if allowed, an endpoint that is not reachable from the network: a client that
/// reaches the port can move the motor.
void check_port(Section& section, const LocatedText& port, bool may_be_endpoint);

}  // namespace nplc::boards
