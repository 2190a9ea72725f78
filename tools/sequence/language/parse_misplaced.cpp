#include <fmt/format.h>

#include "language/names.h"
#include "language/parser.h"

/// Words of the language where another one belongs, and parts of a statement that it does not have.
namespace nplc::seqc {

/// IF (NOT Warm FOR 1 s) OR Rain THEN; IF FOR 200 ms Warm THEN
bool Parser::refuse_misplaced_time() {
    if (in_property_ || !is_one_of(token(), {"FOR", "WITHIN"})) return false;
    const Token first = token();
    ++at_;
    ast::Value time;
    if (token().kind == TokenKind::time || token().kind == TokenKind::number) parse_value(time);
    const std::string word = upper(first.text);
    report_.add(
        "E010", span_since(first), fmt::format("{} stands behind the whole condition, before THEN", word),
        fmt::format("write IF condition {} T#500ms THEN; what lasts beside other conditions goes into an "
                    "IF of its own step",
                    word));
    return true;
}

/// NEXT := Hold; WITHIN T#3s ELSE
bool Parser::refuse_time_as_statement() {
    if (!is_one_of(token(), {"WITHIN"})) return false;
    report_.add("E010", token().span, "WITHIN stands behind the condition, before THEN",
                "write IF condition WITHIN T#3s THEN NEXT := Step; ELSE NEXT := Fault; END_IF");
    return true;
}

/// SET Lamp WHEN Shut;
bool Parser::refuse_condition_of_set(const ast::Statement& statement) {
    if (!is_one_of(token(), {"WHEN", "IF"})) return false;
    const std::string word = upper(statement.name.text);
    report_.add("E010", token().span, fmt::format("{} has no condition of its own", word),
                fmt::format("write IF condition THEN {} Name; NEXT := Step; END_IF; an output that follows a "
                            "condition is OUT Name WHEN condition;",
                            word));
    return true;
}

/// OUT SET Lamp;
bool Parser::refuse_out_of_set() {
    if (!is_one_of(token(), {"SET", "RESET"}) || !is_word_at(1)) return false;
    const std::string word = upper(token().text);
    report_.add("E010", token().span, fmt::format("{} stands without OUT", word),
                fmt::format("write ENTRY {0} {1}; or {0} {1}; in a branch", word, token(1).text));
    return true;
}

/// OUT Lamp BLINK 1 s;
void Parser::mend_blinking() {
    if (!is_one_of(token(), {"BLINK", "BLINKS", "FLASH", "FLASHING"})) return;
    report_.add("E010", token().span, "an output that blinks has the word BLINKING",
                "write BLINKING T#500ms");
    tokens_[at_].text = "BLINKING";
}

/// OUT Lamp BLINKING 1 s WHEN Shut;
bool Parser::refuse_behind_blinking() {
    if (!is_one_of(token(), {"WHEN", "IF", "IN"})) return false;
    const bool is_group = is_one_of(token(), {"IN"});
    report_.add(
        "E010", token().span,
        is_group ? "an OUT for many steps cannot blink" : "an output that blinks follows no condition",
        is_group ? "write OUT Lamp BLINKING T#500ms; in each of the steps"
                 : "let it blink in a step of its own, which a branch with the condition leads to");
    return true;
}

/// OUT Lamp BLINKING 1 s IN Moving; outside of steps
bool Parser::refuse_blinking_group() {
    if (!is_one_of(token(), {"OUT"})) return false;
    std::size_t ahead = 1;
    while (token(ahead).kind != TokenKind::end && !is_symbol_at(ahead, ";") &&
           !same_name(token(ahead).text, "BLINKING"))
        ++ahead;
    if (!same_name(token(ahead).text, "BLINKING")) return false;
    const Span place = token(ahead).span;
    while (token(ahead).kind != TokenKind::end && !is_symbol_at(ahead, ";") &&
           !same_name(token(ahead).text, "IN"))
        ++ahead;
    if (!same_name(token(ahead).text, "IN")) return false;
    report_.add("E010", place, "an OUT for many steps cannot blink",
                "write OUT Lamp BLINKING T#500ms; in each of the steps");
    while (!at_symbol(";") && token().kind != TokenKind::end) ++at_;
    take_symbol(";");
    return true;
}

/// A SEQUENCE between STEP and END_STEP. Behind an unclosed step another STEP comes before END_STEP.
bool Parser::refuse_sequence_inside() {
    if (!is_one_of(token(), {"SEQUENCE"})) return false;
    std::size_t end = 1;
    while (token(end).kind != TokenKind::end && !same_name(token(end).text, "END_SEQUENCE")) ++end;
    if (token(end).kind == TokenKind::end) return false;
    std::size_t behind = end + 1;
    while (token(behind).kind != TokenKind::end && !same_name(token(behind).text, "STEP") &&
           !same_name(token(behind).text, "END_STEP"))
        ++behind;
    if (!same_name(token(behind).text, "END_STEP")) return false;
    report_.add("E010", token().span, "SEQUENCE stands outside of steps", "put it above the first STEP");
    names_missing_ = true;
    at_ += end + 1;
    take_symbol(";");
    return true;
}

/// CONST A := 1; B := 2; END_CONST
void Parser::mend_constant_block(ast::Program& program) {
    if (!is_word_at(0) || !is_symbol_at(1, ":=")) return;
    report_.add("E010", token().span, "each constant begins with CONST",
                fmt::format("write CONST {} := value;", token().text));
    while (is_word_at(0) && is_symbol_at(1, ":=")) {
        --at_;
        parse_one_constant(program);
    }
    if (same_name(token().text, "END_CONST")) ++at_;
    take_symbol(";");
}

/// CNTRL_BITS := HICLK OR INPSIGN;
bool Parser::refuse_or_of_bits() {
    if (!is_one_of(token(), {"OR"}) && !at_symbol("|")) return false;
    report_.add("E010", token().span, "bits of a register are joined with +", "write HICLK + INPSIGN");
    return true;
}

}  // namespace nplc::seqc
