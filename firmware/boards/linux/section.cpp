#include "section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "host/endpoint.h"

namespace nplc::boards {
namespace {

using Kind = TomlValue::Kind;

std::string_view in_words(Kind kind) {
    switch (kind) {
        case Kind::boolean:
            return "true or false";
        case Kind::integer:
            return "a whole number";
        case Kind::real:
            return "a number with a point";
        case Kind::text:
            return "a text";
        case Kind::list:
            return "a list";
        case Kind::table:
            return "a table";
        case Kind::none:
        case Kind::other:
            break;
    }
    return "something else";
}

/// Edit distance: letters to insert, delete or replace.
std::size_t distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t change = diagonal + (a[i] == b[j] ? 0U : 1U);
            diagonal = row[j + 1];
            row[j + 1] = std::min({change, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

/// Path without the axis name: axis[x].motor becomes axis.motor.
std::string without_name(std::string path) {
    const std::size_t open = path.find('[');
    if (open != std::string::npos) path.erase(open, path.rfind(']') + 1 - open);
    return path;
}

}  // namespace

std::string nearest(std::string_view word, const std::set<std::string>& words) {
    std::string best;
    std::size_t least = std::max<std::size_t>(2, word.size() / 2) + 1;
    for (const std::string& candidate : words) {
        const std::size_t away = distance(word, candidate);
        if (away >= least) continue;
        least = away;
        best = candidate;
    }
    return best;
}

Section::Section(const TomlValue* value, std::string path, Findings& findings)
    : value_(value), path_(std::move(path)), findings_(findings) {}

const TomlValue* Section::any(const std::string& key) {
    known_.insert(key);
    findings_.keys.insert(path_.empty() ? key : without_name(path_) + "." + key);
    return value_ == nullptr ? nullptr : value_->find(key);
}

int Section::line_of(const std::string& key) const {
    const TomlValue* value = value_ == nullptr ? nullptr : value_->find(key);
    return value == nullptr ? line() : value->line;
}

void Section::complain(int line, const std::string& key, const std::string& text) {
    findings_.mistakes.push_back({line, path_.empty() ? key : key.empty() ? path_ : path_ + "." + key, text});
}

void Section::complain(const std::string& key, const std::string& text) {
    complain(line_of(key), key, text);
}

const TomlValue* Section::of_kind(const std::string& key, Kind kind, const std::string& wanted) {
    const TomlValue* value = any(key);
    if (value == nullptr || value->kind == kind) return value;
    complain(key, fmt::format("is {}; write {}", in_words(value->kind), wanted));
    return nullptr;
}

std::optional<std::string> Section::text(const std::string& key) {
    const TomlValue* value = of_kind(key, Kind::text, "a text in quotes: \"...\"");
    if (value == nullptr) return std::nullopt;
    return value->text;
}

std::optional<bool> Section::flag(const std::string& key) {
    const TomlValue* value = of_kind(key, Kind::boolean, "true or false, without quotes");
    if (value == nullptr) return std::nullopt;
    return value->boolean;
}

std::optional<std::int64_t> Section::number(const std::string& key, std::int64_t lowest,
                                            std::int64_t highest) {
    const std::string range = fmt::format("a whole number from {} to {}", lowest, highest);
    const TomlValue* value = of_kind(key, Kind::integer, range);
    if (value == nullptr) return std::nullopt;
    if (value->integer >= lowest && value->integer <= highest) return value->integer;
    complain(key, fmt::format("{} is out of range; write {}", value->integer, range));
    return std::nullopt;
}

std::optional<std::size_t> Section::choice(const std::string& key, const std::vector<std::string>& words) {
    const std::optional<std::string> word = text(key);
    if (!word) return std::nullopt;
    const auto found = std::find(words.begin(), words.end(), *word);
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
    complain(key, fmt::format("\"{}\" is none of its values; write one of \"{}\"", *word,
                              fmt::join(words, "\", \"")));
    return std::nullopt;
}

const TomlValue* Section::table(const std::string& key) {
    return of_kind(key, Kind::table, fmt::format("a table: [{}]", path_.empty() ? key : "axis." + key));
}

const TomlValue* Section::list(const std::string& key, const std::string& example) {
    return of_kind(key, Kind::list, example);
}

void Section::finish() {
    if (value_ == nullptr) return;
    for (const auto& [key, value] : value_->entries) {
        if (known_.contains(key)) continue;
        const std::string near = nearest(key, known_);
        complain(value.line, key,
                 near.empty()
                     ? fmt::format("there is no such key; here may stand {}", fmt::join(known_, ", "))
                     : fmt::format("there is no such key; did you mean {}?", near));
    }
}

LocatedText located_text(Section& section, const std::string& key) {
    const std::optional<std::string> text = section.text(key);
    return {text && *text != "none" ? *text : "", section.line_of(key), section.path() + "." + key};
}

namespace {

bool is_open_to_network(const host::Endpoint& port) {
    return port.kind == host::Endpoint::Kind::tcp && !port.place.starts_with("127.");
}

}  // namespace

bool is_endpoint(const std::string& port) {
    return host::Endpoint(port).is_served();
}

void check_port(Section& section, const LocatedText& port, bool may_be_endpoint) {
    const std::string key = port.key.substr(port.key.rfind('.') + 1);
    if (!port.is_there() || port.text.starts_with('/')) return;
    if (!may_be_endpoint)
        section.complain(key, fmt::format("{} is no device; write such as \"/dev/ttyUSB0\"", port.text));
    else if (!is_endpoint(port.text))
        section.complain(key, fmt::format("{} is no port; write \"/dev/ttyUSB1\", \"unix:PATH\", "
                                          "\"pty:PATH\", \"tcp:127.0.0.1:PORT\" or \"none\"",
                                          port.text));
    else if (is_open_to_network(host::Endpoint(port.text)))
        section.complain(key, fmt::format("{} is open to the network; write \"tcp:127.0.0.1:PORT\" and "
                                          "come in through ssh -L",
                                          port.text));
}

}  // namespace nplc::boards
