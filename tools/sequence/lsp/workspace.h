#pragma once

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "lsp/document.h"

namespace nplc::seqc::lsp {

/// The answer to a request that failed.
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

/// A program as seen by a request. For a property file: its program with the properties inserted before
/// END_PROGRAM, so that one front end handles both.
struct View {
    std::shared_ptr<const analysis::Program> program;
    std::string uri;                ///< of the program; empty if there is no file
    std::string part_uri;           ///< of the included file that the request is about, if any
    std::string property_uri;       ///< of the property file, if any
    std::uint32_t inserted_at = 0;  ///< position of its text
    std::uint32_t inserted = 0;     ///< and its length

    bool in_property_file(std::uint32_t offset) const {
        return !property_uri.empty() && offset >= inserted_at && offset <= inserted_at + inserted;
    }
};

/// The open texts and the files around them.
class Workspace {
  public:
    analysis::Encoding encoding = analysis::Encoding::utf16;
    std::vector<std::string> folders;  ///< paths
    bool snippets = false;             ///< the client supports $1

    void open(Document document);
    void close(const std::string& uri) { documents_.erase(uri); }
    Document* find(const std::string& uri);
    /// Throws ResponseError.
    Document& get(const std::string& uri);
    std::map<std::string, Document>& documents() { return documents_; }

    /// For an included text: as seen by its program, an open one preferred.
    std::shared_ptr<const analysis::Program> program_of(const Document& document);
    /// The text includes a file or is included.
    bool has_parts(const Document& document);
    /// Throws ResponseError if there is no program.
    View view_of(const Document& document);
    /// The program of a scenario or property file: the .seq whose name is a prefix of its name, or the only
    /// one in its folder. Null if there is none.
    std::shared_ptr<const analysis::Program> companion_of(const Document& document, std::string& uri);
    /// Scenario and property files of a program, as text by URI.
    std::map<std::string, std::string> dependants_of(const std::string& program_uri);
    /// Programs of the folders, open or not.
    std::map<std::string, std::shared_ptr<const analysis::Program>> programs();

    /// "textDocument" and "position" of a request.
    std::uint32_t offset_in(const View& view, const Document& document, const Json& place) const;
    Json range_json(const View& view, Span span) const;
    Json location_json(const View& view, Span span) const;
    std::string uri_at(const View& view, Span span) const;
    std::string uri_of_file(const SourceFile& file) const;
    /// Reads open texts first, else the stored files.
    TextReader reader() const;
    /// Programs that include a file, by URI.
    std::map<std::string, std::shared_ptr<const analysis::Program>> programs_that_include(
        const SourceFile& file);
    /// Programs that may include a file: open ones, and those in its folder and the folders above.
    std::vector<std::string> programs_around(const std::string& path) const;
    Json range_json(const analysis::Lines& lines, Span span) const;
    /// The range of a request in a document's own text.
    Span span_in(const Document& document, const Json& range) const;

  private:
    std::shared_ptr<const analysis::Program> read_program(const std::string& path);
    bool text_of_program(const std::string& path, std::string& text) const;

    std::map<std::string, Document> documents_;
    /// By path, or by the URI of an open text.
    std::map<std::string, std::shared_ptr<const analysis::Program>> files_;
};

}  // namespace nplc::seqc::lsp
