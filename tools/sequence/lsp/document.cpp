#include "lsp/document.h"

#include <algorithm>

namespace nplc::seqc::lsp {
namespace {

constexpr std::string_view kScheme = "file://";

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

bool is_plain(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-._~/").find(c) != std::string_view::npos;
}

/// Reads a place of a message; false if invalid.
bool read_place(const Json& json, analysis::Place& place) {
    if (!json.is_object() || !json.contains("line") || !json.contains("character")) return false;
    const Json& line = json["line"];
    const Json& character = json["character"];
    if (!line.is_number_unsigned() || !character.is_number_unsigned()) return false;
    place.line = static_cast<std::uint32_t>(std::min<std::uint64_t>(line.get<std::uint64_t>(), UINT32_MAX));
    place.character =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(character.get<std::uint64_t>(), UINT32_MAX));
    return true;
}

}  // namespace

std::string path_of_uri(const std::string& uri) {
    if (!uri.starts_with(kScheme)) return "";
    std::string path;
    for (std::size_t at = kScheme.size(); at < uri.size(); ++at) {
        const int high = uri[at] == '%' && at + 2 < uri.size() ? hex_value(uri[at + 1]) : -1;
        const int low = high >= 0 ? hex_value(uri[at + 2]) : -1;
        if (low >= 0) {
            path += static_cast<char>(high * 16 + low);
            at += 2;
        } else {
            path += uri[at];
        }
    }
    const bool drive = path.size() > 2 && path[0] == '/' && path[2] == ':';
    return drive ? path.substr(1) : path;
}

std::string uri_of_path(const std::string& path) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    std::string uri(kScheme);
    if (!path.starts_with('/')) uri += '/';
    for (const char c : path) {
        if (is_plain(c)) {
            uri += c;
            continue;
        }
        const auto byte = static_cast<unsigned char>(c);
        uri += '%';
        uri += kDigits[byte / 16];
        uri += kDigits[byte % 16];
    }
    return uri;
}

Language language_of(const std::string& uri, const std::string& language_id) {
    if (uri.ends_with(".scn") || language_id == "seqc-scenario") return Language::scenario;
    if (uri.ends_with(".prop") || language_id == "seqc-property") return Language::property;
    return Language::program;
}

bool Document::change(const Json& changes, std::int64_t version, analysis::Encoding encoding) {
    if (!changes.is_array()) return false;
    for (const Json& change : changes) {
        if (!change.is_object() || !change.contains("text") || !change["text"].is_string()) return false;
        const std::string& text = change["text"].get_ref<const std::string&>();
        if (!change.contains("range") || change["range"].is_null()) {
            text_ = text;
        } else {
            analysis::Place start;
            analysis::Place end;
            const Json& range = change["range"];
            if (!range.is_object() || !read_place(range.value("start", Json()), start) ||
                !read_place(range.value("end", Json()), end))
                return false;
            const std::uint32_t from = lines().offset_of(start, encoding);
            const std::uint32_t to = std::max(from, lines().offset_of(end, encoding));
            text_.replace(from, to - from, text);
        }
        lines_.reset();
        changed = true;
    }
    version_ = version;
    return true;
}

const analysis::Lines& Document::lines() const {
    if (!lines_) lines_.emplace(text_);
    return *lines_;
}

}  // namespace nplc::seqc::lsp
