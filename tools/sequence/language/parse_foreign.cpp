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
    const std::vector<Token>& tokens = in_.tokens();
    for (std::size_t i = 0; i + 1 < tokens.size() && !in_.report().full(); ++i) {
        if (!is_one_of(tokens[i], {"END"})) continue;
        for (const auto& [second, joined] : kEnds) {
            if (!is_one_of(tokens[i + 1], {second}) ||
                has_line_end(tokens[i].span.offset, tokens[i + 1].span.offset))
                continue;
            in_.join(i, joined);
            in_.report().add("E010", tokens[i].span, fmt::format("{} is one word", joined),
                             fmt::format("write {}", joined));
            break;
        }
    }
}

bool Parser::has_line_end(std::size_t from, std::size_t to) const {
    return in_.source().substr(from, to - from).find('\n') != std::string_view::npos;
}

/// ELSE Start THEN: parsed as ELSIF.
bool Parser::refuse_else_with_condition() {
    std::size_t ahead = 1;
    while (in_.is_word_at(ahead) ||
           is_one_of(in_.token(ahead), {"NOT", "AND", "OR", "XOR", "INPOS", "ERROR"}))
        ++ahead;
    if (ahead == 1 || !is_one_of(in_.token(ahead), {"THEN"})) return false;
    in_.report().add("E010", in_.token().span, "ELSE takes no condition", "write ELSIF");
    return true;
}

/// ON Guard NOT IN Idle
bool Parser::refuse_not_in() {
    if (!in_.at("NOT") || !is_one_of(in_.token(1), {"IN"})) return false;
    const Token first = in_.token();
    in_.skip(2);
    in_.report().add("E010", in_.span_since(first), "NOT IN is the word EXCEPT", "write EXCEPT");
    return true;
}

bool Parser::refuse_bracket_before_names() {
    if (!in_.at_symbol("(")) return false;
    in_.report().add("E010", in_.token().span, "names of steps stand without parentheses",
                     "write IN Push, Return");
    in_.skip();
    return true;
}

/// ON Guard IN Push; Hold NEXT := Fault;
bool Parser::refuse_semicolon_between_names() {
    if (!in_.at_symbol(";") || !in_.is_word_at(1) ||
        !(is_one_of(in_.token(2), {"NEXT"}) || in_.is_symbol_at(2, ";") || in_.is_symbol_at(2, ",")))
        return false;
    in_.report().add("E010", in_.token().span, "names of steps are separated by commas", "write a comma");
    in_.skip();
    return true;
}

/// Text between a condition of ON and NEXT; false if parsing cannot continue.
bool Parser::refuse_before_next() {
    if (in_.at("NEXT") || in_.at_end()) return true;
    const Token first = in_.token();
    std::size_t ahead = 0;
    while (in_.token(ahead).kind != TokenKind::end && !in_.is_symbol_at(ahead, ";")) ++ahead;
    if (in_.is_symbol_at(ahead, ";")) ++ahead;  // ON Guard STOP; NEXT := Fault;
    if (is_one_of(first, {"THEN"})) {
        in_.report().add("E010", first.span, "there is no THEN behind ON",
                         "write ON condition NEXT := Step;");
        in_.skip();
        return true;
    }
    const ForeignWord* word = foreign_word(first.text);
    const bool has_next = is_one_of(in_.token(ahead), {"NEXT"});
    if (word != nullptr && !has_next) {
        in_.report().add("E010", first.span, fmt::format("there is no {} in this language", shown(first)),
                         std::string(word->help));
        return false;
    }
    if (!in_.is_word_at(0) || !has_next) return true;
    in_.skip(ahead);
    in_.report().add("E010", first.span, "ON leads to a step and does nothing else",
                     "write ON condition NEXT := Step; and what is to be done as ENTRY of that step");
    return true;
}

/// POSITION Press;
bool Parser::refuse_bare_arguments(const ast::Statement& statement) {
    if (!is_one_of(in_.last(), {"POSITION", "VELOCITY", "INIT", "USE_SET"})) return false;
    if (!in_.is_word_at(0) && in_.token().kind != TokenKind::number) return false;
    const Token first = in_.token();
    while (in_.is_word_at(0) || in_.token().kind == TokenKind::number || in_.at_symbol(",")) in_.skip();
    const Span place = in_.span_since(first);
    in_.report().add("E050", place,
                     fmt::format("{} has its registers in parentheses", upper(statement.name.text)),
                     fmt::format("write {}({})", upper(statement.name.text),
                                 in_.source().substr(place.offset, place.length)));
    return true;
}

bool Parser::refuse_foreign_word() {
    if (in_.token().kind != TokenKind::identifier || in_.is_symbol_at(1, ":=")) return false;
    const ForeignWord* word = foreign_word(in_.token().text);
    if (word == nullptr) return false;
    in_.report().add("E010", in_.token().span,
                     fmt::format("there is no {} in this language", shown(in_.token())),
                     std::string(word->help));
    if (word->end.empty()) return true;
    const auto closes = [&] {
        return in_.at("END_STEP") || in_.at("STEP") || in_.at("POWER_UP") || in_.at("END_PROGRAM");
    };
    while (!in_.at_end() && !in_.at(word->end) && !closes()) in_.skip();
    in_.take(word->end);
    return true;
}

