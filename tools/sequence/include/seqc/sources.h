#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "seqc/diagnostic.h"

namespace nplc::seqc {

/// One file of a program.
struct SourceFile {
    std::string name;          ///< as shown in messages
    std::string identity;      ///< the same for all names of one file
    std::uint32_t offset = 0;  ///< where its text begins in Sources::text()
    std::uint32_t length = 0;
};

/// A text and its origin.
struct SourceText {
    std::string name;
    std::string text;
    std::string error = {};  ///< why there is no text
};

/// How included files are read. Empty: INCLUDE is an error.
struct TextReader {
    std::function<SourceText(const std::string& name)> read;
    std::function<std::string(const std::string& name)>
        identity;  ///< for example a path without links and ".."
};

/// The text of a program and of its included files, concatenated, each once: a Span is a place in any of
/// them.
class Sources {
  public:
    explicit Sources(SourceText program, const TextReader& reader = {});
    /// The same with the text of one of the included files first, for the analysis of that file.
    Sources(SourceText first, SourceText program, const TextReader& reader);

    const std::string& text() const { return text_; }
    const std::vector<SourceFile>& files() const { return files_; }
    const SourceFile& program() const { return files_[program_]; }
    std::string_view text_of(const SourceFile& file) const {
        return std::string_view(text_).substr(file.offset, file.length);
    }
    const SourceFile& file_at(std::uint32_t offset) const;
    /// Whether the program includes the first file, or is it.
    bool has_first() const { return has_first_; }

    /// The text inserted by an INCLUDE, by its offset.
    struct Inclusion {
        std::optional<std::size_t> file;   ///< in files(); empty: already included elsewhere, or `failed`
        std::optional<std::size_t> meant;  ///< the file, wherever it is included
        bool failed = false;
    };
    const Inclusion* inclusion_at(std::uint32_t offset) const;
    const std::map<std::uint32_t, Inclusion>& inclusions() const { return inclusions_; }
    /// Errors of included files.
    const std::vector<Diagnostic>& problems() const { return problems_; }

  private:
    friend class SourceLoader;

    std::string text_;
    std::vector<SourceFile> files_;
    std::size_t program_ = 0;
    bool has_first_ = true;
    std::map<std::uint32_t, Inclusion> inclusions_;
    std::vector<Diagnostic> problems_;
};

/// A program file with its text given, and its included files read from disk.
Sources read_sources(std::string name, std::string text);
/// Reads files and identifies them by their paths.
TextReader file_reader();

/// A place as shown to the user.
struct ShownPlace {
    const SourceFile* file = nullptr;
    Position at;
};

/// Converts many spans; the sources must stay valid.
class Places {
  public:
    explicit Places(const Sources& sources);
    ShownPlace of(std::uint32_t offset) const;
    /// "12", or for an included file "wiring.seqi:12".
    std::string line_text(std::uint32_t offset) const;

  private:
    const Sources& sources_;
    std::vector<Positions> positions_;
};

/// As render() for one file.
std::string render(const Diagnostic& diagnostic, const Sources& sources, Colour colour = Colour::off);

}  // namespace nplc::seqc
