#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::seqc {

enum class Severity : std::uint8_t { error, warning };

/// A range of the source text, in bytes.
struct Span {
    std::uint32_t offset = 0;
    std::uint32_t length = 0;
    bool operator==(const Span&) const = default;
};

/// A second place related to a diagnostic.
struct Note {
    Span span;
    std::string message;
};

struct Diagnostic {
    Severity severity = Severity::error;
    std::string code;     ///< E0xx or W0xx; see `seqc explain`
    std::string message;  ///< the error
    std::string help;     ///< the remedy; may be empty
    Span span;
    std::vector<Note> notes;
};

struct Position {
    std::uint32_t line = 1;
    std::uint32_t column = 1;  ///< in characters (UTF-8), not bytes
};

Position position_of(std::string_view source, std::uint32_t offset);

/// Converts many offsets in one text, which must stay valid.
class Positions {
  public:
    explicit Positions(std::string_view source);
    Position of(std::uint32_t offset) const;

  private:
    std::string_view source_;
    std::vector<Position> marks_;  ///< at every 256th byte
};

/// Whether a text has terminal colours. They only add escape codes.
enum class Colour : std::uint8_t { off, on };

/// `file:line:column: error E021: ...`, the source line, a caret, the help and the notes. Of a long line
/// about 100 characters around the caret are shown. Invalid UTF-8 and control characters become '?'.
std::string render(const Diagnostic& diagnostic, std::string_view source, std::string_view file_name,
                   Colour colour = Colour::off);

}  // namespace nplc::seqc
