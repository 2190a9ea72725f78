#include "host/text_file.h"

#include <algorithm>

namespace nplc::host {
namespace {

constexpr std::string_view kMark = "\xEF\xBB\xBF";
constexpr const char* kUtf16 = "it is text in UTF-16; save it as UTF-8";
constexpr char kEndOfText = 0x1A;

bool has_utf16_mark(std::string_view bytes) {
    return bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
}

bool is_letter_and_zero(char letter, char zero) {
    return zero == '\0' && letter >= '\t' && letter <= '~';
}

/// Two characters of ASCII and their zeros.
bool is_unmarked_utf16(std::string_view bytes) {
    return bytes.size() >= 4 &&
           ((is_letter_and_zero(bytes[0], bytes[1]) && is_letter_and_zero(bytes[2], bytes[3])) ||
            (is_letter_and_zero(bytes[1], bytes[0]) && is_letter_and_zero(bytes[3], bytes[2])));
}

/// Drops the CRs of CR LF. A CR within a line stays what it is, unless no LF ends any line.
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

bool is_marked_utf16(std::string_view bytes) {
    if (!has_utf16_mark(bytes)) return false;
    const std::string_view text = bytes.substr(2, 2);
    return text.size() == 2 && (is_letter_and_zero(text[0], text[1]) || is_letter_and_zero(text[1], text[0]));
}

std::string make_text(std::string& bytes) {
    if (has_utf16_mark(bytes) || is_unmarked_utf16(bytes)) return kUtf16;
    if (bytes.find('\0') != std::string::npos) return "it is no text, for it holds zeros";
    while (bytes.ends_with(kEndOfText)) bytes.pop_back();
    if (bytes.starts_with(kMark)) bytes.erase(0, kMark.size());
    end_lines_with_lf(bytes);
    return {};
}

FileContent read_text(const std::string& name, std::size_t most) {
    FileContent file = read_file(name, most);
    if (!file.problem.empty()) return file;
    file.problem = make_text(file.bytes);
    if (!file.problem.empty()) file.bytes.clear();
    return file;
}

}  // namespace nplc::host
