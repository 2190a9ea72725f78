#include "seqc/format.h"

#include <algorithm>

#include "format/layout.h"
#include "format/lines.h"
#include "format/shape.h"
#include "format/spell.h"
#include "syntax/lexer.h"
#include "syntax/names.h"
#include "syntax/parser.h"

namespace nplc::seqc {
namespace layout {

std::string lay_out(std::string_view source, const std::vector<Token>& tokens,
                    const std::vector<Token>& comments) {
    Document document = document_of(source, tokens, comments);
    spell(document);
    shape(document);
    std::vector<Line> lines = lines_of(document);
    wrap(lines);
    align_declarations(lines);
    space_out(lines);
    return print(lines);
}

}  // namespace layout

namespace {

struct Lexed {
    explicit Lexed(std::string_view text, Report& report)
        : source(text), tokens(tokens_of(text, report, &comments)) {}

    std::string_view source;
    std::vector<Token> comments;
    std::vector<Token> tokens;
};

std::string lay_out(const Lexed& lexed) {
    return layout::lay_out(lexed.source, lexed.tokens, lexed.comments);
}

bool is_same(const layout::Item& a, const layout::Item& b) {
    if (a.token != b.token) return false;
    return a.is_comment() ? a.text == b.text : same_name(a.text, b.text);
}

bool has_same_items(const Lexed& a, const Lexed& b) {
    const layout::Document before = layout::document_of(a.source, a.tokens, a.comments);
    const layout::Document after = layout::document_of(b.source, b.tokens, b.comments);
    return std::equal(before.items.begin(), before.items.end(), after.items.begin(), after.items.end(),
                      is_same);
}

/// What went wrong, or nothing.
std::string fault_in(const Lexed& source, const std::string& text) {
    Report report;
    const Lexed again(text, report);
    if (report.has_errors() || !has_same_items(source, again))
        return "the formatted program would not be the same program";
    if (lay_out(again) != text) return "formatting the formatted program would change it again";
    return {};
}

/// The parser also reports what stands twice or has an odd value: such programs can be laid out.
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
        report.error("E003", {}, "the file is larger than 16 MiB: this is no program");
        result.diagnostics = report.take();
        return result;
    }
    const Lexed lexed(source, report);
    Parser(source, lexed.tokens, report).parse();
    const bool was_read_whole = !report.full();
    result.more_diagnostics = report.has_more();
    std::vector<Diagnostic> found = report.take();
    if (!was_read_whole || std::any_of(found.begin(), found.end(), is_about_grammar)) {
        result.diagnostics = std::move(found);
        return result;
    }
    std::string text = lay_out(lexed);
    result.fault = fault_in(lexed, text);
    result.ok = result.fault.empty();
    if (result.ok) result.text = std::move(text);
    return result;
}

}  // namespace nplc::seqc
