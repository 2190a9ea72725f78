#include "host/text_file.h"

#include <algorithm>

namespace nplc::host {
namespace {

constexpr std::string_view kMark = "\xEF\xBB\xBF";
constexpr const char* kZeros = "it is no text, for it holds zeros";
constexpr char kEndOfText = 0x1A;

bool has_utf16_mark(std::string_view bytes) {
    return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
}

bool is_letter_and_zero(char letter, char zero) {
    return zero == '\0' && letter >= '\t' && letter <= '~';
}

/// Two ASCII characters, each with a zero byte.
bool is_unmarked_utf16(std::string_view bytes) {
    return bytes.size() >= 4 &&
           ((is_letter_and_zero(bytes[0], bytes[1]) && is_letter_and_zero(bytes[2], bytes[3])) ||
            (is_letter_and_zero(bytes[1], bytes[0]) && is_letter_and_zero(bytes[3], bytes[2])));
}

/// The 16-bit unit at `at`, which is even.
unsigned unit_at(std::string_view bytes, std::size_t at, bool big_end_first) {
    const auto first = static_cast<unsigned char>(bytes[at]);
    const auto second = static_cast<unsigned char>(bytes[at + 1]);
    return big_end_first ? first * 0x100U + second : second * 0x100U + first;
}

/// Whether all units are of a text, with ASCII among them if wanted. Tables have units of zeros.
bool is_utf16_of(std::string_view bytes, bool big_end_first, bool wants_ascii) {
    constexpr std::size_t kShare = 8;
    if (bytes.empty() || bytes.size() % 2 != 0) return false;
    std::size_t ascii = 0;
    bool in_pair = false;
    for (std::size_t at = 0; at < bytes.size(); at += 2) {
        const unsigned unit = unit_at(bytes, at, big_end_first);
        const bool is_second_of_two = unit >= 0xDC00 && unit < 0xE000;
        const bool is_sign = unit >= ' ' && unit != 0x7F && unit < 0xFFFE;
        const bool is_blank = unit == '\t' || unit == '\n' || unit == '\r' || unit == '\f';
        if (is_second_of_two != in_pair || (!is_sign && !is_blank)) return false;
        in_pair = unit >= 0xD800 && unit < 0xDC00;
        if (unit < 0x80) ++ascii;
    }
    return !in_pair && (!wants_ascii || ascii * kShare >= bytes.size() / 2);
}

std::string why_no_text(std::string_view bytes) {
    if (has_utf16_mark(bytes) || is_unmarked_utf16(bytes)) return kUtf16Problem;
    return bytes.find('\0') == bytes.npos ? "" : kZeros;
}

/// Drops the CR of CR LF. A CR within a line is kept, unless no line ends with LF.
void end_lines_with_lf(std::string& text) {
    if (text.find('\r') == std::string::npos) return;
    if (text.find('\n') == std::string::npos) {
        std::replace(text.begin(), text.end(), '\r', '\n');
        return;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_first_of_two = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        if (!is_first_of_two) text[kept++] = text[i];
    }
    text.resize(kept);
}

}  // namespace

bool is_utf16_text(std::string_view bytes) {
    constexpr std::size_t kShortest = 8;
    if (!has_utf16_mark(bytes))
        return bytes.size() >= kShortest &&
               (is_utf16_of(bytes, false, true) || is_utf16_of(bytes, true, true));
    const std::string_view text = bytes.substr(2);
    if (text.size() >= 2 && (is_letter_and_zero(text[0], text[1]) || is_letter_and_zero(text[1], text[0])))
        return true;
    return is_utf16_of(text, bytes.front() == '\xFE', false);
}

std::string make_text(std::string& bytes) {
    if (std::string why = why_no_text(bytes); !why.empty()) return why;
    while (bytes.ends_with(kEndOfText)) bytes.pop_back();
    if (bytes.starts_with(kMark)) bytes.erase(0, kMark.size());
    end_lines_with_lf(bytes);
    return {};
}

bool TextPieces::add(std::string_view block) {
    constexpr std::size_t kLookedAt = 4;  // enough to decide whether it is text
    held_ += block;
    if (!has_begun_ && held_.size() < kLookedAt) return true;
    if (!has_begun_) begin();
    if (problem_.empty() && block.find('\0') != block.npos) problem_ = kZeros;
    if (problem_.empty()) give_lines();
    return problem_.empty() && !has_enough_;
}

void TextPieces::finish() {
    if (!has_begun_) begin();
    while (held_.ends_with(kEndOfText)) held_.pop_back();
    if (!problem_.empty() || held_.empty()) return;
    const bool is_ended = held_.ends_with('\r') && line_ends_.empty();  // the last line ends with a CR alone
    give(is_ended ? std::string_view(held_).substr(0, held_.size() - 1) : held_, true);
}

void TextPieces::begin() {
    has_begun_ = true;
    problem_ = why_no_text(held_);
    if (held_.starts_with(kMark)) held_.erase(0, kMark.size());
}

void TextPieces::give(std::string_view piece, bool ends_line) {
    if (ends_line && piece.ends_with('\r')) piece.remove_suffix(1);
    if (!has_enough_) has_enough_ = !take_(piece, ends_line);
}

/// CR alone ends lines if it does so before any LF. False: more data are needed.
bool TextPieces::knows_line_end() {
    if (!line_ends_.empty()) return true;
    const std::size_t end = held_.find_first_of("\r\n");
    if (end == held_.npos || (held_[end] == '\r' && end + 1 == held_.size())) return false;
    line_ends_ = held_[end] == '\r' && held_[end + 1] != '\n' ? "\r\n" : "\n";
    return true;
}

void TextPieces::give_lines() {
    std::string_view rest = held_;
    if (knows_line_end()) {
        for (std::size_t end = 0; (end = rest.find_first_of(line_ends_)) != rest.npos;
             rest.remove_prefix(end + 1))
            give(rest.substr(0, end), true);
    }
    while (rest.size() > kLongestPiece) {  // the last character may be the CR of its end
        give(rest.substr(0, kLongestPiece), false);
        rest.remove_prefix(kLongestPiece);
    }
    held_.erase(0, held_.size() - rest.size());
}

FileContent read_text(const std::string& name, std::size_t most) {
    FileContent file = read_file(name, most);
    if (!file.problem.empty()) return file;
    file.problem = make_text(file.bytes);
    if (!file.problem.empty()) file.bytes.clear();
    return file;
}

}  // namespace nplc::host
