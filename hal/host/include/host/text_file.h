#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "host/files.h"

namespace nplc::host {

/// Whether it begins with the byte order mark of UTF-16 and a letter of ASCII, as no raw table does.
bool is_marked_utf16(std::string_view bytes);

/// Makes of a file's bytes the text in it, whichever editor wrote it: no byte order mark in front, no 1Ah
/// (the end of DOS's files) behind, LF at the end of a line, also where CR alone ends all of them. Answers
/// why it is no text, and how to mend it, or nothing.
std::string make_text(std::string& bytes);

/// The same of a text that comes in blocks and may be long: gives it on in lines without their ends, and
/// lines of more than kLongestPiece in pieces.
class TextPieces {
  public:
    static constexpr std::size_t kLongestPiece = 65'536;
    /// Answers whether it wants more.
    using Take = std::function<bool(std::string_view piece, bool ends_line)>;

    explicit TextPieces(Take take) : take_(std::move(take)) {}

    /// False: nobody wants more, or it is no text.
    bool add(std::string_view block);
    void finish();
    /// Why it is no text, or nothing.
    const std::string& problem() const { return problem_; }

  private:
    void begin();
    void give(std::string_view piece, bool ends_line);
    bool knows_line_end();
    void give_lines();

    Take take_;
    std::string held_;
    std::string problem_;
    std::string_view line_ends_{};  ///< empty: not known yet
    bool has_begun_ = false;
    bool has_enough_ = false;
};

/// As read_file, of a text.
FileContent read_text(const std::string& name, std::size_t most);

}  // namespace nplc::host
