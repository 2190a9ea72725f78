#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "syntax/names.h"
#include "syntax/parser.h"

namespace nplc::seqc {

void Parser::parse_property(ast::Program& program) {
    const Token first = token();
    ++at_;
    ast::Name name;
    if (!expect_name(name, "the property's name", ast::Role::property, true)) {
        if (is_symbol_at(1, ":")) ++at_;  // a keyword as name: the claim follows all the same
        return recover_claim();
    }
    if (!expect_symbol(":", "behind the property's name")) return recover_claim();
    claim_ = {};
    claim_.name = name;
    in_property_ = true;
    const bool sound = parse_claim();
    in_property_ = false;
    if (!sound) return recover_claim();
    add_claim(first, program);
}

bool Parser::parse_fact() {
    ast::Expression condition;
    const bool sound = parse_expression(condition);
    claim_.conditions.push_back(std::move(condition));
    return sound;
}

bool Parser::parse_single_fact() {
    ast::Expression condition;
    const bool sound = parse_primary(condition);
    claim_.conditions.push_back(std::move(condition));
    return sound;
}

/// BETWEEN's second test: parentheses after it belong to the next condition.
bool Parser::parse_before_fact() {
    before_fact_ = true;
    const bool sound = parse_single_fact();
    before_fact_ = false;
    return sound;
}

bool Parser::parse_claimed_time() {
    ast::Value time;
    const bool is_name = token().kind == TokenKind::identifier;
    if (is_name) {
        time.kind = ast::Value::Kind::name;
        time.span = token().span;
        if (!expect_name(time.name, "a time or the name of one", ast::Role::constant)) return false;
    } else if (!parse_literal(time)) {
        return false;
    }
    claim_.times.push_back(std::move(time));
    return true;
}

/// What can begin a claim, in the place of a word that cannot.
bool Parser::refuse_claim(std::string_view word) {
    const std::string near =
        suggestion(word, {"NEVER", "ALWAYS", "WHENEVER", "BETWEEN", "AFTER", "EVERY_SCAN"});
    report_.add(
        "E010", token().span, fmt::format("a claim is expected behind the property's name, found '{}'", word),
        near.empty() ? "it begins with NEVER, ALWAYS, WHENEVER, AFTER, BETWEEN or EVERY_SCAN, or is 'c IS "
                       "REACHABLE', 'c ONLY AFTER d', 'c ONLY FROM d' or 'x CHANGES ONLY IN c'"
                     : near);
    ++at_;
    return false;
}

/// NEVR Head, IF Head, EVENTUALLY Head: a word, and then one that cannot follow a condition.
bool Parser::begins_no_claim() const {
    if (token().kind != TokenKind::identifier || at("NOT") || at("STEP") || at("ANY")) return false;
    if (at("IF")) return true;
    constexpr std::array<std::string_view, 6> kBehindCondition{"AND", "OR", "XOR", "IS", "ONLY", "CHANGES"};
    return is_word_at(0) && token(1).kind == TokenKind::identifier &&
           std::none_of(kBehindCondition.begin(), kBehindCondition.end(),
                        [&](std::string_view word) { return same_name(token(1).text, word); });
}

bool Parser::parse_never() {
    if (!parse_fact()) return false;
    if (at("WITHIN")) {
        report_.add("E010", token().span, "NEVER takes no WITHIN",
                    "write NEVER c WHILE d FOR 5 s, or WHENEVER c THEN d WITHIN 5 s");
        return false;
    }
    return !take("WHILE") ||
           (parse_fact() && expect("FOR", "behind WHILE's condition") && parse_claimed_time());
}

bool Parser::parse_claim() {
    if (take("NEVER")) return parse_never();
    if (take("ALWAYS")) {
        take("POSSIBLE");
        return parse_fact();
    }
    if (take("WHENEVER")) return parse_whenever();
    if (take("BETWEEN")) {
        return parse_single_fact() && expect("AND", "behind BETWEEN's first condition") &&
               parse_before_fact() && parse_fact() && expect("STAYS", "behind what is to stay") &&
               (take("OFF") || expect("ON", "or OFF behind STAYS"));
    }
    if (take("AFTER")) {
        return parse_fact() && expect("ALWAYS", "behind AFTER's condition") &&
               expect("POSSIBLE", "behind ALWAYS") && parse_fact();
    }
    if (take("EVERY_SCAN")) {
        return expect("FROM", "behind EVERY_SCAN") && parse_fact() &&
               expect("ENDS", "behind FROM's condition") && expect("IN", "behind ENDS") && parse_fact();
    }
    if (begins_no_claim()) return refuse_claim(token().text);
    if (!parse_fact()) return false;
    if (take("ONLY")) return parse_only();
    if (take("CHANGES")) {
        return expect("ONLY", "behind CHANGES") && expect("IN", "behind ONLY") && parse_fact();
    }
    return expect("IS", "behind a condition that begins a property") && expect("REACHABLE", "behind IS");
}

bool Parser::parse_whenever() {
    if (!parse_fact()) return false;
    if (take("FOLLOWED")) {
        return expect("BY", "behind FOLLOWED") && parse_fact() && expect("THEN", "behind BY's condition") &&
               parse_fact();
    }
    const bool lasts = take("FOR");
    if ((lasts && !parse_claimed_time()) || !expect("THEN", "behind WHENEVER's condition") || !parse_fact())
        return false;
    claim_.time_may_be_zero = !lasts;
    return lasts || !take("WITHIN") || parse_claimed_time();
}

bool Parser::parse_only() {
    if (take("FROM")) return parse_fact();
    if (!expect("AFTER", "or FROM behind ONLY") || !parse_fact()) return false;
    return !take("FOLLOWED") || (expect("BY", "behind FOLLOWED") && parse_fact());
}

bool Parser::parse_assumed() {
    if (take("NEVER")) {
        claim_.kind = ast::Claim::Kind::never;
        return parse_fact();
    }
    if (parse_single_fact() && take("ENDS")) {
        claim_.kind = ast::Claim::Kind::ends;
        return expect("WITHIN", "behind ENDS") && parse_claimed_time();
    }
    claim_.kind = ast::Claim::Kind::stable;
    return expect("STABLE", "behind ASSUME's input, or ENDS behind moving") &&
           expect("FOR", "behind STABLE") && parse_claimed_time();
}

/// An assumption for the proof of properties.
void Parser::parse_assumption(ast::Program& program) {
    const Token first = token();
    ++at_;
    claim_ = {};
    in_property_ = true;
    const bool sound = parse_assumed();
    in_property_ = false;
    if (!sound) return recover_claim();
    add_claim(first, program);
}

bool Parser::at_step_test() const {
    return at("STEP") && (is_symbol_at(1, "=") || same_name(token(1).text, "IN"));
}

/// Skips to its end; STEP in a test does not begin a step.
void Parser::recover_claim() {
    while (!at_symbol(";") && (!at_boundary() || at_step_test()) && token().kind != TokenKind::end) ++at_;
    take_symbol(";");
}

void Parser::add_claim(const Token& first, ast::Program& program) {
    Span span = span_since(first);
    if (at_symbol(";")) span.length = token().span.offset + token().span.length - span.offset;
    program.properties.push_back(span);
    program.claims.push_back(std::move(claim_));
    end_statement();
}

/// STEP = Name, or its number; STEP IN Group.
bool Parser::parse_step_test(ast::Expression& result) {
    ++at_;
    result.kind = ast::Expression::Kind::step;
    if (take("IN")) {
        result.value = true;
        result.name = name_of(token());
        return expect_name(result.name, "the name of a group", ast::Role::step_or_group);
    }
    if (!expect_symbol("=", "or IN behind STEP, as in STEP = Idle")) return false;
    const Token target = token();
    if (at_symbol("=")) {
        report_.add("E010", target.span, "= stands twice", "write it once, as in STEP = Idle");
        ++at_;
        return parse_step_name(result);
    }
    return parse_step_name(result);
}

bool Parser::parse_step_name(ast::Expression& result) {
    const Token target = token();
    result.name = name_of(target);
    if (take("POWER_UP")) return true;
    if (target.kind == TokenKind::identifier)
        return expect_name(result.name, "the name of a step", ast::Role::step);
    ast::Value number;
    return parse_literal(number);
}

}  // namespace nplc::seqc
