#include "language/property_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "language/names.h"

namespace nplc::seqc {
namespace {

/// Water = 1, Brush -> Water, Water FOR 2 s: what other languages put behind a condition.
std::string help_behind_claim(const Token& before, const Token& here, const Token& next) {
    const auto is_sign = [](const Token& token, std::string_view sign) {
        return token.kind == TokenKind::symbol && token.text == sign;
    };
    const auto is_word = [&](std::string_view word) {
        return here.kind == TokenKind::identifier && same_name(here.text, word);
    };
    const bool is_arrow = (is_sign(here, "-") || is_sign(here, "=")) && is_sign(next, ">");
    if (is_arrow || is_word("IMPLIES")) return "what follows from what is written WHENEVER c THEN d";
    const bool compares = is_sign(here, "=") || is_sign(here, "<") || is_sign(here, ">") || is_word("IN");
    if (compares && before.kind == TokenKind::identifier)
        return "STEP alone is compared, as in STEP = Name or STEP IN Group; inputs and outputs hold or not: "
               "write "
               "Name or NOT Name";
    if (is_word("FOR"))
        return "how long something holds stands in WHENEVER c FOR 2 s THEN d, or NEVER c WHILE d FOR 2 s";
    if (is_sign(here, ",")) return "STEP IN takes one group: GROUP Name: steps; gives several steps a name";
    return {};
}

bool at_step_test(const TokenStream& in) {
    return in.at("STEP") && (in.is_symbol_at(1, "=") || same_name(in.token(1).text, "IN"));
}

/// Skips to its end; STEP in a test does not begin a step.
void recover_claim(TokenStream& in) {
    while (!in.at_symbol(";") && (!in.at_boundary() || at_step_test(in)) && !in.at_end()) in.skip();
    in.take_symbol(";");
}

/// What can begin a claim, in the place of a word that cannot.
bool refuse_claim(TokenStream& in, std::string_view word) {
    const std::string near =
        suggestion(word, {"NEVER", "ALWAYS", "WHENEVER", "BETWEEN", "AFTER", "EVERY_SCAN"});
    in.report().add("E010", in.token().span,
                    fmt::format("a claim is expected behind the property's name, found '{}'", word),
                    near.empty()
                        ? "it begins with NEVER, ALWAYS, WHENEVER, AFTER, BETWEEN or EVERY_SCAN, or is 'c IS "
                          "REACHABLE', 'c ONLY AFTER d', 'c ONLY FROM d' or 'x CHANGES ONLY IN c'"
                        : near);
    in.skip();
    return false;
}

/// NEVR Head, IF Head, EVENTUALLY Head: a word, and then one that cannot follow a condition.
bool begins_no_claim(const TokenStream& in) {
    if (in.token().kind != TokenKind::identifier || in.at("NOT") || in.at("STEP") || in.at("ANY"))
        return false;
    if (in.at("IF")) return true;
    constexpr std::array<std::string_view, 6> kBehindCondition{"AND", "OR", "XOR", "IS", "ONLY", "CHANGES"};
    return in.is_word_at(0) && in.token(1).kind == TokenKind::identifier &&
           std::none_of(kBehindCondition.begin(), kBehindCondition.end(),
                        [&](std::string_view word) { return same_name(in.token(1).text, word); });
}

}  // namespace

void PropertyParser::parse(ast::Program& program) {
    const Token first = in_.token();
    in_.skip();
    claim_ = {};
    if (in_claims_file_ && in_.token().kind == TokenKind::identifier && in_.is_symbol_at(1, ":")) {
        claim_.name = name_of(in_.token());
        notes_.add_use(ast::Role::property, in_.token().span, true);
        in_.skip();
    } else if (!notes_.expect_name(claim_.name, "the property's name", ast::Role::property, true)) {
        if (in_.is_symbol_at(1, ":")) in_.skip();  // a keyword as name: the claim follows all the same
        return recover_claim(in_);
    }
    if (!in_.expect_symbol(":", "behind the property's name")) return recover_claim(in_);
    claim_begin_ = in_.position();
    const bool is_sound = parse_form();
    finish_claim(first, is_sound, program);
}

void PropertyParser::parse_assumption(ast::Program& program) {
    const Token first = in_.token();
    claim_ = {};
    claim_begin_ = in_.position();
    in_.skip();
    const bool is_sound = parse_assumed();
    finish_claim(first, is_sound, program);
}

void PropertyParser::parse_file(ast::Program& program) {
    in_claims_file_ = true;
    while (!in_.at_end() && !in_.report().full_of_errors()) {
        if (in_.at("PROPERTY")) {
            parse(program);
        } else if (in_.at("ASSUME")) {
            parse_assumption(program);
        } else {
            if (!in_.mend({"PROPERTY", "ASSUME"}, "PROPERTY or ASSUME") && !in_.report().has_errors())
                in_.error_here("PROPERTY or ASSUME", "such a file has PROPERTY Name: form; and ASSUME only");
            if (!in_.at("PROPERTY") && !in_.at("ASSUME")) in_.skip();
        }
    }
}

void PropertyParser::finish_claim(const Token& first, bool is_sound, ast::Program& program) {
    if (!is_sound) return recover_claim(in_);
    claim_.span = in_.span_since(first);
    if (in_.at_symbol(";"))
        claim_.span.length = in_.token().span.offset + in_.token().span.length - claim_.span.offset;
    if (const std::string help = help_behind_claim(in_.last(), in_.token(), in_.token(1)); !help.empty()) {
        in_.report().add("E010", in_.token().span,
                         fmt::format("a property cannot continue with '{}' behind '{}'", in_.token().text,
                                     in_.last().text),
                         help);
        return recover_claim(in_);
    }
    for (std::size_t i = claim_begin_; i < in_.position(); ++i) claim_.words.push_back(in_.tokens()[i].text);
    program.claims.push_back(std::move(claim_));
    in_.end_statement();
}

bool PropertyParser::parse_form() {
    if (in_.take("NEVER")) return parse_never();
    if (in_.take("ALWAYS"))
        return as(in_.take("POSSIBLE") ? Form::always_possible : Form::always) && parse_condition();
    if (in_.take("WHENEVER")) return parse_whenever();
    if (in_.take("BETWEEN")) return parse_between();
    if (in_.take("AFTER")) {
        return as(Form::after_possible) && parse_condition() &&
               in_.expect("ALWAYS", "behind AFTER's condition") && in_.expect("POSSIBLE", "behind ALWAYS") &&
               parse_condition();
    }
    if (in_.take("EVERY_SCAN")) {
        return as(Form::scan_ends) && in_.expect("FROM", "behind EVERY_SCAN") && parse_condition() &&
               in_.expect("ENDS", "behind FROM's condition") && in_.expect("IN", "behind ENDS") &&
               parse_condition();
    }
    if (begins_no_claim(in_)) return refuse_claim(in_, in_.token().text);
    return parse_condition_first();
}

bool PropertyParser::parse_never() {
    if (!parse_condition()) return false;
    if (in_.at("WITHIN")) {
        in_.report().add("E010", in_.token().span, "NEVER takes no WITHIN",
                         "write NEVER c WHILE d FOR 5 s, or WHENEVER c THEN d WITHIN 5 s");
        return false;
    }
    if (!in_.take("WHILE")) return as(Form::never);
    return as(Form::never_while) && parse_condition() && in_.expect("FOR", "behind WHILE's condition") &&
           parse_time();
}

bool PropertyParser::parse_whenever() {
    if (!parse_condition()) return false;
    if (in_.take("FOLLOWED")) {
        return as(Form::followed_by) && in_.expect("BY", "behind FOLLOWED") && parse_condition() &&
               in_.expect("THEN", "behind BY's condition") && parse_condition();
    }
    const bool lasts = in_.take("FOR");
    as(lasts ? Form::whenever_for : Form::whenever);
    if ((lasts && !parse_time()) || !in_.expect("THEN", "behind WHENEVER's condition") || !parse_condition())
        return false;
    return lasts || !in_.take("WITHIN") || parse_time();
}

/// The second condition is a single one: parentheses behind it belong to the third.
bool PropertyParser::parse_between() {
    if (!parse_single_condition() || refuse_joined({"OR", "XOR"}) ||
        !in_.expect("AND", "behind BETWEEN's first condition"))
        return false;
    if (!parse_single_condition(true) || refuse_joined({"OR", "XOR", "AND"}) || !parse_condition() ||
        !in_.expect("STAYS", "behind what is to stay"))
        return false;
    as(in_.take("OFF") ? Form::stays_off : Form::stays_on);
    return claim_.form == Form::stays_off || in_.expect("ON", "or OFF behind STAYS");
}

bool PropertyParser::refuse_joined(std::initializer_list<std::string_view> words) {
    if (std::none_of(words.begin(), words.end(), [&](std::string_view word) { return in_.at(word); }))
        return false;
    in_.report().add("E010", in_.token().span,
                     fmt::format("BETWEEN takes single conditions, and '{}' joins two", in_.token().text),
                     "put them in parentheses: BETWEEN (a OR b) AND (c OR d) e STAYS ON");
    return true;
}

bool PropertyParser::parse_condition_first() {
    if (!parse_condition()) return false;
    if (in_.take("ONLY")) return parse_only();
    if (in_.take("CHANGES")) {
        return as(Form::changes_only_in) && in_.expect("ONLY", "behind CHANGES") &&
               in_.expect("IN", "behind ONLY") && parse_condition();
    }
    return as(Form::reachable) && in_.expect("IS", "behind a condition that begins a property") &&
           in_.expect("REACHABLE", "behind IS");
}

bool PropertyParser::parse_only() {
    if (in_.take("FROM")) return as(Form::only_from) && parse_condition();
    if (!in_.at("AFTER")) {
        in_.report().add("E010", in_.token().span,
                         fmt::format("expected AFTER or FROM behind ONLY, found '{}'", in_.token().text),
                         "where it may hold alone is NEVER c AND NOT d, or x CHANGES ONLY IN d");
        in_.skip();
        return false;
    }
    in_.skip();
    if (!parse_condition()) return false;
    if (!in_.take("FOLLOWED")) return as(Form::only_after);
    return as(Form::only_after_both) && in_.expect("BY", "behind FOLLOWED") && parse_condition();
}

bool PropertyParser::parse_assumed() {
    if (in_.take("NEVER")) return as(Form::assume_never) && parse_condition();
    if (!parse_single_condition()) return false;
    if (in_.take("ENDS"))
        return as(Form::assume_move_ends) && in_.expect("WITHIN", "behind ENDS") && parse_time();
    return as(Form::assume_stable) && in_.expect("STABLE", "behind ASSUME's input, or ENDS behind moving") &&
           in_.expect("FOR", "behind STABLE") && parse_time();
}

bool PropertyParser::parse_condition() {
    ast::Expression condition;
    const bool is_sound = conditions_.parse(condition);
    claim_.conditions.push_back(std::move(condition));
    return is_sound;
}

bool PropertyParser::parse_single_condition(bool another_follows) {
    ast::Expression condition;
    const bool is_sound = conditions_.parse_single(condition, another_follows);
    claim_.conditions.push_back(std::move(condition));
    return is_sound;
}

bool PropertyParser::parse_time() {
    ast::Value& time = claim_.time.emplace();
    if (in_.token().kind != TokenKind::identifier) return values_.parse_literal(time);
    time.kind = ast::Value::Kind::name;
    time.span = in_.token().span;
    return notes_.expect_name(time.name, "a time or the name of one", ast::Role::constant);
}

}  // namespace nplc::seqc
