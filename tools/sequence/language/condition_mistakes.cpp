#include "language/condition_mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "language/foreign_words.h"
#include "language/names.h"

namespace nplc::seqc {
namespace {

constexpr std::string_view kSeen =
    "a sequence sees inputs, INPOS, ERROR, TIMER.Q and COUNTER.Q, no positions, speeds or counts: move with "
    "POSITION(..) and test INPOS";

constexpr std::string_view kRegister =
    "registers cannot be tested: a move has arrived when INPOS is true; for a standstill wait a time, "
    "TIMER := T#500ms; on the way to the step and TIMER.Q in it";
constexpr std::string_view kStepActs = "a step's branches and its OUT hold while it is the active one";

bool is_zero(const Token& t) {
    return same_name(t.text, "FALSE") || same_name(t.text, "OFF") || t.text == "0";
}
bool is_one(const Token& t) {
    return same_name(t.text, "TRUE") || same_name(t.text, "ON") || t.text == "1";
}

std::string help_of_level(const TokenStream& in, const Token& first, std::string_view left, bool is_on) {
    if (looks_like_register(first.text) || in.declared().has_register(first.text))
        return std::string(kRegister);
    if (in.declared().has_output(first.text))
        return "an output cannot be tested: it is on in the steps that name it, and the step is known";
    return fmt::format("write {}{}", is_on ? "" : "NOT ", left);
}

/// The edge that a word stands for elsewhere; empty if for none.
std::string_view edge_meant(std::string_view word) {
    constexpr std::string_view kRising[] = {"R_TRIG", "R_EDGE",  "RISING",  "RISING_EDGE", "RISE",   "RISES",
                                            "REDGE",  "POSEDGE", "EDGE_UP", "EDGE",        "FLANKE", "RE"};
    constexpr std::string_view kFalling[] = {"F_TRIG", "F_EDGE", "FALLING", "FALLING_EDGE", "FALL",
                                             "FALLS",  "FEDGE",  "NEGEDGE", "EDGE_DOWN",    "FE"};
    const auto is = [&](std::string_view known) { return same_name(known, word); };
    if (std::any_of(std::begin(kRising), std::end(kRising), is)) return "R_TRIG";
    if (std::any_of(std::begin(kFalling), std::end(kFalling), is)) return "F_TRIG";
    return {};
}

/// The word of this language for one of another tongue; empty if there is none.
std::string_view translated(std::string_view word) {
    constexpr std::pair<std::string_view, std::string_view> kWords[] = {
        {"UND", "AND"}, {"ODER", "OR"}, {"NICHT", "NOT"}, {"ET", "AND"}, {"OU", "OR"}, {"NON", "NOT"}};
    for (const auto& [foreign, meant] : kWords) {
        if (same_name(foreign, word)) return meant;
    }
    return {};
}

bool is_operand_at(const TokenStream& in, std::size_t ahead) {
    return in.is_word_at(ahead) || in.token(ahead).kind == TokenKind::direct || in.is_symbol_at(ahead, "(") ||
           is_one_of(in.token(ahead), {"NOT", "INPOS", "ERROR", "ANY", "TIMER", "COUNTER"});
}

/// STEP = Idle
bool refuse_step_test(TokenStream& in, ast::Expression& result) {
    const auto compares = [&](std::size_t ahead) {
        return in.is_symbol_at(ahead, "=") || in.is_symbol_at(ahead, ":=") || in.is_symbol_at(ahead, "<") ||
               in.is_symbol_at(ahead, ">") || is_one_of(in.token(ahead), {"IN", "IS"});
    };
    const bool is_told = is_one_of(in.token(1), {"NOT"}) && compares(2);  // STEP != Idle
    if (!in.at("STEP") || (!compares(1) && !is_told)) return false;
    const Token first = in.token();
    in.skip();
    while (in.at("NOT") || compares(0)) in.skip();
    if (in.take_symbol("(")) {
        while (!in.at_symbol(")") && !in.at_boundary() && !in.at("THEN")) in.skip();
        in.take_symbol(")");
    } else if (in.is_word_at(0) || in.at("POWER_UP") || in.token().kind == TokenKind::number) {
        in.skip();
    }
    if (!is_told)
        in.report().add("E014", in.span_since(first), "a condition cannot ask for the step",
                        fmt::format("leave it out: {}; what many steps have in common stands above them, as "
                                    "in ON condition IN Idle, Work NEXT := Step;",
                                    kStepActs));
    result = {};
    return true;
}

/// RISING Start, R_TRIG Start
bool refuse_bare_edge(TokenStream& in, ast::Expression& result) {
    const Token first = in.token();
    const std::string_view edge = edge_meant(first.text);
    if (edge.empty() || !in.is_word_at(0)) return false;
    const Token name = in.token(1);
    if (name.kind != TokenKind::direct &&
        (!in.is_word_at(1) || has_line_end(in, first.span.offset, name.span.offset)))
        return false;
    in.skip(2);
    in.report().add("E014", in.span_since(first), "an edge has the input's name in parentheses",
                    fmt::format("write {}({})", edge, name.text));
    result = {};
    return true;
}

/// NO ERROR; continues as NOT ERROR.
bool mend_no_error(TokenStream& in, ast::Expression& result) {
    if (!is_one_of(in.token(), {"NO"}) || !is_one_of(in.token(1), {"ERROR"})) return false;
    const Token first = in.token();
    in.skip(2);
    in.report().add("E010", in.span_since(first), "there is no 'NO ERROR' in this language",
                    "write NOT ERROR, or nothing: a condition without the word ERROR holds without an error "
                    "alone");
    result.kind = ast::Expression::Kind::negation;
    result.operands.emplace_back().kind = ast::Expression::Kind::error;
    return true;
}

}  // namespace

bool looks_like_register(std::string_view name) {
    constexpr std::string_view kEnds[] = {"_IST", "_SOLL", "_REG", "_STAT", "_BITS", "_SETUP", "_MODE"};
    const std::string word = upper(name);
    return std::any_of(std::begin(kEnds), std::end(kEnds),
                       [&](std::string_view end) { return word.ends_with(end); });
}

bool at_comparison(const TokenStream& in) {
    return in.at_symbol("=") || in.at_symbol(":=") || in.at_symbol("<") || in.at_symbol(">") || in.at("IS");
}

bool refuse_comparison(TokenStream& in, ValueParser& values, const Token& first, ast::Expression& result,
                       bool is_told) {
    const std::string left(in.source().substr(first.span.offset, in.span_since(first).length));
    const bool differs = in.at_symbol("<") && in.is_symbol_at(1, ">");
    const bool is_above = in.at_symbol(">") && !in.is_symbol_at(1, "=");
    const bool is_below = in.at_symbol("<") && !in.is_symbol_at(1, "=") && !differs;
    const bool is_equal = !differs && !in.at_symbol("<") && !in.at_symbol(">");
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
    const bool joins_inputs =
        (differs || is_equal) && in.declared().has_input(first.text) && in.declared().has_input(right.text);
    result = {};
    if (is_told) return true;
    in.report().add(
        "E014", in.span_since(first), "a condition cannot compare: it is true or false",
        truth ? help_of_level(in, first, left, is_above || (!is_below && is_one(right) != differs))
        : joins_inputs
            ? fmt::format("write {}{} XOR {}{}", differs ? "" : "NOT (", left, right.text, differs ? "" : ")")
            : std::string(kSeen));
    return true;
}

bool refuse_call_or_part(TokenStream& in, bool in_property, bool may_call) {
    if (in.token().kind != TokenKind::identifier || in.at("NOT")) return false;
    const Token first = in.token();
    const bool calls = may_call && in.is_symbol_at(1, "(") && in.is_word_at(0);
    const bool has_part = in.is_symbol_at(1, ".") && !in.at("TIMER") && !in.at("COUNTER");
    if (!calls && !has_part) return false;
    const std::string_view edge = calls ? edge_meant(first.text) : std::string_view();
    const std::string argument(in.is_symbol_at(3, ")") ? in.token(2).text : "Start");
    in.skip(2);
    if (calls) {
        for (int open = 1; open > 0 && !in.at_boundary() && !in.at("THEN"); in.skip())
            open += in.at_symbol("(") ? 1 : in.at_symbol(")") ? -1 : 0;
    } else if (in.token().kind == TokenKind::identifier || in.token().kind == TokenKind::number) {
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
    if (has_part && last.kind == TokenKind::number)
        help = "inputs are IN0 to IN5, and the names of VAR_INPUT, each a bit by itself";
    if (!edge.empty()) help = fmt::format("an edge is {}: write {}({})", edge, edge, argument);
    if (calls && is_one_of(first, {"ACTIVE", "IS_ACTIVE", "IN_STEP"}))
        help = fmt::format("leave it out: {}", kStepActs);
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

bool refuse_edge_behind(TokenStream& in, const Token& first, ast::Expression& result) {
    const std::string_view edge = edge_meant(in.token().text);
    if (edge.empty() || !in.is_word_at(0)) return false;
    const std::string left(in.source().substr(first.span.offset, in.span_since(first).length));
    in.skip();
    in.report().add("E014", in.span_since(first), "an edge has the input's name in parentheses",
                    fmt::format("write {}({})", edge, left));
    result = {};
    return true;
}

bool refuse_foreign_condition(TokenStream& in, bool may_call, ast::Expression& result) {
    return refuse_step_test(in, result) || (may_call && refuse_bare_edge(in, result)) ||
           mend_no_error(in, result);
}

void mend_foreign_word(TokenStream& in, bool joins) {
    const std::string_view meant = translated(in.token().text);
    if (meant.empty() || (meant != "NOT") != joins || !in.is_word_at(0) || !is_operand_at(in, 1)) return;
    in.report().add("E010", in.token().span,
                    fmt::format("there is no {} in this language", shown(in.token())),
                    fmt::format("write {}", meant));
    in.replace(meant);
}

bool refuse_arithmetic(TokenStream& in) {
    const bool is_product = in.at_symbol("*");
    const bool is_negated = is_one_of(in.token(), {"NAND", "NOR"}) && is_operand_at(in, 1);
    if (!is_product && !in.at_symbol("+") && !in.at_symbol(",") && !is_negated) return false;
    in.report().add("E010", in.token().span, fmt::format("{} does not join conditions", shown(in.token())),
                    is_negated          ? fmt::format("write NOT (A {} B)", upper(in.token().text).substr(1))
                    : is_product        ? "write AND"
                    : in.at_symbol(",") ? "write AND where both must hold, OR where one of them is enough"
                                        : "write OR");
    while (!in.at("THEN") && !in.at_symbol(";") && !in.at_symbol(")") && !in.at_boundary()) in.skip();
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
