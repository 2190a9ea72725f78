#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "lsp/document.h"

namespace nplc::seqc::lsp {

/// Answered to a request instead of a result.
struct ResponseError : std::runtime_error {
    ResponseError(int error_code, const std::string& message)
        : std::runtime_error(message), code(error_code) {}
    int code;
};

inline constexpr int kParseError = -32700;
inline constexpr int kInvalidRequest = -32600;
inline constexpr int kMethodNotFound = -32601;
inline constexpr int kInvalidParams = -32602;
inline constexpr int kServerNotInitialized = -32002;
inline constexpr int kRequestCancelled = -32800;
inline constexpr int kRequestFailed = -32803;

/// A program as a request sees it. Of a property file: its program with the properties in front of
/// END_PROGRAM, so that one front end answers for both.
struct View {
    std::shared_ptr<const analysis::Program> program;
    std::string uri;                ///< of the program; empty if no file is known
    std::string part_uri;           ///< of the file that it includes, if that is the one that is asked about
    std::string property_uri;       ///< of the property file, if there is one
    std::uint32_t inserted_at = 0;  ///< where its text stands
    std::uint32_t inserted = 0;     ///< and how long it is

    bool in_property_file(std::uint32_t offset) const {
        return !property_uri.empty() && offset >= inserted_at && offset <= inserted_at + inserted;
    }
};

/// The texts that are open, and the files beside them.
class Workspace {
  public:
    analysis::Encoding encoding = analysis::Encoding::utf16;
    std::vector<std::string> folders;  ///< paths
    bool snippets = false;             ///< the client takes $1

    void open(Document document);
    void close(const std::string& uri) { documents_.erase(uri); }
    Document* find(const std::string& uri);
    /// Throws ResponseError.
    Document& get(const std::string& uri);
    std::map<std::string, Document>& documents() { return documents_; }

    /// Of a text that a program includes: as that program sees it, an open one before others.
    std::shared_ptr<const analysis::Program> program_of(const Document& document);
    /// It includes a file, or is included.
    bool has_parts(const Document& document);
    /// Throws ResponseError where there is none.
    View view_of(const Document& document);
    /// The program that a scenario or property file belongs to: the .seq whose name its name begins with, or
    /// the only one in its folder. Null if there is none.
    std::shared_ptr<const analysis::Program> companion_of(const Document& document, std::string& uri);
    /// Scenario and property files that belong to a program, as text by URI.
    std::map<std::string, std::string> dependants_of(const std::string& program_uri);
    /// Programs of the folders, open or not.
    std::map<std::string, std::shared_ptr<const analysis::Program>> programs();

    /// "textDocument" and "position" of a request.
    std::uint32_t offset_in(const View& view, const Document& document, const Json& place) const;
    Json range_json(const View& view, Span span) const;
    Json location_json(const View& view, Span span) const;
    std::string uri_at(const View& view, Span span) const;
    std::string uri_of_file(const SourceFile& file) const;
    /// Files as they are open, or else as they are stored.
    TextReader reader() const;
    /// Programs of those that include a file, by URI.
    std::map<std::string, std::shared_ptr<const analysis::Program>> programs_that_include(
        const SourceFile& file);
    /// Programs that may include a file: those that are open, and those in its folder and the ones above it.
    std::vector<std::string> programs_around(const std::string& path) const;
    Json range_json(const analysis::Lines& lines, Span span) const;
    /// The range of a request in a document's own text.
    Span span_in(const Document& document, const Json& range) const;

  private:
    std::shared_ptr<const analysis::Program> read_program(const std::string& path);
    bool text_of_program(const std::string& path, std::string& text) const;

    std::map<std::string, Document> documents_;
    /// By path, or by the URI of what is open.
    std::map<std::string, std::shared_ptr<const analysis::Program>> files_;
};

}  // namespace nplc::seqc::lsp
