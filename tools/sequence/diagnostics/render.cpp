#include "seqc/diagnostic.h"
#include "seqc/sources.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/printable.h"

namespace nplc::seqc {
namespace {

using host::printable;

constexpr std::size_t kShown = 100;
constexpr std::size_t kShownBefore = 40;
constexpr std::size_t kLongestMessage = 400;
constexpr std::size_t kBetweenMarks = 256;  // bytes

bool continues_character(char c) {
    return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

std::uint32_t characters(std::string_view text) {
    return static_cast<std::uint32_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return !continues_character(c); }));
}

Position behind(Position at, std::string_view text) {
    for (char c : text) {
        if (c == '\n') {
            at = {at.line + 1, 1};
        } else if (!continues_character(c)) {
            ++at.column;
        }
    }
    return at;
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

/// Terminal colours, or empty.
struct Paint {
    explicit Paint(Colour colour) : on(colour == Colour::on) {}

    std::string operator()(std::string_view code, std::string_view text) const {
        return on ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
    }

    bool on;
};

constexpr std::string_view kBold = "1";
constexpr std::string_view kError = "1;31";
constexpr std::string_view kWarning = "1;33";
constexpr std::string_view kNote = "1;36";
constexpr std::string_view kHelp = "1;32";

/// About kShown bytes of a line around a column; whole characters.
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

std::string excerpt(std::string_view source, Span span, const Paint& paint, std::string_view colour) {
    const Line line = line_at(source, span.offset);
    const std::size_t column =
        std::min<std::size_t>(span.offset - std::min<std::size_t>(span.offset, line.start), line.text.size());
    const Window window = window_of(line.text, column);
    const std::string_view before = window.cut_before ? "..." : "";
    std::string margin(before.size(), ' ');
    for (char c : printable(window.text.substr(0, window.column))) {
        if (!continues_character(c)) margin += c == '\t' ? '\t' : ' ';
    }
    const std::size_t marked = std::min<std::size_t>(span.length, window.text.size() - window.column);
    const std::uint32_t width =
        std::max(1U, characters(printable(window.text.substr(window.column, marked))));
    const std::string number = std::to_string(position_of(source, span.offset).line);
    return fmt::format(" {} | {}{}{}\n {:{}} | {}{}\n", number, before, printable(window.text),
                       window.cut_after ? "..." : "", "", number.size(), margin,
                       paint(colour, "^" + std::string(width - 1, '~')));
}

/// Truncates: names and values in a message may be as long as the program.
std::string bounded(const std::string& message) {
    if (message.size() <= kLongestMessage) return printable(message);
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

Positions::Positions(std::string_view source) : source_(source) {
    marks_.reserve(source.size() / kBetweenMarks + 1);
    marks_.push_back({});
    for (std::size_t at = kBetweenMarks; at <= source.size(); at += kBetweenMarks)
        marks_.push_back(behind(marks_.back(), source.substr(at - kBetweenMarks, kBetweenMarks)));
}

Position Positions::of(std::uint32_t offset) const {
    const std::size_t at = std::min<std::size_t>(offset, source_.size());
    const std::size_t mark = at / kBetweenMarks;
    const std::size_t from = mark * kBetweenMarks;
    return behind(marks_[mark], source_.substr(from, at - from));
}

namespace {

/// The file of a position, with its text.
struct Located {
    std::string_view source;
    std::string_view file_name;
    Span span;
    Position at() const { return position_of(source, span.offset); }
};

template <typename Locate>
std::string render_with(const Diagnostic& diagnostic, const Locate& locate, Colour colour) {
    const Paint paint(colour);
    const Located place = locate(diagnostic.span);
    const Position at = place.at();
    const bool is_error = diagnostic.severity == Severity::error;
    const std::string_view shade = is_error ? kError : kWarning;
    const std::string what = fmt::format("{} {}", is_error ? "error" : "warning", diagnostic.code);
    std::string text = fmt::format("{}:{}:{}: {}: {}\n", printable(place.file_name), at.line, at.column,
                                   paint(shade, what), paint(kBold, bounded(diagnostic.message)));
    text += excerpt(place.source, place.span, paint, shade);
    if (!diagnostic.help.empty())
        text += fmt::format("  {}: {}\n", paint(kHelp, "help"), bounded(diagnostic.help));
    for (const Note& note : diagnostic.notes) {
        const Located other = locate(note.span);
        text += fmt::format("  {}: {}:{}:{}: {}\n", paint(kNote, "note"), printable(other.file_name),
                            other.at().line, other.at().column, bounded(note.message));
        text += excerpt(other.source, other.span, paint, kNote);
    }
    return text;
}

}  // namespace

std::string render(const Diagnostic& diagnostic, std::string_view source, std::string_view file_name,
                   Colour colour) {
    return render_with(
        diagnostic,
        [&](Span span) {
            return Located{source, file_name, span};
        },
        colour);
}

std::string render(const Diagnostic& diagnostic, const Sources& sources, Colour colour) {
    return render_with(
        diagnostic,
        [&](Span span) {
            const SourceFile& file = sources.file_at(span.offset);
            return Located{sources.text_of(file), file.name, {span.offset - file.offset, span.length}};
        },
        colour);
}

}  // namespace nplc::seqc
