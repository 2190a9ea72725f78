#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "seqc/diagnostic.h"

namespace nplc::seqc::analysis {

/// How a client counts the characters of a line.
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

/// Where the lines of a text begin, which must stay alive. Lines end with LF, CR LF or CR.
class Lines {
  public:
    explicit Lines(std::string_view text);

    std::size_t count() const { return starts_.size(); }
    Place place_of(std::uint32_t offset, Encoding encoding) const;
    Range range_of(Span span, Encoding encoding) const;
    /// Beyond the end of a line or of the text: that end.
    std::uint32_t offset_of(Place place, Encoding encoding) const;
    std::uint32_t line_of(std::uint32_t offset) const;
    std::uint32_t start_of(std::uint32_t line) const { return starts_[line]; }
    /// Without its end.
    std::string_view line(std::uint32_t number) const;

  private:
    std::string_view text_;
    std::vector<std::uint32_t> starts_;
};

/// Of a text that may be no UTF-8: what is none counts as one character a byte.
std::uint32_t characters_in(std::string_view text, Encoding encoding);

}  // namespace nplc::seqc::analysis
