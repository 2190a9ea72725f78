#include "language/term_parser.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace nplc::seqc {
namespace {

bool at_symbolic_term(const TokenStream& in) {
    return in.at("IF") || (in.token().kind == TokenKind::identifier &&
                           in.token(1).kind == TokenKind::symbol && in.token(1).text == ":");
}

}  // namespace

bool TermParser::parse(std::vector<ast::RawTerm>& terms) {
    const Token first = in_.token();
    in_.skip();
    if (at_symbolic_term(in_)) return parse_symbolic(first, terms);
    ast::RawTerm term;
    bool sound = true;
    do {
        ast::Value value;
        if (!values_.parse_literal(value, true)) return false;
        const bool is_byte = value.number >= 0 && value.number <= 255 &&
                             std::floor(value.number) == value.number && value.unit.text.empty() &&
                             !value.is_time;
        if (!is_byte) {
            in_.report().add("E090", value.span, "this is not a byte", "write 0..255 or 16#00..16#FF");
            sound = false;
            continue;
        }
        term.bytes.push_back(static_cast<std::uint8_t>(value.number));
    } while (in_.take_symbol(","));
    term.span = in_.span_since(first);
    if (sound && term.bytes.size() != 8) {
        in_.report().add("E090", term.span, fmt::format("a term has 8 bytes, here are {}", term.bytes.size()),
                         "write all eight: STATE, INPUT, CARE, NEXT_STATE and four bytes more (001 §6.1)");
        sound = false;
    }
    if (sound) terms.push_back(std::move(term));
    in_.end_statement();
    return true;
}

bool TermParser::parse_symbolic(const Token& first, std::vector<ast::RawTerm>& terms) {
    ast::RawTerm term;
    ast::SymbolicTerm& symbols = term.symbols.emplace();
    bool has_name = true;
    if (!in_.at("IF")) {
        has_name = notes_.expect_name(symbols.step, "the name of a step", ast::Role::step);
        in_.skip(has_name ? 1 : 2);
    }
    const Span opened = in_.token().span;
    if (!in_.expect("IF", "after the step's name, as in TERM Idle: IF Start THEN ... END_IF;")) return false;
    if (!conditions_.parse(symbols.condition)) {
        symbols.condition.kind = ast::Expression::Kind::constant;
        while (!in_.at("THEN") && !in_.at_boundary() && !in_.at_symbol(";")) in_.skip();
    }
    if (!in_.take("THEN")) in_.error_here("THEN after the condition");
    parse_symbolic_body(symbols);
    if (in_.at("ELSIF") || in_.at("ELSE")) {
        in_.report().add("E094", in_.token().span, "a TERM is one term, which has one condition",
                         "write another TERM; the last that holds decides");
        while (!in_.at_block_end("END_IF")) in_.skip();
    }
    notes_.end_block("END_IF", opened);
    term.span = in_.span_since(first);
    if (has_name) terms.push_back(std::move(term));
    return true;
}

void TermParser::parse_symbolic_body(ast::SymbolicTerm& term) {
    while (!in_.at_boundary() && !in_.report().full()) {
        if (in_.take_symbol(";")) continue;
        if (in_.take("OUT")) {
            if (statements_.parse_outputs(term.outputs)) {
                in_.end_statement();
            } else {
                in_.recover();
            }
            continue;
        }
        const std::size_t before = in_.position();
        ast::Statement statement;
        if (statements_.parse(statement)) term.statements.push_back(std::move(statement));
        if (in_.position() == before) in_.skip();
    }
}

}  // namespace nplc::seqc
