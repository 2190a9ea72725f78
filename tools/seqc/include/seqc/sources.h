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
    std::string name;          ///< as messages show it
    std::string identity;      ///< the same for all names of one file
    std::uint32_t offset = 0;  ///< where its text begins in Sources::text()
    std::uint32_t length = 0;
};

/// A text and where it is from.
struct SourceText {
    std::string name;
    std::string text;
    std::string error = {};  ///< why there is none
};

/// How files that a program includes are found. Nothing in it: INCLUDE is an error.
struct TextReader {
    std::function<SourceText(const std::string& name)> read;
    std::function<std::string(const std::string& name)> identity;  ///< a path without links and "..", say
};

/// The text of a program and those of the files that it includes, one behind the other, each once: so a Span
/// is a place in any of them.
class Sources {
  public:
    explicit Sources(SourceText program, const TextReader& reader = {});
    /// The same, but the text of one of the included files stands first, for questions about that.
    Sources(SourceText first, SourceText program, const TextReader& reader);

    const std::string& text() const { return text_; }
    const std::vector<SourceFile>& files() const { return files_; }
    const SourceFile& program() const { return files_[program_]; }
    std::string_view text_of(const SourceFile& file) const {
        return std::string_view(text_).substr(file.offset, file.length);
    }
    const SourceFile& file_at(std::uint32_t offset) const;
    bool is_one_file() const { return files_.size() == 1; }
    /// Of the file that stands first: whether the program includes it, or is it.
    bool has_first() const { return has_first_; }

    /// What an INCLUDE, by the place of its text, puts there.
    struct Inclusion {
        std::optional<std::size_t> file;   ///< in files(); nothing: it stands elsewhere already, or `failed`
        std::optional<std::size_t> meant;  ///< the file, wherever it stands
        bool failed = false;
    };
    const Inclusion* inclusion_at(std::uint32_t offset) const;
    const std::map<std::uint32_t, Inclusion>& inclusions() const { return inclusions_; }
    /// Files that cannot be included.
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

/// A program in a file, its text given, with what it includes; read from disk.
Sources read_sources(std::string name, std::string text);
/// Reads files, and tells them apart by their paths.
TextReader file_reader();

/// A place as it is shown.
struct ShownPlace {
    const SourceFile* file = nullptr;
    Position at;
};

/// The places of many spans; the sources must stay alive.
class Places {
  public:
    explicit Places(const Sources& sources);
    ShownPlace of(std::uint32_t offset) const;
    /// "12", in an included file "wiring.seqi:12".
    std::string line_text(std::uint32_t offset) const;

  private:
    const Sources& sources_;
    std::vector<Positions> positions_;
};

/// As render() of one file.
std::string render(const Diagnostic& diagnostic, const Sources& sources, Colour colour = Colour::off);

}  // namespace nplc::seqc
