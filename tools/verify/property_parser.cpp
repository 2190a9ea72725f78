#include "property_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <span>

#include "spelling/edit_distance.h"

namespace nplc::verify {
namespace {

using Kind = Condition::Kind;

struct Operator {
    std::string_view word;
    Kind kind;
};

/// Lowest precedence first, as in programs.
constexpr std::array kOperators = {
    Operator{"OR", Kind::any_of},
    Operator{"XOR", Kind::odd_of},
    Operator{"AND", Kind::all_of},
};

char upper_case(char c) {
    return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
}

bool same_word(std::string_view a, std::string_view b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](char x, char y) { return upper_case(x) == upper_case(y); });
}

bool is_word_character(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// The number behind `prefix`, one digit below `count`.
std::optional<std::uint8_t> numbered(std::string_view text, std::string_view prefix, int count) {
    if (text.size() != prefix.size() + 1 || !same_word(text.substr(0, prefix.size()), prefix))
        return std::nullopt;
    const int number = text.back() - '0';
    if (number < 0 || number >= count) return std::nullopt;
    return static_cast<std::uint8_t>(number);
}

template <std::size_t N>
std::optional<std::uint8_t> named(std::string_view text, const std::array<std::string, N>& names) {
    for (std::size_t i = 0; i < N; ++i) {
        if (!names[i].empty() && same_word(names[i], text)) return static_cast<std::uint8_t>(i);
    }
    return std::nullopt;
}

Condition leaf(Kind kind, std::uint8_t number = 0) {
    return {.kind = kind, .number = number, .operands = {}};
}

bool is_of_image(const Condition& condition) {
    const bool is_image =
        condition.kind == Kind::image || condition.kind == Kind::constant || condition.kind >= Kind::negation;
    return is_image && std::all_of(condition.operands.begin(), condition.operands.end(), is_of_image);
}

struct Unit {
    std::string_view word;
    double milliseconds;
};
constexpr std::array kUnits = {Unit{"ms", 1}, Unit{"s", 1'000}, Unit{"min", 60'000}};
/// Behind T#.
constexpr std::array kTimeUnits = {Unit{"ms", 1}, Unit{"s", 1'000}, Unit{"m", 60'000}, Unit{"h", 3'600'000},
                                   Unit{"d", 86'400'000}};

/// How long T# or TIME# is at the beginning of a text; 0: it does not begin so.
std::size_t time_prefix(std::string_view text) {
    for (const std::string_view prefix : {std::string_view("T#"), std::string_view("TIME#")}) {
        if (text.size() > prefix.size() && same_word(text.substr(0, prefix.size()), prefix))
            return prefix.size();
    }
    return 0;
}

}  // namespace

PropertyParser::PropertyParser(std::string_view text, const Names& names) : names_(names) {
    split(text);
}

