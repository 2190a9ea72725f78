#include "language/statement_parser.h"

#include <fmt/format.h>

#include <utility>

#include "language/foreign_words.h"
#include "language/names.h"
#include "language/reserved_words.h"
#include "language/statement_mistakes.h"
#include "language/step_mistakes.h"

namespace nplc::seqc {
namespace {

using ast::Statement;

/// RESET ERROR; is accepted as intended.
bool parse_split_reset(TokenStream& in, ast::Statement& statement) {
    const Token first = in.token();
    in.skip(2);
    in.report().add("E010", in.span_since(first), "RESET_ERROR is one word", "write RESET_ERROR;");
    statement.kind = ast::Statement::Kind::command;
    statement.name = {"RESET_ERROR", in.span_since(first)};
    return true;
}

void refuse_every_scan(TokenStream& in, const ast::Statement& statement, std::string_view word) {
    if (!statement.every_scan) return;
    in.report().add("E064", statement.every_scan_span, fmt::format("EVERY_SCAN does not go with {}", word),
                    "leave it out");
}

/// The := behind NEXT; another sign in its place is reported.
bool take_assignment_of_next(TokenStream& in) {
    if (in.at_symbol(":") && in.is_word_at(1)) {
        in.error_here("':=' after NEXT", fmt::format("write NEXT := {};", in.token(1).text));
        in.skip();
    } else if (in.is_word_at(0)) {
        in.error_here("':=' after NEXT", fmt::format("write NEXT := {};", in.token().text));
    } else if ((in.at_symbol("-") || in.at_symbol("=")) && in.is_symbol_at(1, ">")) {
        in.error_here("':=' after NEXT", fmt::format("write NEXT := {};", in.token(2).text));
        in.skip(2);
    } else {
        return in.expect_symbol(":=", "after NEXT");
    }
    return true;
}

}  // namespace

bool StatementParser::parse(Statement& statement) {
    const Token first = in_.token();
    if (in_.take("EVERY_SCAN")) {
        statement.every_scan = true;
        statement.every_scan_span = first.span;
        if (in_.at_symbol(";")) {
            in_.error_here(
                "a statement",
                "EVERY_SCAN stands before the statement that it is about, as in EVERY_SCAN COUNT_DOWN;");
            in_.skip();
            return false;
        }
    }
    if (!parse_simple(statement)) {
        in_.recover();
        return false;
    }
    statement.span = in_.span_since(first);
    in_.end_statement();
    return true;
}

bool StatementParser::parse_target(ast::Name& name) {
    if (take_digits_first(in_, name)) return true;
    if (same_name(in_.token().text, "STEP") && in_.is_word_at(1)) {
        in_.report().add("E010", in_.token().span, "NEXT takes the step's name alone",
                         fmt::format("write NEXT := {};", in_.token(1).text));
        in_.skip();
    }
    if (in_.token().kind == TokenKind::number || in_.at_symbol(";")) {
        in_.error_here("the name of a step", "steps go by their names: NEXT := Idle;");
        return false;
    }
    if (!in_.at("POWER_UP")) return notes_.expect_name(name, "the name of a step", ast::Role::step);
    name = name_of(in_.token());
    in_.skip();
    return true;
}

bool StatementParser::parse_outputs(std::vector<ast::Name>& outputs) {
    do {
        if (in_.token().kind == TokenKind::direct) {
            outputs.push_back(name_of(in_.token()));
            notes_.add_use(ast::Role::address, in_.token().span);
            in_.skip();
            continue;
        }
        ast::Name name;
        if (!notes_.expect_name(name, "the name of an output", ast::Role::output)) return false;
        if (in_.at_symbol(".") && in_.token(1).kind == TokenKind::number) {
            in_.report().add("E010", name.span, "outputs have no dot in their names",
                             "outputs are OUT0 to OUT3, and the names of VAR_OUTPUT");
            return false;
        }
        outputs.push_back(name);
    } while (in_.take_symbol(","));
    return true;
}

bool StatementParser::parse_simple(Statement& statement) {
    if (in_.take("NEXT")) {
        statement.kind = Statement::Kind::next;
        if (!take_assignment_of_next(in_)) return false;
        return parse_target(statement.name);
    }
    if (in_.take("COUNT_DOWN")) {
        statement.kind = Statement::Kind::count_down;
        if (in_.token().kind == TokenKind::number)
            in_.error_here("';'", "COUNT_DOWN; takes one off, and nothing stands behind it");
        return in_.token().kind != TokenKind::number;
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
               values_.parse(statement.value);
    }
    if (const auto sound = parse_named(statement)) return *sound;
    if (in_.take("REG")) {
        statement.kind = Statement::Kind::assign_number;
        return values_.parse_register_number(statement.register_number) &&
               in_.expect_symbol(":=", "after the register") && values_.parse(statement.value);
    }
    if (refuse_time_as_statement(in_) || refuse_switch_without_name(in_) || refuse_foreign_word(in_) ||
        refuse_qualifier(in_) || refuse_no_statement(in_))
        return false;
    if (!notes_.expect_name(statement.name, "a statement", ast::Role::command)) return false;
    if (in_.at_symbol(":=") || in_.at_symbol("=")) notes_.set_last_role(ast::Role::register_name);
    if (refuse_state(in_, notes_, statement)) return false;
    const bool assigns = in_.at_symbol(":=") || in_.at_symbol("=");
    if ((assigns && refuse_level(in_, statement)) || refuse_reckoning(in_, statement)) return false;
    if (in_.at_symbol(":=")) return parse_assignment(statement);
    if (in_.at_equals()) {
        in_.error_here(fmt::format("':=' after {}", statement.name.text), "write := with a colon");
        return parse_assignment(statement);
    }
    statement.kind = Statement::Kind::command;
    if (refuse_bare_arguments(in_, statement)) return false;
    return !in_.at_symbol("(") || parse_arguments(statement);
}

/// A statement whose keyword can be a name elsewhere: CALL, RETURN, SET, RESET. Empty: another statement.
std::optional<bool> StatementParser::parse_named(ast::Statement& statement) {
    if (in_.at("CALL") && in_.is_word_at(1)) return parse_call(statement);
    if (in_.at("RETURN") && in_.is_symbol_at(1, ";")) {
        notes_.add_use(ast::Role::keyword, in_.token().span);
        in_.skip();
        notes_.note_call();
        refuse_every_scan(in_, statement, "RETURN");
        statement.kind = ast::Statement::Kind::go_back;
        return true;
    }
    if (in_.at("RESET") && same_name(in_.token(1).text, "ERROR")) return parse_split_reset(in_, statement);
    if ((in_.at("SET") || in_.at("RESET")) && (in_.is_word_at(1) || in_.token(1).kind == TokenKind::direct))
        return parse_switched_outputs(statement);
    if (in_.is_symbol_at(1, "(") && notes_.is_sequence(in_.token().text)) {
        in_.report().add("E010", in_.token().span,
                         fmt::format("'{}' is a SEQUENCE, which CALL goes through", in_.token().text),
                         fmt::format("write CALL {}(..); NEXT := Step;", in_.token().text));
        return parse_called(statement);
    }
    return std::nullopt;
}

/// SET Clamp, Lamp;
bool StatementParser::parse_switched_outputs(Statement& statement) {
    statement.kind = in_.at("SET") ? Statement::Kind::set_outputs : Statement::Kind::reset_outputs;
    statement.name = name_of(in_.token());
    notes_.add_use(ast::Role::keyword, in_.token().span);
    in_.skip();
    if (refuse_set_of_value(in_, statement)) return false;
    return parse_outputs(statement.arguments) && !refuse_condition_of_set(in_, statement);
}

bool StatementParser::parse_assignment(Statement& statement) {
    in_.skip();
    statement.kind = Statement::Kind::assign;
    return values_.parse(statement.value) && !refuse_or_of_bits(in_);
}

bool StatementParser::parse_arguments(Statement& statement) {
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
            if (!values_.parse_literal(value)) return false;
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

/// CALL Close(Clamp, Clamped, T#800ms, Fault)
bool StatementParser::parse_call(ast::Statement& statement) {
    notes_.add_use(ast::Role::keyword, in_.token().span);
    in_.skip();
    refuse_every_scan(in_, statement, "CALL");
    return parse_called(statement);
}

bool StatementParser::parse_called(ast::Statement& statement) {
    statement.kind = ast::Statement::Kind::call;
    notes_.note_call();
    if (!notes_.expect_name(statement.name, "the name of a SEQUENCE", ast::Role::sequence)) return false;
    if (!in_.take_symbol("(") || in_.take_symbol(")")) return true;
    do {
        if (!parse_call_argument(statement.call)) return false;
    } while (in_.take_symbol(","));
    return in_.expect_symbol(")", "to close the list");
}

bool StatementParser::parse_call_argument(std::vector<ast::Argument>& arguments) {
    ast::Argument argument;
    const Token first = in_.token();
    if (in_.is_word_at(0) && in_.is_symbol_at(1, ":=")) {
        in_.report().add("E067", first.span, "arguments stand without the parameters' names, in their order",
                         "write CALL Close(Clamp, Clamped, T#800ms);");
        while (!in_.at_symbol(")") && !in_.at_symbol(";") && !in_.at_boundary()) in_.skip();
        return false;
    }
    for (const ast::Role role : {ast::Role::tested, ast::Role::output, ast::Role::step}) in_.note_place(role);
    const bool is_alone = in_.is_symbol_at(1, ",") || in_.is_symbol_at(1, ")");
    if (is_alone && (first.kind == TokenKind::direct || in_.is_word_at(0) || in_.at("POWER_UP"))) {
        argument.name = name_of(first);
        if (!in_.at("POWER_UP")) {
            notes_.add_use(first.kind == TokenKind::direct ? ast::Role::address : ast::Role::argument,
                           first.span);
        }
        in_.skip();
    } else {
        argument.value.emplace();
        if (!values_.parse(*argument.value)) return false;
    }
    argument.span = in_.span_since(first);
    argument.text = in_.text_of(argument.span);
    arguments.push_back(std::move(argument));
    return true;
}

}  // namespace nplc::seqc
