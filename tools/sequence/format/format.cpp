#include "seqc/format.h"

#include <algorithm>
#include <utility>

#include "format/layout.h"
#include "language/lexer.h"
#include "language/names.h"
#include "language/parser.h"

namespace nplc::seqc {
namespace layout {
namespace {

struct Lexed {
    Lexed(std::string_view text, Report& report) : source(text), tokens(tokens_of(text, report, &comments)) {}

    std::string_view source;
    std::vector<Token> comments;
    std::vector<Token> tokens;
};

bool is_same(const Item& a, const Item& b) {
    if (a.token != b.token) return false;
    return a.is_comment() ? a.text == b.text : same_name(a.text, b.text);
}

bool has_same_items(std::string_view source, const Lexed& formatted) {
    Report ignored;
    const Lexed lexed(source, ignored);
    const Document before = document_of(lexed.source, lexed.tokens, lexed.comments);
    const Document after = document_of(formatted.source, formatted.tokens, formatted.comments);
    return std::equal(before.items.begin(), before.items.end(), after.items.begin(), after.items.end(),
                      is_same);
}

}  // namespace

std::string lay_out(std::string_view source, std::vector<Token> tokens, std::vector<Token> comments) {
    Document document = document_of(source, tokens, comments);
    tokens = {};
    comments = {};
    spell(document);
    shape(document);
    std::vector<Line> lines = lines_of(document);
    wrap(lines);
    align_declarations(lines);
    space_out(lines);
    return print(lines);
}

std::string fault_between(std::string_view source, std::string_view text) {
    Report report;
    Lexed after(text, report);
    if (report.has_errors() || !has_same_items(source, after))
        return "the formatted program would not be the same program";
    if (lay_out(text, std::move(after.tokens), std::move(after.comments)) != text)
        return "formatting the formatted program would change it again";
    return {};
}

}  // namespace layout

namespace {

/// The parser also reports duplicates and invalid values: such programs can be formatted.
bool is_about_grammar(const Diagnostic& diagnostic) {
    const bool is_about_meaning =
        diagnostic.code == "E020" || diagnostic.code == "E032" || diagnostic.code == "E090";
    return diagnostic.severity == Severity::error && !is_about_meaning;
}

}  // namespace

Formatted format_program(std::string_view source) {
    Formatted result;
    Report report;
    if (source.size() > kLongestSource) {
        report.add("E001", {}, "the file is larger than 16 MiB: this is no program");
        result.diagnostics = report.take();
        return result;
    }
    std::vector<Token> comments;
    Parser parser(source, tokens_of(source, report, &comments), report);
    if (parser.at_part()) {
        parser.parse_part();
    } else {
        parser.parse();
    }
    const bool was_read_whole = !report.full();
    result.more_diagnostics = report.has_more();
    std::vector<Diagnostic> found = report.take();
    if (!was_read_whole || std::any_of(found.begin(), found.end(), is_about_grammar)) {
        result.diagnostics = std::move(found);
        return result;
    }
    std::string text = layout::lay_out(source, parser.take_tokens(), std::move(comments));
    if (text.size() > kLongestSource) {
        report.add("E001", {}, "the formatted program would be larger than 16 MiB");
        result.diagnostics = report.take();
        return result;
    }
    result.fault = layout::fault_between(source, text);
    result.ok = result.fault.empty();
    if (result.ok) result.text = std::move(text);
    return result;
}

}  // namespace nplc::seqc