void PropertyParser::split(std::string_view text) {
    std::size_t line = 1;
    std::size_t at = 0;
    std::size_t line_begins = 0;
    const auto column = [&](std::size_t place) {
        const std::string_view before = text.substr(line_begins, place - line_begins);
        return 1 + static_cast<std::size_t>(std::count_if(before.begin(), before.end(), [](char c) {
                   return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
               }));
    };
    const auto add = [&](Token::Kind kind, std::size_t from, std::size_t end) {
        tokens_.push_back({kind, text.substr(from, end - from), line, column(from)});
    };
    const auto run = [&](std::size_t from, auto belongs) {
        std::size_t end = from;
        while (end < text.size() && belongs(text[end])) ++end;
        return end;
    };
    while (at < text.size()) {
        const char c = text[at];
        const std::string_view rest = text.substr(at);
        std::size_t end = at + 1;
        if (c == '\n') {
            ++line;
            line_begins = at + 1;
        } else if (std::isspace(static_cast<unsigned char>(c)) != 0 || rest.starts_with("\xEF\xBB\xBF")) {
            end = c == '\xEF' ? at + 3 : end;
        } else if (rest.starts_with("//")) {
            end = run(at, [](char x) { return x != '\n'; });
        } else if (rest.starts_with("(*") || rest.starts_with("/*")) {
            const std::size_t close = text.find(rest[0] == '(' ? "*)" : "*/", at + 2);
            end = close == std::string_view::npos ? text.size() : close + 2;
            for (std::size_t i = at; i < end; ++i) {
                if (text[i] != '\n') continue;
                ++line;
                line_begins = i + 1;
            }
        } else if (c == '%') {
            end = run(at + 1, [](char x) { return is_word_character(x) || x == '.'; });
            add(Token::Kind::direct, at, end);
        } else if (const std::size_t prefix = time_prefix(rest); prefix != 0) {
            end = run(at + prefix, [](char x) { return is_word_character(x) || x == '.'; });
            add(Token::Kind::number, at, end);
        } else if (std::isdigit(static_cast<unsigned char>(c)) != 0) {
            end = run(at, [](char x) {
                return std::isdigit(static_cast<unsigned char>(x)) != 0 || x == '.' || x == '_';
            });
            add(Token::Kind::number, at, end);
        } else if (is_word_character(c)) {
            end = run(at, is_word_character);
            add(Token::Kind::word, at, end);
        } else {
            add(Token::Kind::symbol, at, end);
        }
        at = end;
    }
    add(Token::Kind::end, text.size(), text.size());
}

const PropertyParser::Token& PropertyParser::token(std::size_t ahead) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
}

bool PropertyParser::at(std::string_view word, std::size_t ahead) const {
    const Token& t = token(ahead);
    return (t.kind == Token::Kind::word || t.kind == Token::Kind::symbol) && same_word(t.text, word);
}

bool PropertyParser::take(std::string_view word) {
    if (!at(word)) return false;
    ++at_;
    return true;
}

bool PropertyParser::expect(std::string_view word, std::string_view where) {
    return take(word) || fail(fmt::format("'{}' is expected {}, not {}", word, where, shown()));
}

bool PropertyParser::fail(std::string message) {
    if (reading_.error.empty()) {
        reading_.error = std::move(message);
        reading_.line = token().line;
        reading_.column = token().column;
    }
    return false;
}

std::string PropertyParser::shown() const {
    return token().kind == Token::Kind::end ? "the end of the text"
                                            : fmt::format("'{}'", token().text.substr(0, 40));
}

/// A guess of the intended word, or `otherwise`.
std::string PropertyParser::guess(std::span<const std::string> known, std::string_view otherwise) const {
    std::vector<std::string_view> names;
    for (const std::string& name : known) {
        if (!name.empty()) names.push_back(name);
    }
    const std::string_view best =
        token().kind == Token::Kind::word ? spelling::nearest(token().text, names) : std::string_view();
    return best.empty() ? std::string(otherwise) : fmt::format("did you mean '{}'?", best);
}

PropertyReading PropertyParser::parse() {
    while (reading_.error.empty() && token().kind != Token::Kind::end) {
        if (at("ASSUME")) {
            parse_assumption();
        } else {
            parse_property();
        }
    }
    if (!reading_.error.empty()) {
        reading_.properties.clear();
        reading_.assumptions.clear();
    }
    return std::move(reading_);
}

bool PropertyParser::parse_property() {
    Property property;
    if (!expect("PROPERTY", "to begin a property")) return false;
    if (token().kind != Token::Kind::word)
        return fail(fmt::format("a property needs a name, not {}", shown()));
    property.name = token().text;
    for (const Property& other : reading_.properties) {
        if (same_word(other.name, property.name))
            return fail(fmt::format("there are two properties '{}'", property.name));
    }
    ++at_;
    if (!expect(":", "behind the property's name")) return false;
    const std::size_t first = at_;
    if (!parse_form(property)) return false;
    property.text = text_since(first);
    if (!expect(";", "at the end of the property")) return false;
    reading_.properties.push_back(std::move(property));
    return true;
}

