#include "syntax/parser.h"

namespace nplc::seqc {

void Parser::parse_property(ast::Program& program) {
    const Token first = token();
    ++at_;
    ast::Name name;
    if (!expect_name(name, "the property's name", ast::Role::property, true) ||
        !expect_symbol(":", "behind the property's name"))
        return recover_claim();
    in_property_ = true;
    const bool sound = parse_claim();
    in_property_ = false;
    if (!sound) return recover_claim();
    add_claim(first, program);
}

/// BETWEEN's second test: what follows in parentheses is the next condition.
bool Parser::parse_before_fact(ast::Expression& condition) {
    before_fact_ = true;
    const bool sound = parse_primary(condition);
    before_fact_ = false;
    return sound;
}

bool Parser::parse_claim() {
    ast::Expression condition;
    ast::Value time;
    if (take("NEVER")) {
        if (!parse_expression(condition)) return false;
        return !take("WHILE") || (parse_expression(condition) && expect("FOR", "behind WHILE's condition") &&
                                  parse_literal(time));
    }
    if (take("ALWAYS")) {
        take("POSSIBLE");
        return parse_expression(condition);
    }
    if (take("WHENEVER")) return parse_whenever();
    if (take("BETWEEN")) {
        return parse_primary(condition) && expect("AND", "behind BETWEEN's first condition") &&
               parse_before_fact(condition) && parse_expression(condition) &&
               expect("STAYS", "behind what is to stay") &&
               (take("OFF") || expect("ON", "or OFF behind STAYS"));
    }
    if (take("AFTER")) {
        return parse_expression(condition) && expect("ALWAYS", "behind AFTER's condition") &&
               expect("POSSIBLE", "behind ALWAYS") && parse_expression(condition);
    }
    if (take("EVERY_SCAN")) {
        return expect("FROM", "behind EVERY_SCAN") && parse_expression(condition) &&
               expect("ENDS", "behind FROM's condition") && expect("IN", "behind ENDS") &&
               parse_expression(condition);
    }
    if (!parse_expression(condition)) return false;
    if (take("ONLY")) return parse_only();
    if (take("CHANGES")) {
        return expect("ONLY", "behind CHANGES") && expect("IN", "behind ONLY") && parse_expression(condition);
    }
    return expect("IS", "behind a condition that begins a property") && expect("REACHABLE", "behind IS");
}

bool Parser::parse_whenever() {
    ast::Expression condition;
    ast::Value time;
    if (!parse_expression(condition)) return false;
    if (take("FOLLOWED")) {
        return expect("BY", "behind FOLLOWED") && parse_expression(condition) &&
               expect("THEN", "behind BY's condition") && parse_expression(condition);
    }
    const bool lasts = take("FOR");
    if ((lasts && !parse_literal(time)) || !expect("THEN", "behind WHENEVER's condition") ||
        !parse_expression(condition))
        return false;
    return lasts || !take("WITHIN") || parse_literal(time);
}

bool Parser::parse_only() {
    ast::Expression condition;
    if (take("FROM")) return parse_expression(condition);
    if (!expect("AFTER", "or FROM behind ONLY") || !parse_expression(condition)) return false;
    return !take("FOLLOWED") || (expect("BY", "behind FOLLOWED") && parse_expression(condition));
}

/// What is taken for granted when properties are proved.
void Parser::parse_assumption(ast::Program& program) {
    const Token first = token();
    ++at_;
    ast::Expression condition;
    ast::Value time;
    in_property_ = true;
    bool sound = false;
    if (take("NEVER")) {
        sound = parse_expression(condition);
    } else if (parse_primary(condition) && take("ENDS")) {
        sound = expect("WITHIN", "behind ENDS") && parse_literal(time);
    } else {
        sound = expect("STABLE", "behind ASSUME's input, or ENDS behind moving") &&
                expect("FOR", "behind STABLE") && parse_literal(time);
    }
    in_property_ = false;
    if (!sound) return recover_claim();
    add_claim(first, program);
}

/// To its end; a step tested in it begins none.
void Parser::recover_claim() {
    while (!at_symbol(";") && (!at_boundary() || (at("STEP") && is_symbol_at(1, "="))) &&
           token().kind != TokenKind::end)
        ++at_;
    take_symbol(";");
}

void Parser::add_claim(const Token& first, ast::Program& program) {
    Span span = span_since(first);
    if (at_symbol(";")) span.length = token().span.offset + token().span.length - span.offset;
    program.properties.push_back(span);
    end_statement();
}

/// STEP = Name, or its number. What it means is `tools/verify`'s.
bool Parser::parse_step_test() {
    ++at_;
    ast::Name name;
    ast::Value number;
    if (!expect_symbol("=", "behind STEP, as in STEP = Idle")) return false;
    if (take("POWER_UP")) return true;
    return token().kind == TokenKind::identifier ? expect_name(name, "the name of a step", ast::Role::step)
                                                 : parse_literal(number);
}

}  // namespace nplc::seqc