bool Parser::refuse_foreign_item(ast::Program& program) {
    const Token first = in_.token();
    if (refuse_blinking_group()) return true;
    if (!refuse_foreign_word()) return false;
    program.steps_missing = true;
    program.names_missing = true;
    if (same_name(first.text, "INITIAL_STEP")) {
        in_.replace("STEP");
    } else if (in_.token().text.data() == first.text.data()) {
        in_.skip();
        recover_item();
    }
    return true;
}

void Parser::recover_item() {
    const auto inside = [&] {
        return in_.at("IF") || in_.at("ELSIF") || in_.at("ELSE") || in_.at("END_IF") || in_.at("END_STEP") ||
               in_.at("END_VAR") || in_.at("END_POWER_UP");
    };
    while ((!in_.at_boundary() || inside()) && !in_.at("ON") && !in_.at("TERM") && !in_.at_end()) in_.skip();
}

bool Parser::at_comparison() const {
    return !in_property_ &&
           (in_.at_symbol("=") || in_.at_symbol(":=") || in_.at_symbol("<") || in_.at_symbol(">"));
}

bool Parser::refuse_comparison(const Token& first, ast::Expression& result, bool is_told) {
    const std::string left(in_.source().substr(first.span.offset, in_.span_since(first).length));
    const bool differs = in_.at_symbol("<") && in_.is_symbol_at(1, ">");
    while (at_comparison()) in_.skip();
    if (!in_.take_symbol("-")) in_.take_symbol("+");
    const Token right = in_.token();
    const bool literal =
        right.kind == TokenKind::number || right.kind == TokenKind::based || right.kind == TokenKind::time;
    if (literal || right.kind == TokenKind::direct || in_.is_word_at(0) || is_one(right) || is_zero(right))
        in_.skip();
    if (literal && in_.is_word_at(0)) {
        ast::Value unit;
        parse_unit(unit);
    }
    const bool truth = is_one(right) || is_zero(right);
    result = {};
    if (is_told) return true;
    in_.report().add(
        "E014", in_.span_since(first), "a condition compares nothing: it is true or false by itself",
        truth ? fmt::format("write {}{}", is_one(right) != differs ? "" : "NOT ", left) : std::string(kSeen));
    return true;
}

/// R_TRIG(Start), TON1.Q, Motor.INPOS
bool Parser::refuse_call_or_part() {
    if (in_.token().kind != TokenKind::identifier || in_.at("NOT")) return false;
    const Token first = in_.token();
    const bool calls = !before_condition_ && in_.is_symbol_at(1, "(") && in_.is_word_at(0);
    const bool has_part = in_.is_symbol_at(1, ".") && !in_.at("TIMER") && !in_.at("COUNTER");
    if (!calls && !has_part) return false;
    in_.skip(2);
    if (calls) {
        for (int open = 1; open > 0 && !in_.at_boundary() && !in_.at("THEN"); in_.skip())
            open += in_.at_symbol("(") ? 1 : in_.at_symbol(")") ? -1 : 0;
    } else if (in_.token().kind == TokenKind::identifier) {
        in_.skip();
    }
    const Token& last = in_.last();
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
        in_.report().add("E014", in_.span_since(first),
                         "a property looks at one scan after another, and has no edges",
                         rises ? "write NOT Start FOLLOWED BY Start" : "write Start FOLLOWED BY NOT Start");
        return true;
    }
    in_.report().add("E014", in_.span_since(first),
                     calls ? fmt::format("a condition calls nothing: there is no function '{}'", first.text)
                           : fmt::format("'{}' has no parts", first.text),
                     help);
    return true;
}

/// The step's name, its number and the colon; a name of several words is reported once.
void Parser::parse_step_head(ast::Program& program, ast::Step& step) {
    const Token& name = in_.last();
    if (in_.is_word_at(0) || in_.at_symbol("-")) {
        std::string joined(name.text);
        std::size_t ahead = 0;
        for (; in_.is_word_at(ahead) || in_.is_symbol_at(ahead, "-") ||
               in_.token(ahead).kind == TokenKind::number;
             ++ahead)
            joined.append(in_.is_symbol_at(ahead, "-") ? "" : "_")
                .append(in_.is_symbol_at(ahead, "-") ? "" : in_.token(ahead).text);
        if (in_.is_symbol_at(ahead, ":")) {
            const Token first = name;
            in_.skip(ahead);
            in_.report().add("E010", in_.span_since(first), "a name is one word of letters, digits and _",
                             fmt::format("write STEP {}:, and the same where it is named", joined));
            program.steps_missing = true;
        }
    }
    if (in_.take("AT")) {
        step.number.emplace();
        if (!parse_literal(*step.number)) step.number.reset();
    }
    if (in_.take_symbol(":")) return;
    const Token& last = in_.last();
    if (in_.in_open_comment() || in_.end_was_reported()) return;
    in_.report().add("E010", {last.span.offset + last.span.length, 1},
                     fmt::format("expected ':' after the step's name, found {}", shown(in_.token())),
                     fmt::format("write STEP {}:", step.name.text.empty() ? "Name" : step.name.text));
}

}  // namespace nplc::seqc