std::string PropertyParser::text_since(std::size_t first) const {
    std::string text;
    for (std::size_t i = first; i < at_; ++i) {
        const bool glued = i == first || tokens_[i].text == ")" || tokens_[i - 1].text == "(" ||
                           tokens_[i].text == "." || tokens_[i - 1].text == ".";
        text += glued ? "" : " ";
        text += tokens_[i].text;
    }
    return text;
}

bool PropertyParser::parse_assumption() {
    const std::size_t first = at_++;
    Assumption assumption;
    if (take("NEVER")) {
        if (!parse_condition(assumption.never)) return false;
        if (!is_of_image(assumption.never))
            return fail("what is assumed never to be is made of inputs, INPOS and ERROR");
    } else if (take("MOVING")) {
        if (!expect("ENDS", "behind ASSUME moving") || !expect("WITHIN", "behind ENDS") ||
            !parse_time(assumption.move_ms))
            return false;
        if (assumption.move_ms == 0) return fail("WITHIN takes 1 ms at the least");
    } else {
        if (!parse_stable(assumption)) return false;
    }
    assumption.text = text_since(first);
    if (!expect(";", "at the end of the assumption")) return false;
    reading_.assumptions.push_back(std::move(assumption));
    return true;
}

bool PropertyParser::parse_stable(Assumption& assumption) {
    Condition input;
    if (!parse_signal(input)) return false;
    if (input.kind != Kind::image || input.number > 5)
        return fail("an input is expected between ASSUME and STABLE");
    assumption.input = input.number;
    return expect("STABLE", "behind the input, or NEVER behind ASSUME") && expect("FOR", "behind STABLE") &&
           parse_time(assumption.stable_ms);
}

/// NEVR Head, IF Head: a word, and then one that cannot follow a condition.
bool PropertyParser::begins_no_claim() const {
    if (token().kind != Token::Kind::word || token(1).kind != Token::Kind::word) return false;
    for (const char* first : {"NOT", "STEP", "ANY"}) {
        if (at(first)) return false;
    }
    for (const char* second : {"AND", "OR", "XOR", "IS", "ONLY", "CHANGES"}) {
        if (at(second, 1)) return false;
    }
    return true;
}

bool PropertyParser::parse_form(Property& property) {
    if (take("NEVER")) return parse_never(property);
    if (at("ALWAYS") && at("POSSIBLE", 1)) {
        at_ += 2;
        property.form = Form::always_possible;
        return parse_condition(property.condition);
    }
    if (take("ALWAYS")) {
        property.form = Form::always;
        return parse_condition(property.condition);
    }
    if (take("WHENEVER")) return parse_whenever(property);
    if (take("BETWEEN")) return parse_between(property);
    if (take("AFTER")) {
        property.form = Form::after_possible;
        return parse_condition(property.then) && expect("ALWAYS", "behind AFTER's condition") &&
               expect("POSSIBLE", "behind ALWAYS") && parse_condition(property.condition);
    }
    if (take("EVERY_SCAN")) {
        property.form = Form::scan_ends;
        return expect("FROM", "behind EVERY_SCAN") && parse_condition(property.condition) &&
               expect("ENDS", "behind FROM's condition") && expect("IN", "behind ENDS") &&
               parse_condition(property.then);
    }
    if (begins_no_claim()) {
        const std::array<std::string, 6> words = {"NEVER",   "ALWAYS", "WHENEVER",
                                                  "BETWEEN", "AFTER",  "EVERY_SCAN"};
        return fail(fmt::format(
            "a claim is expected, not {}; {}", shown(),
            guess(words,
                  "it begins with NEVER, ALWAYS, WHENEVER, AFTER, BETWEEN or EVERY_SCAN, or is 'c IS "
                  "REACHABLE', 'c ONLY AFTER d', 'c ONLY FROM d' or 'x CHANGES ONLY IN c'")));
    }
    return parse_condition_first(property);
}

