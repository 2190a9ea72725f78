#include "language/statement_mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "language/condition_mistakes.h"
#include "language/foreign_words.h"
#include "language/names.h"
#include "language/reserved_words.h"

namespace nplc::seqc {

/// A word is misspelt if no statement can continue like this: "ELIF Guard", "ENDIF END_STEP", "NXT := Idle".
void mend_statement(TokenStream& in, const Notes& notes, std::vector<std::string_view> end_words) {
    if (!in.is_word_at(0) || foreign_word(in.token().text) != nullptr) return;
    const Token& after = in.token(1);
    const bool symbol = after.kind == TokenKind::symbol;
    if (symbol && after.text == ":=") {
        const bool names_step = in.is_word_at(2) || same_name(in.token(2).text, "POWER_UP");
        if (notes.is_register(in.token().text) || !names_step || nearest(in.token().text, {"NEXT"}).empty())
            return;
        in.report().add("E021", in.token().span, fmt::format("there is no register '{}'", in.token().text),
                        "did you mean 'NEXT'?");
        in.replace("NEXT");
    } else if (symbol && after.text == ";") {
        in.mend(end_words, "a statement");
    } else if (!symbol || after.text != "(") {
        std::vector<std::string_view> words = std::move(end_words);
        words.insert(words.end(), {"IF", "OUT", "ENTRY", "OWN", "EVERY_SCAN", "TERM", "NEXT", "NO_HELPER"});
        in.mend(words, "a statement");
    }
}

bool refuse_foreign_word(TokenStream& in) {
    if (in.token().kind != TokenKind::identifier || in.is_symbol_at(1, ":=")) return false;
    const ForeignWord* word = foreign_word(in.token().text);
    if (word == nullptr) return false;
    in.report().add("E010", in.token().span,
                    fmt::format("there is no {} in this language", shown(in.token())),
                    std::string(word->help));
    if (word->end.empty()) return true;
    const auto closes = [&] {
        return in.at("END_STEP") || in.at("STEP") || in.at("POWER_UP") || in.at("END_PROGRAM");
    };
    while (!in.at_end() && !in.at(word->end) && !closes()) in.skip();
    in.take(word->end);
    return true;
}

bool refuse_time_as_statement(TokenStream& in) {
    if (!is_one_of(in.token(), {"WITHIN"})) return false;
    in.report().add("E010", in.token().span, "WITHIN stands behind the condition, before THEN",
                    "write IF condition WITHIN T#3s THEN NEXT := Step; ELSE NEXT := Fault; END_IF");
    return true;
}

bool refuse_bare_arguments(TokenStream& in, const ast::Statement& statement) {
    if (!is_one_of(in.last(), {"POSITION", "VELOCITY", "INIT", "USE_SET"})) return false;
    if (!in.is_word_at(0) && in.token().kind != TokenKind::number) return false;
    const Token first = in.token();
    while (in.is_word_at(0) || in.token().kind == TokenKind::number || in.at_symbol(",")) in.skip();
    const Span place = in.span_since(first);
    in.report().add("E050", place,
                    fmt::format("{} has its registers in parentheses", upper(statement.name.text)),
                    fmt::format("write {}({})", upper(statement.name.text), in.text_of(place)));
    return true;
}

bool refuse_state(TokenStream& in, const Notes& notes, const ast::Statement& statement) {
    if (notes.is_register(statement.name.text) || !in.at_symbol(":=") ||
        !same_name(statement.name.text, "STATE"))
        return false;
    in.report().add("E010", statement.name.span,
                    fmt::format("there is no '{}' in this language", statement.name.text),
                    std::string(foreign_word("STATE")->help));
    return true;
}

bool refuse_set_of_value(TokenStream& in, ast::Statement& statement) {
    const bool assigns = in.is_symbol_at(1, ":=") || in.is_symbol_at(1, "=");
    if (!assigns && in.token(1).kind != TokenKind::number) return false;
    const std::string_view level = in.token(2).text;
    const bool on = same_name(level, "TRUE") || same_name(level, "ON") || level == "1";
    const bool off = same_name(level, "FALSE") || same_name(level, "OFF") || level == "0";
    std::string help = "write SET Name; with the name of an output; the motor is moved with POSITION(P..)";
    if (assigns) help = fmt::format("a register is written without it: {} := value;", in.token().text);
    if (assigns && (on || off)) help = fmt::format("write {} {};", on ? "SET" : "RESET", in.token().text);
    in.report().add("E010", statement.name.span,
                    fmt::format("{} switches outputs", upper(statement.name.text)), help);
    while (!in.at_symbol(";") && !in.at_boundary()) in.skip();
    return true;
}

bool refuse_qualifier(TokenStream& in) {
    struct Qualifier {
        std::string_view word;
        std::string_view help;
    };
    constexpr auto kQualifiers = std::to_array<Qualifier>({
        {"N", "write OUT {0};"},
        {"S", "write SET {0}; in the branch that leads to the step, or ENTRY SET {0};"},
        {"R", "write RESET {0}; in a branch, or ENTRY RESET {0};"},
        {"P", "write ENTRY {0}; for a command; an output is on for as long as the step is active: OUT {0};"},
        {"P1", "write ENTRY {0}; for a command; an output is on for as long as the step is active: OUT {0};"},
        {"L",
         "write OUT {0}; and leave the step after the time: TIMER := T#3s; on the way to it, TIMER.Q in it"},
        {"D", "write OUT {0}; in a step of its own that a time leads to: TIMER := T#3s; and TIMER.Q"},
    });
    const auto* const found = std::find_if(kQualifiers.begin(), kQualifiers.end(), [&](const Qualifier& row) {
        return same_name(row.word, in.token().text);
    });
    const bool has_time = in.token(1).kind == TokenKind::time;
    const std::size_t at = in.is_symbol_at(1, ",") || has_time ? 2 : 1;
    if (found == kQualifiers.end() || in.token().kind != TokenKind::identifier || !in.is_word_at(at) ||
        !in.is_symbol_at(at + 1, ";"))
        return false;
    in.report().add("E010", in.token().span,
                    fmt::format("there is no qualifier '{}' in this language", in.token().text),
                    fmt::format(fmt::runtime(found->help), in.token(at).text));
    return true;
}

bool refuse_no_statement(TokenStream& in) {
    if (in.in_open_comment() || in.at_end()) return false;
    constexpr std::string_view kStatements =
        "statements are NEXT := Step; TIMER := T#1s; commands and register values";
    const bool is_word = in.token().kind == TokenKind::identifier;
    std::string help(kStatements);
    if (is_one_of(in.token(), {"WHEN", "ON"}))
        help = "in a step write IF condition THEN NEXT := Step; END_IF";
    else if (is_one_of(in.token(), {"ERROR"}))
        help = foreign_word("CLEAR_ERROR")->help;
    else if (is_word && !is_reserved(in.token().text))
        return false;
    else if (in.at_symbol(":"))
        help = fmt::format("leave the colon out: '{}' has none", in.last().text);
    else if (in.at_symbol("-") && in.is_symbol_at(1, ">"))
        help = foreign_word("GOTO")->help;
    else if (in.at_symbol("(") && in.is_word_at(1))
        help = fmt::format("an output is on in the step that says OUT {};", in.token(1).text);
    in.error_here("a statement", help);
    return true;
}

bool refuse_switch_without_name(TokenStream& in) {
    if (!is_one_of(in.token(), {"SET", "RESET"})) return false;
    const std::string word = upper(in.token().text);
    const bool has_name = in.is_symbol_at(1, "(") && in.is_word_at(2);
    if (!has_name && !in.is_symbol_at(1, ";")) return false;
    in.report().add("E010", in.token().span, fmt::format("{} needs the name of an output behind it", word),
                    has_name          ? fmt::format("write {} {};", word, in.token(2).text)
                    : word == "RESET" ? "write RESET Lamp; or RESET_ERROR; for the motor's error"
                                      : "write SET Lamp;");
    return true;
}

bool refuse_reckoning(TokenStream& in, const ast::Statement& statement) {
    const bool sign = in.at_symbol("+") || in.at_symbol("-") || in.at_symbol("*") || in.at_symbol("/");
    const bool doubled = in.is_symbol_at(1, "=") || (sign && in.is_symbol_at(1, in.token().text));
    if (!sign || !doubled) return false;
    in.skip(2);
    in.report().add("E010",
                    {statement.name.span.offset,
                     in.last().span.offset + in.last().span.length - statement.name.span.offset},
                    "a sequence does not calculate: a register is given a value that is known beforehand",
                    "count with COUNTER := 5; COUNT_DOWN; and COUNTER.Q; a move by a distance is made with "
                    "POSITIONS_RELATIVE_P_FNC; at POWER_UP");
    return true;
}

bool refuse_level(TokenStream& in, const ast::Statement& statement) {
    const std::string_view name = statement.name.text;
    const Token level = in.token(1);
    const bool is_output = in.declared().has_output(name);
    if (in.declared().has_constant(level.text)) return false;
    const bool is_alone = in.is_symbol_at(2, ";");
    const bool is_on = is_alone && (is_one_of(level, {"ON", "TRUE"}) || (is_output && level.text == "1"));
    const bool is_off = is_alone && (is_one_of(level, {"OFF", "FALSE"}) || (is_output && level.text == "0"));
    if (!is_on && !is_off && !is_output) return false;
    const bool is_register = !is_output && (looks_like_register(name) || in.declared().has_register(name));
    in.skip();
    const Token first = in.token();
    while (!in.at_symbol(";") && !in.at_boundary() && !in.at("NEXT")) in.skip();
    const std::uint32_t begin = statement.name.span.offset;
    const Span value{first.span.offset, in.last().span.offset + in.last().span.length - first.span.offset};
    constexpr std::uint32_t kMostShown = 60;
    const bool is_short = value.length <= kMostShown;
    in.report().add(
        "E010", {begin, value.offset + value.length - begin},
        "':=' gives a register a number: it switches nothing",
        is_register
            ? fmt::format("write the number, such as {} := 100; ON and OFF are of outputs: OUT Lamp;", name)
        : is_on ? fmt::format("write OUT {0}; in the step where it is on, or SET {0}; until RESET {0};", name)
        : is_off   ? fmt::format("an output that no OUT of the step names is off; RESET {}; ends a SET", name)
        : is_short ? fmt::format("write OUT {} WHEN {};", name, in.text_of(value))
                   : fmt::format("write OUT {} WHEN condition;", name));
    return true;
}

bool refuse_condition_of_set(TokenStream& in, const ast::Statement& statement) {
    if (!is_one_of(in.token(), {"WHEN", "IF"})) return false;
    const std::string word = upper(statement.name.text);
    in.report().add(
        "E010", in.token().span, fmt::format("{} has no condition of its own", word),
        fmt::format("write IF condition THEN {} Name; NEXT := Step; END_IF; an output that follows a "
                    "condition is OUT Name WHEN condition;",
                    word));
    return true;
}

bool refuse_or_of_bits(TokenStream& in) {
    if (!is_one_of(in.token(), {"OR"}) && !in.at_symbol("|")) return false;
    in.report().add("E010", in.token().span, "bits of a register are joined with +", "write HICLK + INPSIGN");
    return true;
}

}  // namespace nplc::seqc
