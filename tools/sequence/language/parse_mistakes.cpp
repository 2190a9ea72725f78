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

/// CONST in a step. An unclosed step looks the same: then a STEP comes before END_STEP.
bool Parser::refuse_item_inside() {
    if (refuse_sequence_inside()) return true;
    const std::string_view word = token().text;
    if (token().kind != TokenKind::identifier ||
        std::none_of(kOutside.begin(), kOutside.end(),
                     [&](std::string_view w) { return same_name(w, word); }))
        return false;
    const auto is = [&](std::size_t ahead, std::string_view w) { return same_name(token(ahead).text, w); };
    std::size_t ahead = 1;
    while (token(ahead).kind != TokenKind::end && !is(ahead, "STEP") && !is(ahead, "POWER_UP") &&
           !is(ahead, "END_STEP") && !is(ahead, "END_POWER_UP"))
        ++ahead;
    if (!is(ahead, "END_STEP") && !is(ahead, "END_POWER_UP")) return false;
    report_.add("E010", token().span, fmt::format("{} stands outside of steps", upper(word)),
                "put it above the first STEP");
    names_missing_ = true;
    const bool is_block = upper(word).starts_with("VAR_");
    ++at_;
    while (!at("END_STEP") && !at("END_POWER_UP") && !(is_block ? at("END_VAR") : at_symbol(";"))) ++at_;
    if (is_block) take("END_VAR");
    take_symbol(";");
    return true;
}

/// SET V_SOLL := 100; SET POSITION 80 mm;
bool Parser::refuse_set_of_value(ast::Statement& statement) {
    const bool assigns = is_symbol_at(1, ":=") || is_symbol_at(1, "=");
    if (!assigns && token(1).kind != TokenKind::number) return false;
    const std::string_view level = token(2).text;
    const bool on = same_name(level, "TRUE") || same_name(level, "ON") || level == "1";
    const bool off = same_name(level, "FALSE") || same_name(level, "OFF") || level == "0";
    std::string help = "write SET Name; with the name of an output; the motor is moved with POSITION(P..)";
    if (assigns) help = fmt::format("a register is written without it: {} := value;", token().text);
    if (assigns && (on || off)) help = fmt::format("write {} {};", on ? "SET" : "RESET", token().text);
    report_.add("E010", statement.name.span, fmt::format("{} switches outputs", upper(statement.name.text)),
                help);
    while (!at_symbol(";") && !at_boundary()) ++at_;
    return true;
}

/// ENTRY IF Start THEN ..
bool Parser::refuse_entry_with_condition() {
    if (!at("IF")) return false;
    report_.add("E064", token().span, "ENTRY has no conditions",
                "let the branch that leads to the step decide, and name another step where it does not hold");
    ast::Choice choice;
    parse_if(choice);
    return true;
}

/// OUT Ready IF Start; OUT Ready AND Alarm; OUT Ready(S);
bool Parser::refuse_out_tail() {
    const Token& last = tokens_[at_ - 1];
    const bool same_line = !has_line_end(last.span.offset, token().span.offset);
    std::size_t end = 1;
    while (token(end).kind == TokenKind::identifier && !same_name(token(end).text, "THEN")) ++end;
    if (is_one_of(token(), {"IF"}) && same_line && is_symbol_at(end, ";")) {
        report_.add("E010", token().span, "an output follows a condition by WHEN",
                    "write OUT Name WHEN condition;");
        tokens_[at_].text = "WHEN";
        return false;
    }
    if (is_one_of(token(), {"AND", "OR"})) {
        report_.add("E010", token().span, "names of outputs are separated by commas",
                    "write OUT Ready, Lamp;");
        return true;
    }
    if (!at_symbol("(")) return false;
    const ForeignWord* word = foreign_word("SET");
    report_.add("E010", token().span, "OUT takes no qualifier", std::string(word->help));
    return true;
}

/// STATE := 3;
bool Parser::refuse_state(const ast::Statement& statement) {
    const bool is_declared = std::any_of(registers_.begin(), registers_.end(), [&](std::string_view name) {
        return same_name(name, statement.name.text);
    });
    if (is_declared || !at_symbol(":=") || !same_name(statement.name.text, "STATE")) return false;
    report_.add("E010", statement.name.span,
                fmt::format("there is no '{}' in this language", statement.name.text),
                std::string(foreign_word("STATE")->help));
    return true;
}

/// IF TIMER2.Q THEN
bool Parser::mend_numbered_timer() {
    const std::string_view word = numbered_timer(token().text);
    if (word.empty()) return false;
    report_.add("E014", token().span, fmt::format("there is one {}", word),
                fmt::format("write {}.Q, and preset it anew on the way to each step that needs it", word));
    tokens_[at_].text = word;
    return true;
}

/// IF AFTER 3 s THEN
bool Parser::refuse_time_as_condition(ast::Expression& result) {
    const Token first = token();
    const bool is_word = at("AFTER") || at("DELAY") || at("WAIT") || at("ELAPSED");
    const std::size_t ahead = is_word ? 1 : 0;
    const bool is_time =
        token(ahead).kind == TokenKind::time || (is_word && token(ahead).kind == TokenKind::number);
    if (!is_time || in_property_) return false;
    at_ += ahead;
    ast::Value time;
    parse_value(time);
    report_.add(
        "E014", span_since(first), "a time is no condition by itself",
        "write TIMER := T#3s; on the way to the step and IF TIMER.Q THEN in it; or IF condition FOR 3 s");
    result = {};
    return true;
}

/// 7 MOD 4: MOD is parsed as the unit of 7.
bool Parser::refuse_modulo(ast::Value& value) {
    const bool is_unit = same_name(value.unit.text, "MOD") || same_name(value.unit.text, "DIV");
    if (!is_unit || at_symbol(";")) return false;
    report_.add("E045", value.unit.span, fmt::format("there is no {} here", upper(value.unit.text)),
                "values are calculated with + - * / and parentheses");
    value.unit = {};
    ast::Value dropped;
    parse_factor(dropped);
    return true;
}

bool Parser::expect_time(ast::Value& time, std::string_view word) {
    if (!at("THEN") && !at_symbol(";")) return parse_value(time);
    error_here("a time", fmt::format("write {} T#500ms", word));
    return false;
}

}  // namespace nplc::seqc