bool PropertyParser::parse_never(Property& property) {
    property.form = Form::never;
    if (!parse_condition(property.condition)) return false;
    if (at("WITHIN"))
        return fail("NEVER takes no WITHIN: write NEVER c WHILE d FOR 5 s, or WHENEVER c THEN d WITHIN 5 s");
    if (!take("WHILE")) return true;
    property.form = Form::never_while;
    return parse_condition(property.then) && expect("FOR", "behind WHILE's condition") &&
           parse_time(property.within_ms) && needs_a_time(property);
}

/// FOR with 0 ms equals no FOR.
bool PropertyParser::needs_a_time(const Property& property) {
    return property.within_ms != 0 || fail("FOR takes 1 ms at the least");
}

bool PropertyParser::parse_whenever(Property& property) {
    property.form = Form::whenever;
    if (!parse_condition(property.condition)) return false;
    if (take("FOLLOWED")) {
        property.form = Form::followed_by;
        return expect("BY", "behind FOLLOWED") && parse_condition(property.then) &&
               expect("THEN", "behind BY's condition") && parse_condition(property.third);
    }
    if (take("FOR")) {
        property.form = Form::never_while;
        property.then = std::move(property.condition);
        property.condition = leaf(Kind::negation);
        return parse_time(property.within_ms) && needs_a_time(property) &&
               expect("THEN", "behind FOR's time") &&
               parse_condition(property.condition.operands.emplace_back());
    }
    if (!expect("THEN", "behind WHENEVER's condition") || !parse_condition(property.then)) return false;
    if (take("WITHIN")) return parse_time(property.within_ms);
    Condition both = leaf(Kind::all_of);
    both.operands.push_back(std::move(property.condition));
    both.operands.push_back(leaf(Kind::negation));
    both.operands.back().operands.push_back(std::move(property.then));
    property.form = Form::never;
    property.condition = std::move(both);
    property.then = {};
    property.is_implied = true;
    return true;
}

bool PropertyParser::parse_between(Property& property) {
    property.form = Form::stays;
    if (!parse_primary(property.condition) || !expect("AND", "behind BETWEEN's first condition") ||
        !parse_primary(property.then) || !parse_condition(property.third) ||
        !expect("STAYS", "behind what is to stay"))
        return false;
    if (take("ON")) return true;
    if (!expect("OFF", "or ON behind STAYS")) return false;
    Condition negation = leaf(Kind::negation);
    negation.operands.push_back(std::move(property.third));
    property.third = std::move(negation);
    return true;
}

bool PropertyParser::parse_condition_first(Property& property) {
    if (!parse_condition(property.condition)) return false;
    if (take("ONLY")) return parse_only(property);
    if (take("CHANGES")) {
        property.form = Form::changes_only_in;
        return expect("ONLY", "behind CHANGES") && expect("IN", "behind ONLY") &&
               parse_condition(property.then);
    }
    property.form = Form::reachable;
    return expect("IS", "behind a condition that begins a property") && expect("REACHABLE", "behind IS");
}

bool PropertyParser::parse_only(Property& property) {
    if (take("FROM")) {
        property.form = Form::only_from;
        return parse_condition(property.then);
    }
    property.form = Form::only_after;
    if (!expect("AFTER", "or FROM behind ONLY") || !parse_condition(property.then)) return false;
    if (!take("FOLLOWED")) return true;
    property.form = Form::only_after_both;
    return expect("BY", "behind FOLLOWED") && parse_condition(property.third);
}

const NamedTime* PropertyParser::time_named(const Token& token) const {
    const auto found = std::find_if(names_.times.begin(), names_.times.end(), [&](const NamedTime& time) {
        return token.kind == Token::Kind::word && same_word(time.name, token.text);
    });
    return found == names_.times.end() ? nullptr : &*found;
}

