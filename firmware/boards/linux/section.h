#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "toml_files/toml_file.h"

namespace nplc::boards {

using TomlValue = toml_files::Value;

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

/// Of the words the one that is most like `word`; empty if none is.
std::string nearest(std::string_view word, const std::set<std::string>& words);

/// A table of the configuration. Whatever is asked for is a key it may have; `finish` complains of all
/// others. Mistakes are collected, and what is wrong reads as if it were not there.
class Section {
  public:
    /// `value`: a table, or nullptr for one that is not there. `path`: "axis[x].motor".
    Section(const TomlValue* value, std::string path, Findings& findings);

    const std::string& path() const { return path_; }
    int line() const { return value_ == nullptr ? 0 : value_->line; }
    bool is_there() const { return value_ != nullptr; }

    std::optional<std::string> text(const std::string& key);
    std::optional<std::int64_t> number(const std::string& key, std::int64_t lowest, std::int64_t highest);
    std::optional<bool> flag(const std::string& key);
    /// The place of the value among the words.
    std::optional<std::size_t> choice(const std::string& key, const std::vector<std::string>& words);
    /// Whatever it is; nullptr if it is not there.
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

/// A text of the configuration and where it stands.
struct LocatedText {
    std::string text{};
    int line = 0;
    std::string key{};
    bool is_there() const { return !text.empty(); }
};

/// Empty where the key is not there or "none".
LocatedText located_text(Section& section, const std::string& key);

bool is_endpoint(const std::string& port);

/// A device, or, if it may be, an endpoint that the network does not reach: whoever reaches the port can move
/// the motor.
void check_port(Section& section, const LocatedText& port, bool may_be_endpoint);

}  // namespace nplc::boards
