#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "language/foreign_words.h"
#include "language/names.h"
#include "language/parser.h"

/// Constructs of other languages: one message with the correct form, then parsing continues behind the
/// construct.
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

/// END IF, END STEP: both words are read as one keyword.
void Parser::mend_split_words() {
    constexpr std::pair<std::string_view, std::string_view> kEnds[] = {{"IF", "END_IF"},
                                                                       {"STEP", "END_STEP"},
                                                                       {"VAR", "END_VAR"},
                                                                       {"PROGRAM", "END_PROGRAM"},
                                                                       {"POWER_UP", "END_POWER_UP"}};
    for (std::size_t i = 0; i + 1 < tokens_.size() && !report_.full(); ++i) {
        if (!is_one_of(tokens_[i], {"END"})) continue;
        for (const auto& [second, joined] : kEnds) {
            const Span end = tokens_[i + 1].span;
            if (!is_one_of(tokens_[i + 1], {second}) || has_line_end(tokens_[i].span.offset, end.offset))
                continue;
            tokens_[i].span.length = end.offset + end.length - tokens_[i].span.offset;
            tokens_[i].text = joined;
            tokens_.erase(tokens_.begin() + static_cast<std::ptrdiff_t>(i) + 1);
            report_.add("E010", tokens_[i].span, fmt::format("{} is one word", joined),
                        fmt::format("write {}", joined));
            break;
        }
    }
}

bool Parser::has_line_end(std::size_t from, std::size_t to) const {
    return source_.substr(from, to - from).find('\n') != std::string_view::npos;
}

/// ELSE Start THEN: parsed as ELSIF.
bool Parser::refuse_else_with_condition() {
    std::size_t ahead = 1;
    while (is_word_at(ahead) || is_one_of(token(ahead), {"NOT", "AND", "OR", "XOR", "INPOS", "ERROR"}))
        ++ahead;
    if (ahead == 1 || !is_one_of(token(ahead), {"THEN"})) return false;
    report_.add("E010", token().span, "ELSE takes no condition", "write ELSIF");
    return true;
}

/// ON Guard NOT IN Idle
bool Parser::refuse_not_in() {
    if (!at("NOT") || !is_one_of(token(1), {"IN"})) return false;
    const Token first = token();
    at_ += 2;
    report_.add("E010", span_since(first), "NOT IN is the word EXCEPT", "write EXCEPT");
    return true;
}

bool Parser::refuse_bracket_before_names() {
    if (!at_symbol("(")) return false;
    report_.add("E010", token().span, "names of steps stand without parentheses", "write IN Push, Return");
    ++at_;
    return true;
}

/// ON Guard IN Push; Hold NEXT := Fault;
bool Parser::refuse_semicolon_between_names() {
    if (!at_symbol(";") || !is_word_at(1) ||
        !(is_one_of(token(2), {"NEXT"}) || is_symbol_at(2, ";") || is_symbol_at(2, ",")))
        return false;
    report_.add("E010", token().span, "names of steps are separated by commas", "write a comma");
    ++at_;
    return true;
}

/// Text between a condition of ON and NEXT; false if parsing cannot continue.
bool Parser::refuse_before_next() {
    if (at("NEXT") || token().kind == TokenKind::end) return true;
    const Token first = token();
    std::size_t ahead = 0;
    while (token(ahead).kind != TokenKind::end && !is_symbol_at(ahead, ";")) ++ahead;
    if (is_symbol_at(ahead, ";")) ++ahead;  // ON Guard STOP; NEXT := Fault;
    if (is_one_of(first, {"THEN"})) {
        report_.add("E010", first.span, "there is no THEN behind ON", "write ON condition NEXT := Step;");
        ++at_;
        return true;
    }
    const ForeignWord* word = foreign_word(first.text);
    const bool has_next = is_one_of(token(ahead), {"NEXT"});
    if (word != nullptr && !has_next) {
        report_.add("E010", first.span, fmt::format("there is no {} in this language", shown(first)),
                    std::string(word->help));
        return false;
    }
    if (!is_word_at(0) || !has_next) return true;
    at_ += ahead;
    report_.add("E010", first.span, "ON leads to a step and does nothing else",
                "write ON condition NEXT := Step; and what is to be done as ENTRY of that step");
    return true;
}

/// POSITION Press;
bool Parser::refuse_bare_arguments(const ast::Statement& statement) {
    if (!is_one_of(tokens_[at_ - 1], {"POSITION", "VELOCITY", "INIT", "USE_SET"})) return false;
    if (!is_word_at(0) && token().kind != TokenKind::number) return false;
    const Token first = token();
    while (is_word_at(0) || token().kind == TokenKind::number || at_symbol(",")) ++at_;
    const Span place = span_since(first);
    report_.add(
        "E050", place, fmt::format("{} has its registers in parentheses", upper(statement.name.text)),
        fmt::format("write {}({})", upper(statement.name.text), source_.substr(place.offset, place.length)));
    return true;
}

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
    if (refuse_blinking_group()) return true;
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
    return !in_property_ && (at_symbol("=") || at_symbol(":=") || at_symbol("<") || at_symbol(">"));
}

bool Parser::refuse_comparison(const Token& first, ast::Expression& result, bool is_told) {
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
    result = {};
    if (is_told) return true;
    report_.add(
        "E014", span_since(first), "a condition compares nothing: it is true or false by itself",
        truth ? fmt::format("write {}{}", is_one(right) != differs ? "" : "NOT ", left) : std::string(kSeen));
    return true;
}

/// R_TRIG(Start), TON1.Q, Motor.INPOS
bool Parser::refuse_call_or_part() {
    if (token().kind != TokenKind::identifier || at("NOT")) return false;
    const Token first = token();
    const bool calls = !before_condition_ && is_symbol_at(1, "(") && is_word_at(0);
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
    if (same_name(last.text, "X") || same_name(last.text, "T"))
        help =
            "a step is the active one while its branches are judged; how long it may take says IF condition "
            "WITHIN T#3s, or TIMER := T#3s; on the way to it and TIMER.Q";
    if (same_name(last.text, "INPOS") || same_name(last.text, "ERROR")) help = "write " + upper(last.text);
    const bool is_edge = same_name(first.text, "R_TRIG") || same_name(first.text, "F_TRIG");
    if (in_property_ && calls && is_edge) {
        const bool rises = same_name(first.text, "R_TRIG");
        report_.add("E014", span_since(first), "a property looks at one scan after another, and has no edges",
                    rises ? "write NOT Start FOLLOWED BY Start" : "write Start FOLLOWED BY NOT Start");
        return true;
    }
    report_.add("E014", span_since(first),
                calls ? fmt::format("a condition calls nothing: there is no function '{}'", first.text)
                      : fmt::format("'{}' has no parts", first.text),
                help);
    return true;
}

/// The step's name, its number and the colon; a name of several words is reported once.
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
        if (!parse_literal(*step.number)) step.number.reset();
    }
    if (take_symbol(":")) return;
    const Token& last = tokens_[at_ - 1];
    if (in_open_comment() || end_was_reported()) return;
    report_.add("E010", {last.span.offset + last.span.length, 1},
                fmt::format("expected ':' after the step's name, found {}", shown(token())),
                fmt::format("write STEP {}:", step.name.text.empty() ? "Name" : step.name.text));
}

}  // namespace nplc::seqc
