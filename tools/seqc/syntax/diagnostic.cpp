#include "seqc/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>

namespace nplc::seqc {
namespace {

constexpr std::size_t kShown = 100;
constexpr std::size_t kShownBefore = 40;
constexpr std::size_t kLongestMessage = 400;

bool continues_character(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

std::uint32_t characters(std::string_view text) {
    return static_cast<std::uint32_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return !continues_character(c); }));
}

struct Line {
    std::string_view text;
    std::size_t start;
};

Line line_at(std::string_view source, std::size_t offset) {
    const std::size_t at = std::min(offset, source.size());
    const std::size_t before = at == 0 ? std::string_view::npos : source.rfind('\n', at - 1);
    const std::size_t start = before == std::string_view::npos ? 0 : before + 1;
    std::size_t end = source.find('\n', start);
    if (end == std::string_view::npos) end = source.size();
    if (end > start && source[end - 1] == '\r') --end;
    return {source.substr(start, end - start), start};
}

/// Control characters would upset a terminal.
std::string printable(std::string_view text) {
    std::string result(text);
    for (char& c : result) {
        if (c != '\t' && (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)) c = '?';
    }
    return result;
}

/// About kShown bytes of a line, with the column in it; whole characters.
struct Window {
    std::string_view text;
    std::size_t column;
    bool cut_before;
    bool cut_after;
};

Window window_of(std::string_view line, std::size_t column) {
    if (line.size() <= kShown) return {line, column, false, false};
    std::size_t begin = column > kShownBefore ? column - kShownBefore : 0;
    begin = std::min(begin, line.size() - kShown);
    std::size_t end = begin + kShown;
    while (begin < column && continues_character(line[begin])) ++begin;
    while (end > column && end < line.size() && continues_character(line[end])) --end;
    return {line.substr(begin, end - begin), column - begin, begin > 0, end < line.size()};
}

std::string excerpt(std::string_view source, Span span) {
    const Line line = line_at(source, span.offset);
    const std::size_t column =
        std::min<std::size_t>(span.offset - std::min<std::size_t>(span.offset, line.start), line.text.size());
    const Window window = window_of(line.text, column);
    const std::string_view before = window.cut_before ? "..." : "";
    std::string margin(before.size(), ' ');
    for (char c : window.text.substr(0, window.column)) {
        if (!continues_character(c)) margin += c == '\t' ? '\t' : ' ';
    }
    const std::size_t marked = std::min<std::size_t>(span.length, window.text.size() - window.column);
    const std::uint32_t width = std::max(1U, characters(window.text.substr(window.column, marked)));
    const std::string number = std::to_string(position_of(source, span.offset).line);
    return fmt::format(" {} | {}{}{}\n {:{}} | {}^{:~<{}}\n", number, before, printable(window.text),
                       window.cut_after ? "..." : "", "", number.size(), margin, "", width - 1);
}

/// Names and values in a message may be as long as the program.
std::string bounded(const std::string& message) {
    if (message.size() <= kLongestMessage) return message;
    std::size_t head = kLongestMessage / 2;
    std::size_t tail = message.size() - kLongestMessage / 4;
    while (head > 0 && continues_character(message[head])) --head;
    while (tail < message.size() && continues_character(message[tail])) ++tail;
    return printable(message.substr(0, head) + "..." + message.substr(tail));
}

}  // namespace

Position position_of(std::string_view source, std::uint32_t offset) {
    const Line line = line_at(source, offset);
    const auto end = source.begin() + static_cast<std::ptrdiff_t>(line.start);
    const std::size_t at = std::min<std::size_t>(offset, source.size());
    return {static_cast<std::uint32_t>(1 + std::count(source.begin(), end, '\n')),
            1 + characters(source.substr(line.start, at - line.start))};
}

std::string render(const Diagnostic& diagnostic, std::string_view source, std::string_view file_name) {
    const Position at = position_of(source, diagnostic.span.offset);
    const char* kind = diagnostic.severity == Severity::error ? "error" : "warning";
    std::string text = fmt::format("{}:{}:{}: {} {}: {}\n", file_name, at.line, at.column, kind,
                                   diagnostic.code, bounded(diagnostic.message));
    text += excerpt(source, diagnostic.span);
    if (!diagnostic.help.empty()) text += fmt::format("  help: {}\n", bounded(diagnostic.help));
    for (const Note& note : diagnostic.notes) {
        const Position other = position_of(source, note.span.offset);
        text +=
            fmt::format("  note: {}:{}:{}: {}\n", file_name, other.line, other.column, bounded(note.message));
        text += excerpt(source, note.span);
    }
    return text;
}

}  // namespace nplc::seqc
