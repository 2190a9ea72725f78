#include "syntax/parser.h"

namespace nplc::seqc {

bool Parser::at_symbolic_term() const {
    return at("IF") || (token().kind == TokenKind::identifier && token(1).kind == TokenKind::symbol &&
                        token(1).text == ":");
}

bool Parser::parse_symbolic_term(const Token& first, std::vector<ast::RawTerm>& terms) {
    ast::RawTerm term;
    ast::SymbolicTerm& symbols = term.symbols.emplace();
    bool has_name = true;
    if (!at("IF")) {
        has_name = expect_name(symbols.step, "the name of a step");
        at_ += has_name ? 1 : 2;
    }
    const Span opened = token().span;
    if (!expect("IF", "after the step's name, as in TERM Idle: IF Start THEN ... END_IF;")) return false;
    if (!parse_expression(symbols.condition)) {
        symbols.condition.kind = ast::Expression::Kind::constant;
        while (!at("THEN") && !at_boundary() && !at_symbol(";")) ++at_;
    }
    if (!take("THEN")) error_here("THEN after the condition");
    parse_symbolic_body(symbols);
    if (at("ELSIF") || at("ELSE")) {
        report_.add("E094", token().span, "a TERM is one term, which has one condition",
                    "write another TERM; the last that holds decides");
        while (!at_block_end("END_IF")) ++at_;
    }
    end_block("END_IF", opened);
    term.span = span_since(first);
    if (has_name) terms.push_back(std::move(term));
    return true;
}

void Parser::parse_symbolic_body(ast::SymbolicTerm& term) {
    while (!at_boundary() && !report_.full()) {
        if (take_symbol(";")) continue;
        if (take("OUT")) {
            if (parse_outputs(term.outputs)) {
                end_statement();
            } else {
                recover();
            }
            continue;
        }
        const std::size_t before = at_;
        ast::Statement statement;
        if (parse_statement(statement)) term.statements.push_back(std::move(statement));
        if (at_ == before) ++at_;
    }
}

}  // namespace nplc::seqc
