#include <fmt/format.h>

#include <cmath>

#include "language/foreign_words.h"
#include "language/names.h"
#include "language/parser.h"
#include "language/reserved_words.h"

namespace nplc::seqc {
namespace {

using ast::Statement;

}  // namespace

bool Parser::parse_if(ast::Choice& choice) {
    const Span opened = in_.token().span;
    bool last = false;
    std::size_t ends_too_many = 0;
    do {
        ast::Branch branch;
        branch.span = in_.token().span;
        if (in_.at("ELSE") && same_name(in_.token(1).text, "IF")) {
            const Token first = in_.token();
            in_.skip();
            ++ends_too_many;
            in_.report().add("E010", {first.span.offset, in_.token().span.offset + 2 - first.span.offset},
                             "an IF cannot stand inside another: ELSE IF is the word ELSIF",
                             "write ELSIF, and one END_IF for all of it");
        }
        last = in_.at("ELSE") && !refuse_else_with_condition();
        in_.skip();
        if (!last) {
            branch.condition.emplace();
            if (!parse_expression(*branch.condition)) {
                branch.condition->kind = ast::Expression::Kind::constant;
                while (!in_.at("THEN") && !in_.at_boundary() && !in_.at_symbol(";")) in_.skip();
            }
            parse_timing(branch, choice.branches.empty());
            take_then();
        }
        parse_branch_body(branch, opened);
        choice.branches.push_back(std::move(branch));
    } while (!last && (in_.at("ELSIF") || in_.at("ELSE")));
    const ast::Branch& first = choice.branches.front();
    if (!last && first.timing && first.timing->is_limit) {
        in_.report()
            .add("E010", in_.place_here(), "WITHIN needs an ELSE: what happens when the time has passed",
                 "write ELSE NEXT := Step; before END_IF")
            .notes.push_back({first.timing->span, "the time limit is here"});
    }
    notes_.end_block("END_IF", opened);
    for (; ends_too_many > 0 && in_.take("END_IF"); --ends_too_many) in_.take_symbol(";");
    return true;
}

/// WITHIN belongs to the whole IF, FOR to its condition.
void Parser::parse_timing(ast::Branch& branch, bool is_first) {
    const Token first = in_.token();
    const bool is_limit = in_.take("WITHIN");
    if (!is_limit && !in_.take("FOR")) return;
    ast::Timing timing;
    timing.is_limit = is_limit;
    if (!expect_time(timing.time, is_limit ? "WITHIN" : "FOR")) {
        while (!in_.at("THEN") && !in_.at_boundary() && !in_.at_symbol(";")) in_.skip();
        return;
    }
    timing.span = in_.span_since(first);
    if (is_limit && !is_first) {
        in_.report().add("E010", timing.span, "WITHIN stands behind the condition of IF, not of ELSIF",
                         "it is the time limit of the whole IF: write it there");
        return;
    }
    branch.timing = std::move(timing);
}

/// Extra text between the condition and THEN is reported as one error.
void Parser::take_then() {
    if (in_.take("THEN") || (in_.mend({"THEN"}, "THEN after the condition") && in_.take("THEN"))) return;
    if (in_.at_symbol(";") && same_name(in_.token(1).text, "THEN")) {
        in_.report().add("E010", in_.token().span, "no ';' stands between a condition and THEN",
                         "leave it out");
        in_.skip(2);
        return;
    }
    in_.error_here("THEN after the condition",
                   in_.at_symbol(")") ? "there is no '(' for this ')'"
                                      : "write IF condition THEN; AND, OR and XOR join two conditions");
    if (in_.take_symbol(":")) return;
    const std::size_t before = in_.position();
    while (!in_.at("THEN") && !in_.at_boundary() && !in_.at_symbol(";")) in_.skip();
    if (!in_.take("THEN")) in_.return_to(before);
}

void Parser::parse_branch_body(ast::Branch& branch, Span opened) {
    while (!in_.at("ELSIF") && !in_.at("ELSE") && !in_.at("END_STEP") && !in_.at("STEP") &&
           !in_.at("POWER_UP") && !in_.at("END_POWER_UP") && !in_.at("END_SEQUENCE") &&
           !in_.at_block_end("END_IF") && !in_.report().full()) {
        if (in_.take_symbol(";")) continue;
        const std::size_t before = in_.position();
        mend_statement({"ELSIF", "ELSE", "END_IF"});
        if (in_.at("ELSIF") || in_.at("ELSE") || in_.at("END_IF")) break;
        if (in_.at("IF")) {
            ast::Choice inner;
            in_.report()
                .add("E064", in_.token().span, "an IF cannot stand inside another",
                     "join the two conditions with AND, or use ELSIF")
                .notes.push_back({opened, "the outer IF begins here"});
            parse_if(inner);
        } else if (refuse_item_inside()) {
            continue;
        } else if (in_.at("OUT")) {
            in_.report().add("E064", in_.token().span, "OUT cannot stand inside an IF",
                             "outputs belong to the step: write OUT Name WHEN condition; beside the IF");
            in_.recover();
        } else {
            Statement statement;
            if (parse_statement(statement)) branch.statements.push_back(std::move(statement));
        }
        if (in_.position() == before) in_.skip();
    }
}

bool Parser::parse_statement(Statement& statement) {
    const Token first = in_.token();
    if (in_.take("EVERY_SCAN")) {
        statement.every_scan = true;
        statement.every_scan_span = first.span;
    }
    if (!parse_simple_statement(statement)) {
        in_.recover();
        return false;
    }
    statement.span = in_.span_since(first);
    in_.end_statement();
    return true;
}

bool Parser::parse_target(ast::Name& name) {
    if (in_.token().kind == TokenKind::number || in_.at_symbol(";")) {
        in_.error_here("the name of a step", "steps go by their names: NEXT := Idle;");
        return false;
    }
    if (!in_.at("POWER_UP")) return notes_.expect_name(name, "the name of a step", ast::Role::step);
    name = name_of(in_.token());
    in_.skip();
    return true;
}

bool Parser::parse_simple_statement(Statement& statement) {
    if (in_.take("NEXT")) {
        statement.kind = Statement::Kind::next;
        if (in_.is_word_at(0)) {
            in_.error_here("':=' after NEXT", fmt::format("write NEXT := {};", in_.token().text));
        } else if ((in_.at_symbol("-") || in_.at_symbol("=")) && in_.is_symbol_at(1, ">")) {
            in_.error_here("':=' after NEXT", fmt::format("write NEXT := {};", in_.token(2).text));
            in_.skip(2);
        } else if (!in_.expect_symbol(":=", "after NEXT")) {
            return false;
        }
        return parse_target(statement.name);
    }
    if (in_.take("COUNT_DOWN")) {
        statement.kind = Statement::Kind::count_down;
        return true;
    }
    if (in_.take("CLEAR_COUNTER")) {
        statement.kind = Statement::Kind::clear_counter;
        return true;
    }
    if (in_.at("TIMER") || in_.at("COUNTER")) {
        statement.kind = in_.at("TIMER") ? Statement::Kind::timer : Statement::Kind::counter;
        const ForeignWord* usual = foreign_word(in_.at("TIMER") ? "TON" : "CTU");
        in_.skip();
        const bool is_preset = in_.at_symbol(":=") || in_.at_symbol("=");
        if (!is_preset || same_name(in_.token(1).text, "COUNTER") || same_name(in_.token(1).text, "TIMER")) {
            if (is_preset) in_.skip();
            in_.error_here(is_preset ? "a constant to preset it" : "':=' and a constant to preset it",
                           std::string(usual->help));
            return false;
        }
        return in_.expect_symbol(":=", "to preset it, as in TIMER := T#500ms;") &&
               parse_value(statement.value);
    }
    if (const auto sound = parse_named_statement(statement)) return *sound;
    if (in_.take("REG")) {
        statement.kind = Statement::Kind::assign_number;
        return parse_register_number(statement.register_number) &&
               in_.expect_symbol(":=", "after the register") && parse_value(statement.value);
    }
    if (refuse_time_as_statement() || refuse_foreign_word()) return false;
    if (in_.token().kind == TokenKind::identifier && is_reserved(in_.token().text)) {
        in_.error_here("a statement",
                       "statements are NEXT := Step; TIMER := T#1s; commands and register values");
        return false;
    }
    if (!notes_.expect_name(statement.name, "a statement", ast::Role::command)) return false;
    if (in_.at_symbol(":=") || in_.at_symbol("=")) notes_.set_last_role(ast::Role::register_name);
    if (refuse_state(statement)) return false;
    if (in_.at_symbol(":=")) return parse_assignment(statement);
    if (in_.at_equals()) {
        in_.error_here(fmt::format("':=' after {}", statement.name.text), "write := with a colon");
        return parse_assignment(statement);
    }
    statement.kind = Statement::Kind::command;
    if (refuse_bare_arguments(statement)) return false;
    return !in_.at_symbol("(") || parse_arguments(statement);
}

/// SET Clamp, Lamp;
bool Parser::parse_switched_outputs(Statement& statement) {
    statement.kind = in_.at("SET") ? Statement::Kind::set_outputs : Statement::Kind::reset_outputs;
    statement.name = name_of(in_.token());
    notes_.add_use(ast::Role::keyword, in_.token().span);
    in_.skip();
    if (refuse_set_of_value(statement)) return false;
    return parse_outputs(statement.arguments) && !refuse_condition_of_set(statement);
}

bool Parser::parse_assignment(Statement& statement) {
    in_.skip();
    statement.kind = Statement::Kind::assign;
    return parse_value(statement.value) && !refuse_or_of_bits();
}

bool Parser::parse_arguments(Statement& statement) {
    in_.skip();
    statement.has_arguments = true;
    if (in_.take_symbol(")")) return true;
    do {
        in_.note_place(ast::Role::register_name);
        if (in_.token().kind != TokenKind::identifier && in_.token().kind != TokenKind::number) {
            in_.error_here("a register or a number");
            return false;
        }
        const Token first = in_.token();
        if (in_.is_symbol_at(1, ":=")) {
            const ForeignWord* word = foreign_word(statement.name.text.substr(0, 3));
            if (word == nullptr && same_name(first.text, "CLK")) word = foreign_word("R_TRIG");
            if (word == nullptr && same_name(statement.name.text, "SR")) word = foreign_word("SET");
            if (word == nullptr && same_name(statement.name.text, "RS")) word = foreign_word("SET");
            in_.error_here("a register or a number", word != nullptr
                                                         ? std::string(word->help)
                                                         : "commands take registers, without names for them");
            while (!in_.at_symbol(";") && !in_.at_boundary()) in_.skip();
            return false;
        }
        if (first.kind == TokenKind::number && in_.is_word_at(1)) {
            ast::Value value;
            if (!parse_literal(value)) return false;
            in_.report().add(
                "E050", in_.span_since(first),
                fmt::format("{} takes a register, not a value", upper(statement.name.text)),
                fmt::format("name a register with this value in VAR_MOTOR, as in Place AT P1 := 80 "
                            "mm; and write {}(Place)",
                            upper(statement.name.text)));
            while (!in_.at_symbol(")") && !in_.at_symbol(";") && !in_.at_boundary()) in_.skip();
            return false;
        }
        statement.arguments.push_back(name_of(in_.token()));
        if (first.kind == TokenKind::identifier) notes_.add_use(ast::Role::register_name, first.span);
        in_.skip();
    } while (in_.take_symbol(","));
    return in_.expect_symbol(")", "to close the list");
}

bool Parser::parse_raw_term(std::vector<ast::RawTerm>& terms) {
    const Token first = in_.token();
    in_.skip();
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

}  // namespace nplc::seqc
