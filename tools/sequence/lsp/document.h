#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "editing/program.h"

namespace nplc::seqc::lsp {

using Json = nlohmann::json;

enum class Language : std::uint8_t { program, scenario, property };

/// "file:///a%20b.seq" and back; empty for other schemes.
std::string path_of_uri(const std::string& uri);
std::string uri_of_path(const std::string& path);
/// By the file extension, else as given by the client.
Language language_of(const std::string& uri, const std::string& language_id);

/// A text that an editor has open. Derived data are computed on demand, and only from the text.
class Document {
  public:
    Document(std::string uri, Language language, std::int64_t version, std::string text)
        : uri_(std::move(uri)), language_(language), version_(version), text_(std::move(text)) {}

    const std::string& uri() const { return uri_; }
    Language language() const { return language_; }
    std::int64_t version() const { return version_; }
    const std::string& text() const { return text_; }

    /// contentChanges of textDocument/didChange, one after the other. False if one is malformed.
    bool change(const Json& changes, std::int64_t version, analysis::Encoding encoding);

    const analysis::Lines& lines() const;

    bool changed = true;  ///< since diagnostics were last published

  private:
    std::string uri_;
    Language language_;
    std::int64_t version_;
    std::string text_;
    mutable std::optional<analysis::Lines> lines_;
};

}  // namespace nplc::seqc::lsp
