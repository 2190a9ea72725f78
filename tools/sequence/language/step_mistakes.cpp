#include "language/step_mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "language/foreign_words.h"
#include "language/names.h"
#include "language/statement_mistakes.h"

namespace nplc::seqc {
namespace {

constexpr auto kOutside = std::to_array<std::string_view>(
    {"INCLUDE", "CONST", "SCALE", "MOTOR", "GROUP", "SET_POINT", "VAR_INPUT", "VAR_OUTPUT", "VAR_MOTOR"});

/// A SEQUENCE between STEP and END_STEP. Behind an unclosed step another STEP comes before END_STEP.
bool refuse_sequence_inside(TokenStream& in, Notes& notes) {
    if (!is_one_of(in.token(), {"SEQUENCE"})) return false;
    std::size_t end = 1;
    while (in.token(end).kind != TokenKind::end && !same_name(in.token(end).text, "END_SEQUENCE")) ++end;
    if (in.token(end).kind == TokenKind::end) return false;
    std::size_t behind = end + 1;
    while (in.token(behind).kind != TokenKind::end && !same_name(in.token(behind).text, "STEP") &&
           !same_name(in.token(behind).text, "END_STEP"))
        ++behind;
    if (!same_name(in.token(behind).text, "END_STEP")) return false;
    in.report().add("E010", in.token().span, "SEQUENCE stands outside of steps",
                    "put it above the first STEP");
    notes.miss_names();
    in.skip(end + 1);
    in.take_symbol(";");
    return true;
}

}  // namespace

bool refuse_item_inside(TokenStream& in, Notes& notes) {
    if (refuse_sequence_inside(in, notes)) return true;
    const std::string_view word = in.token().text;
    if (in.token().kind != TokenKind::identifier ||
        std::none_of(kOutside.begin(), kOutside.end(),
                     [&](std::string_view w) { return same_name(w, word); }))
        return false;
    const auto is = [&](std::size_t ahead, std::string_view w) { return same_name(in.token(ahead).text, w); };
    std::size_t ahead = 1;
    while (in.token(ahead).kind != TokenKind::end && !is(ahead, "STEP") && !is(ahead, "POWER_UP") &&
           !is(ahead, "END_STEP") && !is(ahead, "END_POWER_UP"))
        ++ahead;
    if (!is(ahead, "END_STEP") && !is(ahead, "END_POWER_UP")) return false;
    in.report().add("E010", in.token().span, fmt::format("{} stands outside of steps", upper(word)),
                    "put it above the first STEP");
    notes.miss_names();
    const bool is_block = upper(word).starts_with("VAR_");
    in.skip();
    while (!in.at("END_STEP") && !in.at("END_POWER_UP") && !(is_block ? in.at("END_VAR") : in.at_symbol(";")))
        in.skip();
    if (is_block) in.take("END_VAR");
    in.take_symbol(";");
    return true;
}

bool take_digits_first(TokenStream& in, ast::Name& name) {
    const Token digits = in.token();
    const Token& letters = in.token(1);
    if (digits.kind != TokenKind::number || letters.kind != TokenKind::identifier ||
        letters.span.offset != digits.span.offset + digits.span.length)
        return false;
    in.skip(2);
    const Span span = in.span_since(digits);
    name = {in.text_of(span), span};
    return true;
}

bool refuse_out_of_set(TokenStream& in) {
    if (!is_one_of(in.token(), {"SET", "RESET"}) || !in.is_word_at(1)) return false;
    const std::string word = upper(in.token().text);
    in.report().add("E010", in.token().span, fmt::format("{} stands without OUT", word),
                    fmt::format("write ENTRY {0} {1}; or {0} {1}; in a branch", word, in.token(1).text));
    return true;
}

bool refuse_out_tail(TokenStream& in) {
    const Token& last = in.last();
    const bool same_line = !has_line_end(in, last.span.offset, in.token().span.offset);
    std::size_t end = 1;
    while (in.token(end).kind == TokenKind::identifier && !same_name(in.token(end).text, "THEN")) ++end;
    if (is_one_of(in.token(), {"IF"}) && same_line && in.is_symbol_at(end, ";")) {
        in.report().add("E010", in.token().span, "an output follows a condition by WHEN",
                        "write OUT Name WHEN condition;");
        in.replace("WHEN");
        return false;
    }
    if (is_one_of(in.token(), {"FOR", "AFTER", "DELAY", "WITHIN"})) {
        in.report().add(
            "E010", in.token().span, "OUT has no time: it holds while the step is active",
            "leave the step when the time is over: TIMER := T#3s; on the way to it, and IF TIMER.Q "
            "THEN NEXT := Step; END_IF in it");
        return true;
    }
    const bool names_another = same_line && in.is_word_at(0) && in.declared().has_output(in.token().text);
    if (is_one_of(in.token(), {"AND", "OR"}) || names_another) {
        in.report().add("E010", in.token().span, "names of outputs are separated by commas",
                        "write OUT Ready, Lamp;");
        return true;
    }
    if (!in.at_symbol("(")) return false;
    const ForeignWord* word = foreign_word("SET");
    in.report().add("E010", in.token().span, "OUT takes no qualifier", std::string(word->help));
    return true;
}

void mend_blinking(TokenStream& in) {
    if (!is_one_of(in.token(), {"BLINK", "BLINKS", "FLASH", "FLASHING"})) return;
    in.report().add("E010", in.token().span, "an output that blinks has the word BLINKING",
                    "write BLINKING T#500ms");
    in.replace("BLINKING");
}

bool refuse_behind_blinking(TokenStream& in) {
    if (!is_one_of(in.token(), {"WHEN", "IF", "IN"})) return false;
    const bool is_group = is_one_of(in.token(), {"IN"});
    in.report().add(
        "E010", in.token().span,
        is_group ? "an OUT for many steps cannot blink" : "an output that blinks follows no condition",
        is_group ? "write OUT Lamp BLINKING T#500ms; in each of the steps"
                 : "let it blink in a step of its own, which a branch with the condition leads to");
    return true;
}

}  // namespace nplc::seqc
