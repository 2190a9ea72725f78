#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "language/foreign_words.h"
#include "language/names.h"
#include "language/parser.h"

/// Keywords in the wrong place: one message names the correct place.
namespace nplc::seqc {
namespace {

constexpr auto kOutside = std::to_array<std::string_view>(
    {"INCLUDE", "CONST", "SCALE", "MOTOR", "GROUP", "SET_POINT", "VAR_INPUT", "VAR_OUTPUT", "VAR_MOTOR"});

}  // namespace

/// A word is misspelt if no statement can continue like this: "ELIF Guard", "ENDIF END_STEP", "NXT := Idle".
void Parser::mend_statement(std::vector<std::string_view> end_words) {
    if (!in_.is_word_at(0) || foreign_word(in_.token().text) != nullptr) return;
    const Token& after = in_.token(1);
    const bool symbol = after.kind == TokenKind::symbol;
    if (symbol && after.text == ":=") {
        const bool names_step = in_.is_word_at(2) || same_name(in_.token(2).text, "POWER_UP");
        if (notes_.is_register(in_.token().text) || !names_step ||
            nearest(in_.token().text, {"NEXT"}).empty())
            return;
        in_.report().add("E021", in_.token().span, fmt::format("there is no register '{}'", in_.token().text),
                         "did you mean 'NEXT'?");
        in_.replace("NEXT");
    } else if (symbol && after.text == ";") {
        in_.mend(end_words, "a statement");
    } else if (!symbol || after.text != "(") {
        std::vector<std::string_view> words = std::move(end_words);
        words.insert(words.end(), {"IF", "OUT", "ENTRY", "OWN", "EVERY_SCAN", "TERM", "NEXT", "NO_HELPER"});
        in_.mend(words, "a statement");
    }
}

/// CONST in a step. An unclosed step looks the same: then a STEP comes before END_STEP.
bool Parser::refuse_item_inside() {
    if (refuse_sequence_inside()) return true;
    const std::string_view word = in_.token().text;
    if (in_.token().kind != TokenKind::identifier ||
        std::none_of(kOutside.begin(), kOutside.end(),
                     [&](std::string_view w) { return same_name(w, word); }))
        return false;
    const auto is = [&](std::size_t ahead, std::string_view w) {
        return same_name(in_.token(ahead).text, w);
    };
    std::size_t ahead = 1;
    while (in_.token(ahead).kind != TokenKind::end && !is(ahead, "STEP") && !is(ahead, "POWER_UP") &&
           !is(ahead, "END_STEP") && !is(ahead, "END_POWER_UP"))
        ++ahead;
    if (!is(ahead, "END_STEP") && !is(ahead, "END_POWER_UP")) return false;
    in_.report().add("E010", in_.token().span, fmt::format("{} stands outside of steps", upper(word)),
                     "put it above the first STEP");
    notes_.miss_names();
    const bool is_block = upper(word).starts_with("VAR_");
    in_.skip();
    while (!in_.at("END_STEP") && !in_.at("END_POWER_UP") &&
           !(is_block ? in_.at("END_VAR") : in_.at_symbol(";")))
        in_.skip();
    if (is_block) in_.take("END_VAR");
    in_.take_symbol(";");
    return true;
}

/// SET V_SOLL := 100; SET POSITION 80 mm;
bool Parser::refuse_set_of_value(ast::Statement& statement) {
    const bool assigns = in_.is_symbol_at(1, ":=") || in_.is_symbol_at(1, "=");
    if (!assigns && in_.token(1).kind != TokenKind::number) return false;
    const std::string_view level = in_.token(2).text;
    const bool on = same_name(level, "TRUE") || same_name(level, "ON") || level == "1";
    const bool off = same_name(level, "FALSE") || same_name(level, "OFF") || level == "0";
    std::string help = "write SET Name; with the name of an output; the motor is moved with POSITION(P..)";
    if (assigns) help = fmt::format("a register is written without it: {} := value;", in_.token().text);
    if (assigns && (on || off)) help = fmt::format("write {} {};", on ? "SET" : "RESET", in_.token().text);
    in_.report().add("E010", statement.name.span,
                     fmt::format("{} switches outputs", upper(statement.name.text)), help);
    while (!in_.at_symbol(";") && !in_.at_boundary()) in_.skip();
    return true;
}

/// ENTRY IF Start THEN ..
bool Parser::refuse_entry_with_condition() {
    if (!in_.at("IF")) return false;
    in_.report().add(
        "E064", in_.token().span, "ENTRY has no conditions",
        "let the branch that leads to the step decide, and name another step where it does not hold");
    ast::Choice choice;
    parse_if(choice);
    return true;
}

/// OUT Ready IF Start; OUT Ready AND Alarm; OUT Ready(S);
bool Parser::refuse_out_tail() {
    const Token& last = in_.last();
    const bool same_line = !has_line_end(last.span.offset, in_.token().span.offset);
    std::size_t end = 1;
    while (in_.token(end).kind == TokenKind::identifier && !same_name(in_.token(end).text, "THEN")) ++end;
    if (is_one_of(in_.token(), {"IF"}) && same_line && in_.is_symbol_at(end, ";")) {
        in_.report().add("E010", in_.token().span, "an output follows a condition by WHEN",
                         "write OUT Name WHEN condition;");
        in_.replace("WHEN");
        return false;
    }
    if (is_one_of(in_.token(), {"AND", "OR"})) {
        in_.report().add("E010", in_.token().span, "names of outputs are separated by commas",
                         "write OUT Ready, Lamp;");
        return true;
    }
    if (!in_.at_symbol("(")) return false;
    const ForeignWord* word = foreign_word("SET");
    in_.report().add("E010", in_.token().span, "OUT takes no qualifier", std::string(word->help));
    return true;
}

/// STATE := 3;
bool Parser::refuse_state(const ast::Statement& statement) {
    if (notes_.is_register(statement.name.text) || !in_.at_symbol(":=") ||
        !same_name(statement.name.text, "STATE"))
        return false;
    in_.report().add("E010", statement.name.span,
                     fmt::format("there is no '{}' in this language", statement.name.text),
                     std::string(foreign_word("STATE")->help));
    return true;
}

/// IF TIMER2.Q THEN
bool Parser::mend_numbered_timer() {
    const std::string_view word = numbered_timer(in_.token().text);
    if (word.empty()) return false;
    in_.report().add(
        "E014", in_.token().span, fmt::format("there is one {}", word),
        fmt::format("write {}.Q, and preset it anew on the way to each step that needs it", word));
    in_.replace(word);
    return true;
}

/// IF AFTER 3 s THEN
bool Parser::refuse_time_as_condition(ast::Expression& result) {
    const Token first = in_.token();
    const bool is_word = in_.at("AFTER") || in_.at("DELAY") || in_.at("WAIT") || in_.at("ELAPSED");
    const std::size_t ahead = is_word ? 1 : 0;
    const bool is_time =
        in_.token(ahead).kind == TokenKind::time || (is_word && in_.token(ahead).kind == TokenKind::number);
    if (!is_time || in_property_) return false;
    in_.skip(ahead);
    ast::Value time;
    parse_value(time);
    in_.report().add(
        "E014", in_.span_since(first), "a time is no condition by itself",
        "write TIMER := T#3s; on the way to the step and IF TIMER.Q THEN in it; or IF condition FOR 3 s");
    result = {};
    return true;
}

/// 7 MOD 4: MOD is parsed as the unit of 7.
bool Parser::refuse_modulo(ast::Value& value) {
    const bool is_unit = same_name(value.unit.text, "MOD") || same_name(value.unit.text, "DIV");
    if (!is_unit || in_.at_symbol(";")) return false;
    in_.report().add("E045", value.unit.span, fmt::format("there is no {} here", upper(value.unit.text)),
                     "values are calculated with + - * / and parentheses");
    value.unit = {};
    ast::Value dropped;
    parse_factor(dropped);
    return true;
}

bool Parser::expect_time(ast::Value& time, std::string_view word) {
    if (!in_.at("THEN") && !in_.at_symbol(";")) return parse_value(time);
    in_.error_here("a time", fmt::format("write {} T#500ms", word));
    return false;
}

}  // namespace nplc::seqc
