#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "host/files.h"

namespace nplc::host {

/// Whether it is text in UTF-16, with a byte order mark or without: all of it is characters, and without the
/// mark one in eight is ASCII. A raw table has zeros or FFs where a text has no character.
bool is_utf16_text(std::string_view bytes);
/// What is said of such a file.
inline constexpr const char* kUtf16Problem = "it is text in UTF-16; save it as UTF-8";

/// Normalizes a file's bytes to text, whichever editor wrote it: removes a byte order mark and a final 1Ah
/// (end of a DOS file), and ends lines with LF, also where CR alone ends all of them. Returns why it is not
/// text, with the remedy, or an empty string.
std::string make_text(std::string& bytes);

/// The same for a text that comes in blocks and may be long: passes on lines without their ends, and lines
/// longer than kLongestPiece in pieces.
class TextPieces {
  public:
    static constexpr std::size_t kLongestPiece = 65'536;
    /// Returns false to stop.
    using Take = std::function<bool(std::string_view piece, bool ends_line)>;

    explicit TextPieces(Take take) : take_(std::move(take)) {}

    /// False: stopped by `Take`, or not a text.
    bool add(std::string_view block);
    void finish();
    /// Why it is not a text; empty if it is.
    const std::string& problem() const { return problem_; }

  private:
    void begin();
    void give(std::string_view piece, bool ends_line);
    bool knows_line_end();
    void give_lines();

    Take take_;
    std::string held_;
    std::string problem_;
    std::string_view line_ends_{};  ///< empty: not yet known
    bool has_begun_ = false;
    bool has_enough_ = false;
};

/// As read_file, for a text.
FileContent read_text(const std::string& name, std::size_t most);

}  // namespace nplc::host
