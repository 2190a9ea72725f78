#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "seqc/diagnostic.h"

namespace nplc::seqc::analysis {

/// Unit in which a client counts characters of a line.
enum class Encoding : std::uint8_t { utf8, utf16 };

/// Line and character, both from 0.
struct Place {
    std::uint32_t line = 0;
    std::uint32_t character = 0;
    bool operator==(const Place&) const = default;
};

struct Range {
    Place start;
    Place end;
};

struct TextEdit {
    Span span;
    std::string text;
};

/// Line starts of a text, which must stay valid. Lines end with LF, CR LF or CR.
class Lines {
  public:
    explicit Lines(std::string_view text);

    std::size_t count() const { return starts_.size(); }
    Place place_of(std::uint32_t offset, Encoding encoding) const;
    Range range_of(Span span, Encoding encoding) const;
    /// Limited to the end of the line and of the text.
    std::uint32_t offset_of(Place place, Encoding encoding) const;
    std::uint32_t line_of(std::uint32_t offset) const;
    std::uint32_t start_of(std::uint32_t line) const { return starts_[line]; }
    /// Without its line end.
    std::string_view line(std::uint32_t number) const;

  private:
    std::string_view text_;
    std::vector<std::uint32_t> starts_;
};

/// Invalid UTF-8 counts as one character per byte.
std::uint32_t characters_in(std::string_view text, Encoding encoding);

}  // namespace nplc::seqc::analysis
