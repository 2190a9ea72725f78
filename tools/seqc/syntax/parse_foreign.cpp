#include <fmt/format.h>

#include "syntax/foreign_words.h"
#include "syntax/names.h"
#include "syntax/parser.h"

/// What people write who know another language: one message says what to write here, and reading goes on
/// behind it.
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

bool Parser::is_symbol_at(std::size_t ahead, std::string_view symbol) const {
    return token(ahead).kind == TokenKind::symbol && token(ahead).text == symbol;
}

bool Parser::refuse_foreign_word() {
    if (token().kind != TokenKind::identifier || is_symbol_at(1, ":=")) return false;
    const ForeignWord* word = foreign_word(token().text);
    if (word == nullptr) return false;
    report_.add("E010", token().span, fmt::format("there is no {} in this language", shown(token())),
                std::string(word->help));
    if (word->end.empty()) return true;
    const auto closes = [&] { return at("END_STEP") || at("STEP") || at("POWER_UP") || at("END_PROGRAM"); };
    while (token().kind != TokenKind::end && !at(word->end) && !closes()) ++at_;
    take(word->end);
    return true;
}

bool Parser::refuse_foreign_item(ast::Program& program) {
    const Token first = token();
    if (!refuse_foreign_word()) return false;
    program.steps_missing = true;
    program.names_missing = true;
    if (same_name(first.text, "INITIAL_STEP")) {
        tokens_[at_].text = "STEP";
    } else if (token().text.data() == first.text.data()) {
        ++at_;
        recover_item();
    }
    return true;
}

void Parser::recover_item() {
    const auto inside = [&] {
        return at("IF") || at("ELSIF") || at("ELSE") || at("END_IF") || at("END_STEP") || at("END_VAR") ||
               at("END_POWER_UP");
    };
    while ((!at_boundary() || inside()) && !at("ON") && !at("TERM") && token().kind != TokenKind::end) ++at_;
}

bool Parser::at_comparison() const {
    return !in_property_ && (at_symbol("=") || at_symbol("<") || at_symbol(">"));
}

bool Parser::refuse_comparison(const Token& first, ast::Expression& result) {
    const std::string left(source_.substr(first.span.offset, span_since(first).length));
    const bool differs = at_symbol("<") && is_symbol_at(1, ">");
    while (at_comparison()) ++at_;
    if (!take_symbol("-")) take_symbol("+");
    const Token right = token();
    const bool literal =
        right.kind == TokenKind::number || right.kind == TokenKind::based || right.kind == TokenKind::time;
    if (literal || right.kind == TokenKind::direct || is_word_at(0) || is_one(right) || is_zero(right)) ++at_;
    if (literal && is_word_at(0)) {
        ast::Value unit;
        parse_unit(unit);
    }
    const bool truth = is_one(right) || is_zero(right);
    report_.add(
        "E014", span_since(first), "a condition compares nothing: it is true or false by itself",
        truth ? fmt::format("write {}{}", is_one(right) != differs ? "" : "NOT ", left) : std::string(kSeen));
    result = {};
    return true;
}

/// R_TRIG(Start), TON1.Q, Motor.INPOS
bool Parser::refuse_call_or_part() {
    if (token().kind != TokenKind::identifier || at("NOT")) return false;
    const Token first = token();
    const bool calls = is_symbol_at(1, "(") && is_word_at(0);
    const bool has_part = is_symbol_at(1, ".") && !at("TIMER") && !at("COUNTER");
    if (!calls && !has_part) return false;
    at_ += 2;
    if (calls) {
        for (int open = 1; open > 0 && !at_boundary() && !at("THEN"); ++at_)
            open += at_symbol("(") ? 1 : at_symbol(")") ? -1 : 0;
    } else if (token().kind == TokenKind::identifier) {
        ++at_;
    }
    const Token& last = tokens_[at_ - 1];
    const ForeignWord* word = foreign_word(first.text);
    const ForeignWord* timer = foreign_word("TON");
    std::string help(word != nullptr ? word->help : same_name(last.text, "Q") ? timer->help : kSeen);
    if (same_name(last.text, "INPOS") || same_name(last.text, "ERROR")) help = "write " + upper(last.text);
    report_.add("E014", span_since(first),
                calls ? fmt::format("a condition calls nothing: there is no function '{}'", first.text)
                      : fmt::format("'{}' has no parts", first.text),
                help);
    return true;
}

/// The step's name, its number and the colon; a name of several words is told once.
void Parser::parse_step_head(ast::Program& program, ast::Step& step) {
    const Token& name = tokens_[at_ - 1];
    if (is_word_at(0) || at_symbol("-")) {
        std::string joined(name.text);
        std::size_t ahead = 0;
        for (; is_word_at(ahead) || is_symbol_at(ahead, "-") || token(ahead).kind == TokenKind::number;
             ++ahead)
            joined.append(is_symbol_at(ahead, "-") ? "" : "_")
                .append(is_symbol_at(ahead, "-") ? "" : token(ahead).text);
        if (is_symbol_at(ahead, ":")) {
            const Token first = name;
            at_ += ahead;
            report_.add("E010", span_since(first), "a name is one word of letters, digits and _",
                        fmt::format("write STEP {}:, and the same where it is named", joined));
            program.steps_missing = true;
        }
    }
    if (take("AT")) {
        step.number.emplace();
        if (!parse_value(*step.number)) step.number.reset();
    }
    if (take_symbol(":")) return;
    const Token& last = tokens_[at_ - 1];
    if (in_open_comment() || end_was_reported()) return;
    report_.add("E010", {last.span.offset + last.span.length, 1},
                fmt::format("expected ':' after the step's name, found {}", shown(token())),
                fmt::format("write STEP {}:", step.name.text.empty() ? "Name" : step.name.text));
}

}  // namespace nplc::seqc
