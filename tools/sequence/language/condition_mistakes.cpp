#include "language/condition_mistakes.h"

#include <fmt/format.h>

#include <string>

#include "language/foreign_words.h"
#include "language/names.h"

namespace nplc::seqc {
namespace {

constexpr std::string_view kSeen =
    "a sequence sees inputs, INPOS, ERROR, TIMER.Q and COUNTER.Q, no positions, speeds or counts: move with "
    "POSITION(..) and test INPOS";

bool is_zero(const Token& t) {
    return same_name(t.text, "FALSE") || t.text == "0";
}
bool is_one(const Token& t) {
    return same_name(t.text, "TRUE") || t.text == "1";
}

}  // namespace

bool at_comparison(const TokenStream& in) {
    return in.at_symbol("=") || in.at_symbol(":=") || in.at_symbol("<") || in.at_symbol(">");
}

bool refuse_comparison(TokenStream& in, ValueParser& values, const Token& first, ast::Expression& result,
                       bool is_told) {
    const std::string left(in.source().substr(first.span.offset, in.span_since(first).length));
    const bool differs = in.at_symbol("<") && in.is_symbol_at(1, ">");
    while (at_comparison(in)) in.skip();
    if (!in.take_symbol("-")) in.take_symbol("+");
    const Token right = in.token();
    const bool literal =
        right.kind == TokenKind::number || right.kind == TokenKind::based || right.kind == TokenKind::time;
    if (literal || right.kind == TokenKind::direct || in.is_word_at(0) || is_one(right) || is_zero(right))
        in.skip();
    if (literal && in.is_word_at(0)) {
        ast::Value unit;
        values.parse_unit(unit);
    }
    const bool truth = is_one(right) || is_zero(right);
    result = {};
    if (is_told) return true;
    in.report().add(
        "E014", in.span_since(first), "a condition cannot compare: it is true or false",
        truth ? fmt::format("write {}{}", is_one(right) != differs ? "" : "NOT ", left) : std::string(kSeen));
    return true;
}

bool refuse_call_or_part(TokenStream& in, bool in_property, bool may_call) {
    if (in.token().kind != TokenKind::identifier || in.at("NOT")) return false;
    const Token first = in.token();
    const bool calls = may_call && in.is_symbol_at(1, "(") && in.is_word_at(0);
    const bool has_part = in.is_symbol_at(1, ".") && !in.at("TIMER") && !in.at("COUNTER");
    if (!calls && !has_part) return false;
    in.skip(2);
    if (calls) {
        for (int open = 1; open > 0 && !in.at_boundary() && !in.at("THEN"); in.skip())
            open += in.at_symbol("(") ? 1 : in.at_symbol(")") ? -1 : 0;
    } else if (in.token().kind == TokenKind::identifier) {
        in.skip();
    }
    const Token& last = in.last();
    const ForeignWord* word = foreign_word(first.text);
    const ForeignWord* timer = foreign_word("TON");
    std::string help(word != nullptr ? word->help : same_name(last.text, "Q") ? timer->help : kSeen);
    if (same_name(last.text, "X") || same_name(last.text, "T"))
        help =
            "a step is the active one while its branches are judged; how long it may take says IF condition "
            "WITHIN T#3s, or TIMER := T#3s; on the way to it and TIMER.Q";
    if (same_name(last.text, "INPOS") || same_name(last.text, "ERROR")) help = "write " + upper(last.text);
    const bool is_edge = same_name(first.text, "R_TRIG") || same_name(first.text, "F_TRIG");
    if (in_property && calls && is_edge) {
        const bool rises = same_name(first.text, "R_TRIG");
        in.report().add("E014", in.span_since(first),
                        "a property looks at one scan after another, and has no edges",
                        rises ? "write NOT Start FOLLOWED BY Start" : "write Start FOLLOWED BY NOT Start");
        return true;
    }
    in.report().add("E014", in.span_since(first),
                    calls ? fmt::format("a condition has no functions: there is no '{}'", first.text)
                          : fmt::format("'{}' has no parts", first.text),
                    help);
    return true;
}

bool mend_numbered_timer(TokenStream& in) {
    const std::string_view word = numbered_timer(in.token().text);
    if (word.empty()) return false;
    in.report().add(
        "E014", in.token().span, fmt::format("there is one {}", word),
        fmt::format("write {}.Q, and preset it anew on the way to each step that needs it", word));
    in.replace(word);
    return true;
}

bool refuse_time_as_condition(TokenStream& in, ValueParser& values, bool in_property,
                              ast::Expression& result) {
    const Token first = in.token();
    const bool is_word = in.at("AFTER") || in.at("DELAY") || in.at("WAIT") || in.at("ELAPSED");
    const std::size_t ahead = is_word ? 1 : 0;
    const bool is_time =
        in.token(ahead).kind == TokenKind::time || (is_word && in.token(ahead).kind == TokenKind::number);
    if (!is_time || in_property) return false;
    in.skip(ahead);
    ast::Value time;
    values.parse(time);
    in.report().add(
        "E014", in.span_since(first), "a time is no condition by itself",
        "write TIMER := T#3s; on the way to the step and IF TIMER.Q THEN in it; or IF condition FOR 3 s");
    result = {};
    return true;
}

bool refuse_misplaced_time(TokenStream& in, ValueParser& values) {
    if (!is_one_of(in.token(), {"FOR", "WITHIN"})) return false;
    const Token first = in.token();
    in.skip();
    ast::Value time;
    if (in.token().kind == TokenKind::time || in.token().kind == TokenKind::number) values.parse(time);
    const std::string word = upper(first.text);
    in.report().add(
        "E010", in.span_since(first), fmt::format("{} stands behind the whole condition, before THEN", word),
        fmt::format("write IF condition {} T#500ms THEN; what lasts beside other conditions goes into an "
                    "IF of its own step",
                    word));
    return true;
}

}  // namespace nplc::seqc