bool PropertyParser::parse_time(std::uint32_t& milliseconds) {
    constexpr double kLongest = 3'600'000;
    std::string_view text = token().text;
    if (const NamedTime* named = time_named(token())) {
        milliseconds = named->milliseconds;
        tokens_[at_].text = spelled_.emplace_back(fmt::format("{} ms", milliseconds));
        ++at_;
        return true;
    }
    if (token().kind != Token::Kind::number) return fail(fmt::format("a time is expected, not {}", shown()));
    double total = 0;
    const std::size_t prefix = time_prefix(text);
    text = prefix != 0 ? text.substr(prefix) : std::string_view();
    const auto add = [&](std::string_view written, std::string_view unit) {
        std::string number(written);
        std::erase(number, '_');
        double value = 0;
        const auto read = std::from_chars(number.data(), number.data() + number.size(), value);
        const std::span<const Unit> units = prefix != 0 ? std::span<const Unit>(kTimeUnits) : kUnits;
        const auto found =
            std::find_if(units.begin(), units.end(), [&](const Unit& u) { return same_word(u.word, unit); });
        if (read.ptr != number.data() + number.size() || number.empty() || found == units.end()) return false;
        total += value * found->milliseconds;
        return true;
    };
    bool sound = true;
    if (text.empty()) {
        sound = add(token().text, token(1).text);
        at_ += 2;
    } else {
        ++at_;
        while (!text.empty() && sound) {
            const std::size_t digits = std::min(text.find_first_not_of("0123456789._"), text.size());
            const std::string_view number = text.substr(0, digits);
            text.remove_prefix(digits);
            const std::size_t letters = std::min(text.find_first_of("0123456789"), text.size());
            sound = add(number, text.substr(0, letters));
            text.remove_prefix(letters);
        }
    }
    if (!sound || total > kLongest || total != static_cast<double>(static_cast<std::uint32_t>(total))) {
        --at_;
        return fail("a time is whole milliseconds up to an hour, such as 20 ms, 1.5 s or T#1s500ms");
    }
    milliseconds = static_cast<std::uint32_t>(total);
    return true;
}

bool PropertyParser::parse_operators(Condition& result, std::size_t level) {
    if (level == kOperators.size()) return parse_primary(result);
    if (!parse_operators(result, level + 1)) return false;
    if (!at(kOperators[level].word)) return true;
    Condition joined = leaf(kOperators[level].kind);
    joined.operands.push_back(std::move(result));
    while (take(kOperators[level].word)) {
        if (!parse_operators(joined.operands.emplace_back(), level + 1)) return false;
    }
    result = std::move(joined);
    return true;
}

bool PropertyParser::parse_primary(Condition& result) {
    if (depth_ == kDeepest) return fail("this condition is nested too deeply");
    if (take("NOT")) {
        result = leaf(Kind::negation);
        ++depth_;
        const bool sound = parse_primary(result.operands.emplace_back());
        --depth_;
        return sound;
    }
    if (take("(")) {
        ++depth_;
        const bool sound = parse_condition(result);
        --depth_;
        return sound && expect(")", "to close the parenthesis");
    }
    if (at("step") && at("=", 1)) {
        at_ += 2;
        return parse_step(result);
    }
    if (at("step") && at("IN", 1)) {
        at_ += 2;
        return parse_group(result);
    }
    return parse_signal(result);
}

bool PropertyParser::parse_step(Condition& result) {
    std::optional<std::uint8_t> number;
    const std::string_view text = token().text;
    if (at("=")) return fail("= stands twice: write it once, as in STEP = Idle");
    const bool is_name = token().kind != Token::Kind::number;
    if (!is_name) {
        unsigned value = 0;
        const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
        if (read.ptr == text.data() + text.size() && value < names_.steps.size())
            number = static_cast<std::uint8_t>(value);
    } else if (token().kind == Token::Kind::word) {
        number = named(text, names_.steps);
        if (!number && same_word(text, "POWER_UP")) number = std::uint8_t{0};
    }
    const bool is_group = !number && is_name &&
                          std::any_of(names_.groups.begin(), names_.groups.end(),
                                      [&](const StepGroup& group) { return same_word(group.name, text); });
    if (is_group) return fail(fmt::format("{} is a group of steps: write STEP IN {}", shown(), text));
    if (!number)
        return fail(fmt::format("there is no step {}; {}", shown(),
                                guess(names_.steps, "a step is a name or 0 to 62")));
    ++at_;
    result = leaf(Kind::step, *number);
    for (std::uint8_t copy = 0; is_name && copy < names_.copy_of.size(); ++copy) {
        if (names_.copy_of[copy] != number) continue;
        if (result.kind == Kind::step) result = {.kind = Kind::any_of, .number = 0, .operands = {result}};
        result.operands.push_back(leaf(Kind::step, copy));
    }
    return true;
}

