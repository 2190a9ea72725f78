#include "language/statement_mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "language/foreign_words.h"
#include "language/names.h"

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
