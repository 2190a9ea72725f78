#include <fmt/format.h>

#include <cmath>

#include "language/foreign_words.h"
#include "language/names.h"
#include "language/parser.h"

namespace nplc::seqc {
namespace {

using ast::Statement;

}  // namespace

bool Parser::parse_if(ast::Choice& choice) {
    const Span opened = token().span;
    bool last = false;
    std::size_t ends_too_many = 0;
    do {
        ast::Branch branch;
        branch.span = token().span;
        if (at("ELSE") && same_name(token(1).text, "IF")) {
            const Token first = token();
            ++at_;
            ++ends_too_many;
            report_.add("E010", {first.span.offset, token().span.offset + 2 - first.span.offset},
                        "an IF cannot stand inside another: ELSE IF is the word ELSIF",
                        "write ELSIF, and one END_IF for all of it");
        }
        last = at("ELSE") && !refuse_else_with_condition();
        ++at_;
        if (!last) {
            branch.condition.emplace();
            if (!parse_expression(*branch.condition)) {
                branch.condition->kind = ast::Expression::Kind::constant;
                while (!at("THEN") && !at_boundary() && !at_symbol(";")) ++at_;
            }
            parse_timing(branch, choice.branches.empty());
            take_then();
        }
        parse_branch_body(branch, opened);
        choice.branches.push_back(std::move(branch));
    } while (!last && (at("ELSIF") || at("ELSE")));
    const ast::Branch& first = choice.branches.front();
    if (!last && first.timing && first.timing->is_limit) {
        report_
            .add("E010", place_here(), "WITHIN needs an ELSE: what happens when the time has passed",
                 "write ELSE NEXT := Step; before END_IF")
            .notes.push_back({first.timing->span, "the time limit is here"});
    }
    end_block("END_IF", opened);
    for (; ends_too_many > 0 && take("END_IF"); --ends_too_many) take_symbol(";");
    return true;
}

/// WITHIN belongs to the whole IF, FOR to its condition.
void Parser::parse_timing(ast::Branch& branch, bool is_first) {
    const Token first = token();
    const bool is_limit = take("WITHIN");
    if (!is_limit && !take("FOR")) return;
    ast::Timing timing;
    timing.is_limit = is_limit;
    if (!expect_time(timing.time, is_limit ? "WITHIN" : "FOR")) {
        while (!at("THEN") && !at_boundary() && !at_symbol(";")) ++at_;
        return;
    }
    timing.span = span_since(first);
    if (is_limit && !is_first) {
        report_.add("E010", timing.span, "WITHIN stands behind the condition of IF, not of ELSIF",
                    "it is the time limit of the whole IF: write it there");
        return;
    }
    branch.timing = std::move(timing);
}

/// Extra text between the condition and THEN is reported as one error.
void Parser::take_then() {
    if (take("THEN") || (mend({"THEN"}, "THEN after the condition") && take("THEN"))) return;
    if (at_symbol(";") && same_name(token(1).text, "THEN")) {
        report_.add("E010", token().span, "no ';' stands between a condition and THEN", "leave it out");
        at_ += 2;
        return;
    }
    error_here("THEN after the condition",
               at_symbol(")") ? "there is no '(' for this ')'"
                              : "write IF condition THEN; AND, OR and XOR join two conditions");
    if (take_symbol(":")) return;
    const std::size_t before = at_;
    while (!at("THEN") && !at_boundary() && !at_symbol(";")) ++at_;
    if (!take("THEN")) at_ = before;
}

void Parser::parse_branch_body(ast::Branch& branch, Span opened) {
    while (!at("ELSIF") && !at("ELSE") && !at("END_STEP") && !at("STEP") && !at("POWER_UP") &&
           !at("END_POWER_UP") && !at("END_SEQUENCE") && !at_block_end("END_IF") && !report_.full()) {
        if (take_symbol(";")) continue;
        const std::size_t before = at_;
        mend_statement({"ELSIF", "ELSE", "END_IF"});
        if (at("ELSIF") || at("ELSE") || at("END_IF")) break;
        if (at("IF")) {
            ast::Choice inner;
            report_
                .add("E064", token().span, "an IF cannot stand inside another",
                     "join the two conditions with AND, or use ELSIF")
                .notes.push_back({opened, "the outer IF begins here"});
            parse_if(inner);
        } else if (refuse_item_inside()) {
            continue;
        } else if (at("OUT")) {
            report_.add("E064", token().span, "OUT cannot stand inside an IF",
                        "outputs belong to the step: write OUT Name WHEN condition; beside the IF");
            recover();
        } else {
            Statement statement;
            if (parse_statement(statement)) branch.statements.push_back(std::move(statement));
        }
        if (at_ == before) ++at_;
    }
}

bool Parser::parse_statement(Statement& statement) {
    const Token first = token();
    if (take("EVERY_SCAN")) {
        statement.every_scan = true;
        statement.every_scan_span = first.span;
    }
    if (!parse_simple_statement(statement)) {
        recover();
        return false;
    }
    statement.span = span_since(first);
    end_statement();
    return true;
}

bool Parser::parse_target(ast::Name& name) {
    if (token().kind == TokenKind::number || at_symbol(";")) {
        error_here("the name of a step", "steps go by their names: NEXT := Idle;");
        return false;
    }
    if (!at("POWER_UP")) return expect_name(name, "the name of a step", ast::Role::step);
    name = name_of(token());
    ++at_;
    return true;
}

bool Parser::parse_simple_statement(Statement& statement) {
    if (take("NEXT")) {
        statement.kind = Statement::Kind::next;
        if (is_word_at(0)) {
            error_here("':=' after NEXT", fmt::format("write NEXT := {};", token().text));
        } else if ((at_symbol("-") || at_symbol("=")) && is_symbol_at(1, ">")) {
            error_here("':=' after NEXT", fmt::format("write NEXT := {};", token(2).text));
            at_ += 2;
        } else if (!expect_symbol(":=", "after NEXT")) {
            return false;
        }
        return parse_target(statement.name);
    }
    if (take("COUNT_DOWN")) {
        statement.kind = Statement::Kind::count_down;
        return true;
    }
    if (take("CLEAR_COUNTER")) {
        statement.kind = Statement::Kind::clear_counter;
        return true;
    }
    if (at("TIMER") || at("COUNTER")) {
        statement.kind = at("TIMER") ? Statement::Kind::timer : Statement::Kind::counter;
        const ForeignWord* usual = foreign_word(at("TIMER") ? "TON" : "CTU");
        ++at_;
        const bool is_preset = at_symbol(":=") || at_symbol("=");
        if (!is_preset || same_name(token(1).text, "COUNTER") || same_name(token(1).text, "TIMER")) {
            if (is_preset) ++at_;
            error_here(is_preset ? "a constant to preset it" : "':=' and a constant to preset it",
                       std::string(usual->help));
            return false;
        }
        return expect_symbol(":=", "to preset it, as in TIMER := T#500ms;") && parse_value(statement.value);
    }
    if (const auto sound = parse_named_statement(statement)) return *sound;
    if (take("REG")) {
        statement.kind = Statement::Kind::assign_number;
        return parse_register_number(statement.register_number) &&
               expect_symbol(":=", "after the register") && parse_value(statement.value);
    }
    if (refuse_time_as_statement() || refuse_foreign_word()) return false;
    if (token().kind == TokenKind::identifier && is_reserved(token().text)) {
        error_here("a statement", "statements are NEXT := Step; TIMER := T#1s; commands and register values");
        return false;
    }
    if (!expect_name(statement.name, "a statement", ast::Role::command)) return false;
    if (at_symbol(":=") || at_symbol("=")) uses_.back().role = ast::Role::register_name;
    if (refuse_state(statement)) return false;
    if (at_symbol(":=")) return parse_assignment(statement);
    if (at_equals()) {
        error_here(fmt::format("':=' after {}", statement.name.text), "write := with a colon");
        return parse_assignment(statement);
    }
    statement.kind = Statement::Kind::command;
    if (refuse_bare_arguments(statement)) return false;
    return !at_symbol("(") || parse_arguments(statement);
}

/// SET Clamp, Lamp;
bool Parser::parse_switched_outputs(Statement& statement) {
    statement.kind = at("SET") ? Statement::Kind::set_outputs : Statement::Kind::reset_outputs;
    statement.name = name_of(token());
    note_use(ast::Role::keyword, token().span);
    ++at_;
    if (refuse_set_of_value(statement)) return false;
    return parse_outputs(statement.arguments) && !refuse_condition_of_set(statement);
}

bool Parser::parse_assignment(Statement& statement) {
    ++at_;
    statement.kind = Statement::Kind::assign;
    return parse_value(statement.value) && !refuse_or_of_bits();
}

bool Parser::parse_arguments(Statement& statement) {
    ++at_;
    statement.has_arguments = true;
    if (take_symbol(")")) return true;
    do {
        note_place(ast::Role::register_name);
        if (token().kind != TokenKind::identifier && token().kind != TokenKind::number) {
            error_here("a register or a number");
            return false;
        }
        const Token first = token();
        if (is_symbol_at(1, ":=")) {
            const ForeignWord* word = foreign_word(statement.name.text.substr(0, 3));
            if (word == nullptr && same_name(first.text, "CLK")) word = foreign_word("R_TRIG");
            if (word == nullptr && same_name(statement.name.text, "SR")) word = foreign_word("SET");
            if (word == nullptr && same_name(statement.name.text, "RS")) word = foreign_word("SET");
            error_here("a register or a number", word != nullptr
                                                     ? std::string(word->help)
                                                     : "commands take registers, without names for them");
            while (!at_symbol(";") && !at_boundary()) ++at_;
            return false;
        }
        if (first.kind == TokenKind::number && is_word_at(1)) {
            ast::Value value;
            if (!parse_literal(value)) return false;
            report_.add("E050", span_since(first),
                        fmt::format("{} takes a register, not a value", upper(statement.name.text)),
                        fmt::format("name a register with this value in VAR_MOTOR, as in Place AT P1 := 80 "
                                    "mm; and write {}(Place)",
                                    upper(statement.name.text)));
            while (!at_symbol(")") && !at_symbol(";") && !at_boundary()) ++at_;
            return false;
        }
        statement.arguments.push_back(name_of(token()));
        if (first.kind == TokenKind::identifier) note_use(ast::Role::register_name, first.span);
        ++at_;
    } while (take_symbol(","));
    return expect_symbol(")", "to close the list");
}

bool Parser::parse_raw_term(std::vector<ast::RawTerm>& terms) {
    const Token first = token();
    ++at_;
    if (at_symbolic_term()) return parse_symbolic_term(first, terms);
    ast::RawTerm term;
    bool sound = true;
    do {
        ast::Value value;
        in_term_ = true;
        const bool is_value = parse_literal(value);
        in_term_ = false;
        if (!is_value) return false;
        const bool is_byte = value.number >= 0 && value.number <= 255 &&
                             std::floor(value.number) == value.number && value.unit.text.empty() &&
                             !value.is_time;
        if (!is_byte) {
            report_.add("E090", value.span, "this is not a byte", "write 0..255 or 16#00..16#FF");
            sound = false;
            continue;
        }
        term.bytes.push_back(static_cast<std::uint8_t>(value.number));
    } while (take_symbol(","));
    term.span = span_since(first);
    if (sound && term.bytes.size() != 8) {
        report_.add("E090", term.span, fmt::format("a term has 8 bytes, here are {}", term.bytes.size()),
                    "write all eight: STATE, INPUT, CARE, NEXT_STATE and four bytes more (001 §6.1)");
        sound = false;
    }
    if (sound) terms.push_back(std::move(term));
    end_statement();
    return true;
}

}  // namespace nplc::seqc