/// A group or one step.
bool PropertyParser::parse_group(Condition& result) {
    const auto group = std::find_if(names_.groups.begin(), names_.groups.end(), [&](const StepGroup& known) {
        return token().kind == Token::Kind::word && same_word(known.name, token().text);
    });
    if (group == names_.groups.end()) {
        if (token().kind == Token::Kind::word && named(token().text, names_.steps)) return parse_step(result);
        std::vector<std::string> known(names_.steps.begin(), names_.steps.end());
        for (const StepGroup& one : names_.groups) known.push_back(one.name);
        return fail(fmt::format("there is no group {}; {}", shown(),
                                guess(known, "a group is declared with GROUP Name: steps;")));
    }
    ++at_;
    result = leaf(Kind::any_of);
    for (std::uint8_t step = 0; step < names_.steps.size(); ++step) {
        if (((group->steps >> step) & 1U) != 0) result.operands.push_back(leaf(Kind::step, step));
    }
    if (result.operands.empty()) result = leaf(Kind::constant);
    if (result.operands.size() == 1) result = Condition(result.operands.front());
    return true;
}

bool PropertyParser::parse_signal(Condition& result) {
    constexpr std::uint8_t kInPosBit = 6;
    constexpr std::uint8_t kErrorBit = 7;
    const std::string_view text = token().text;
    if (at("TRUE") || at("FALSE")) {
        result = leaf(Kind::constant, at("TRUE") ? 1 : 0);
    } else if (at("INPOS")) {
        result = leaf(Kind::image, kInPosBit);
    } else if (at("ERROR")) {
        result = leaf(Kind::image, kErrorBit);
    } else if (at("ANY") && at("ERROR", 1)) {
        result = leaf(Kind::constant, 1);
        ++at_;
    } else if (at("MOVING")) {
        result = leaf(Kind::moving);
    } else if (at("TIMER") || at("COUNTER")) {
        result = leaf(at("TIMER") ? Kind::timer_q : Kind::counter_q);
        if (!at(".", 1) || !at("Q", 2)) return fail("only TIMER.Q and COUNTER.Q can be tested: true at zero");
        at_ += 2;
    } else if (const auto input = named(text, names_.inputs)) {
        result = leaf(Kind::image, *input);
    } else if (const auto output = named(text, names_.outputs)) {
        result = leaf(Kind::output, *output);
    } else if (const auto in = numbered(text, "IN", 6)) {
        result = leaf(Kind::image, *in);
    } else if (const auto out = numbered(text, "OUT", 4)) {
        result = leaf(Kind::output, *out);
    } else if (const auto ix = numbered(text, "%IX0.", 6)) {
        result = leaf(Kind::image, *ix);
    } else if (const auto qx = numbered(text, "%QX0.", 4)) {
        result = leaf(Kind::output, *qx);
    } else {
        std::vector<std::string> known(names_.inputs.begin(), names_.inputs.end());
        known.insert(known.end(), names_.outputs.begin(), names_.outputs.end());
        known.insert(known.end(), {"INPOS", "ERROR", "moving"});
        const std::string meant = guess(known, "");
        return fail(
            fmt::format("an input, an output, INPOS, ERROR, TIMER.Q, COUNTER.Q, moving or 'step = Name' is "
                        "expected, not {}{}{}",
                        shown(), meant.empty() ? "" : "; ", meant));
    }
    ++at_;
    return true;
}

PropertyReading read_properties(std::string_view text, const Names& names) {
    return PropertyParser(text, names).parse();
}

}  // namespace nplc::verify
