#include <fmt/format.h>

#include "language/names.h"
#include "language/parser.h"

/// Words of the language where another one belongs, and parts of a statement that it does not have.
namespace nplc::seqc {

/// IF (NOT Warm FOR 1 s) OR Rain THEN; IF FOR 200 ms Warm THEN
bool Parser::refuse_misplaced_time() {
    if (in_property_ || !is_one_of(in_.token(), {"FOR", "WITHIN"})) return false;
    const Token first = in_.token();
    in_.skip();
    ast::Value time;
    if (in_.token().kind == TokenKind::time || in_.token().kind == TokenKind::number) parse_value(time);
    const std::string word = upper(first.text);
    in_.report().add(
        "E010", in_.span_since(first), fmt::format("{} stands behind the whole condition, before THEN", word),
        fmt::format("write IF condition {} T#500ms THEN; what lasts beside other conditions goes into an "
                    "IF of its own step",
                    word));
    return true;
}

/// NEXT := Hold; WITHIN T#3s ELSE
bool Parser::refuse_time_as_statement() {
    if (!is_one_of(in_.token(), {"WITHIN"})) return false;
    in_.report().add("E010", in_.token().span, "WITHIN stands behind the condition, before THEN",
                     "write IF condition WITHIN T#3s THEN NEXT := Step; ELSE NEXT := Fault; END_IF");
    return true;
}

/// SET Lamp WHEN Shut;
bool Parser::refuse_condition_of_set(const ast::Statement& statement) {
    if (!is_one_of(in_.token(), {"WHEN", "IF"})) return false;
    const std::string word = upper(statement.name.text);
    in_.report().add(
        "E010", in_.token().span, fmt::format("{} has no condition of its own", word),
        fmt::format("write IF condition THEN {} Name; NEXT := Step; END_IF; an output that follows a "
                    "condition is OUT Name WHEN condition;",
                    word));
    return true;
}

/// OUT SET Lamp;
bool Parser::refuse_out_of_set() {
    if (!is_one_of(in_.token(), {"SET", "RESET"}) || !in_.is_word_at(1)) return false;
    const std::string word = upper(in_.token().text);
    in_.report().add("E010", in_.token().span, fmt::format("{} stands without OUT", word),
                     fmt::format("write ENTRY {0} {1}; or {0} {1}; in a branch", word, in_.token(1).text));
    return true;
}

/// OUT Lamp BLINK 1 s;
void Parser::mend_blinking() {
    if (!is_one_of(in_.token(), {"BLINK", "BLINKS", "FLASH", "FLASHING"})) return;
    in_.report().add("E010", in_.token().span, "an output that blinks has the word BLINKING",
                     "write BLINKING T#500ms");
    in_.replace("BLINKING");
}

/// OUT Lamp BLINKING 1 s WHEN Shut;
bool Parser::refuse_behind_blinking() {
    if (!is_one_of(in_.token(), {"WHEN", "IF", "IN"})) return false;
    const bool is_group = is_one_of(in_.token(), {"IN"});
    in_.report().add(
        "E010", in_.token().span,
        is_group ? "an OUT for many steps cannot blink" : "an output that blinks follows no condition",
        is_group ? "write OUT Lamp BLINKING T#500ms; in each of the steps"
                 : "let it blink in a step of its own, which a branch with the condition leads to");
    return true;
}

/// OUT Lamp BLINKING 1 s IN Moving; outside of steps
bool Parser::refuse_blinking_group() {
    if (!is_one_of(in_.token(), {"OUT"})) return false;
    std::size_t ahead = 1;
    while (in_.token(ahead).kind != TokenKind::end && !in_.is_symbol_at(ahead, ";") &&
           !same_name(in_.token(ahead).text, "BLINKING"))
        ++ahead;
    if (!same_name(in_.token(ahead).text, "BLINKING")) return false;
    const Span place = in_.token(ahead).span;
    while (in_.token(ahead).kind != TokenKind::end && !in_.is_symbol_at(ahead, ";") &&
           !same_name(in_.token(ahead).text, "IN"))
        ++ahead;
    if (!same_name(in_.token(ahead).text, "IN")) return false;
    in_.report().add("E010", place, "an OUT for many steps cannot blink",
                     "write OUT Lamp BLINKING T#500ms; in each of the steps");
    while (!in_.at_symbol(";") && !in_.at_end()) in_.skip();
    in_.take_symbol(";");
    return true;
}

/// A SEQUENCE between STEP and END_STEP. Behind an unclosed step another STEP comes before END_STEP.
bool Parser::refuse_sequence_inside() {
    if (!is_one_of(in_.token(), {"SEQUENCE"})) return false;
    std::size_t end = 1;
    while (in_.token(end).kind != TokenKind::end && !same_name(in_.token(end).text, "END_SEQUENCE")) ++end;
    if (in_.token(end).kind == TokenKind::end) return false;
    std::size_t behind = end + 1;
    while (in_.token(behind).kind != TokenKind::end && !same_name(in_.token(behind).text, "STEP") &&
           !same_name(in_.token(behind).text, "END_STEP"))
        ++behind;
    if (!same_name(in_.token(behind).text, "END_STEP")) return false;
    in_.report().add("E010", in_.token().span, "SEQUENCE stands outside of steps",
                     "put it above the first STEP");
    notes_.miss_names();
    in_.skip(end + 1);
    in_.take_symbol(";");
    return true;
}

/// CONST A := 1; B := 2; END_CONST
void Parser::mend_constant_block(ast::Program& program) {
    if (!in_.is_word_at(0) || !in_.is_symbol_at(1, ":=")) return;
    in_.report().add("E010", in_.token().span, "each constant begins with CONST",
                     fmt::format("write CONST {} := value;", in_.token().text));
    while (in_.is_word_at(0) && in_.is_symbol_at(1, ":=")) {
        parse_one_constant(program);
    }
    if (same_name(in_.token().text, "END_CONST")) in_.skip();
    in_.take_symbol(";");
}

/// CNTRL_BITS := HICLK OR INPSIGN;
bool Parser::refuse_or_of_bits() {
    if (!is_one_of(in_.token(), {"OR"}) && !in_.at_symbol("|")) return false;
    in_.report().add("E010", in_.token().span, "bits of a register are joined with +",
                     "write HICLK + INPSIGN");
    return true;
}

}  // namespace nplc::seqc
