#include "syntax/parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "syntax/names.h"

namespace nplc::seqc {
namespace {

constexpr std::array kReserved = {
    std::string_view("PROGRAM"),    std::string_view("END_PROGRAM"),   std::string_view("MOTOR"),
    std::string_view("SCALE"),      std::string_view("VAR_INPUT"),     std::string_view("VAR_OUTPUT"),
    std::string_view("VAR_MOTOR"),  std::string_view("END_VAR"),       std::string_view("AT"),
    std::string_view("ON"),         std::string_view("ERROR"),         std::string_view("NEXT"),
    std::string_view("POWER_UP"),   std::string_view("END_POWER_UP"),  std::string_view("STEP"),
    std::string_view("END_STEP"),   std::string_view("OUT"),           std::string_view("WHEN"),
    std::string_view("ENTRY"),      std::string_view("OWN"),           std::string_view("IF"),
    std::string_view("THEN"),       std::string_view("ELSIF"),         std::string_view("ELSE"),
    std::string_view("END_IF"),     std::string_view("AND"),           std::string_view("OR"),
    std::string_view("NOT"),        std::string_view("XOR"),           std::string_view("TRUE"),
    std::string_view("FALSE"),      std::string_view("INPOS"),         std::string_view("ANY"),
    std::string_view("TIMER"),      std::string_view("COUNTER"),       std::string_view("EVERY_SCAN"),
    std::string_view("COUNT_DOWN"), std::string_view("CLEAR_COUNTER"), std::string_view("TERM"),
    std::string_view("REG"),
};

/// Words that begin something on the level above a statement: skipping stops in front of them.
constexpr std::array kBoundaries = {
    std::string_view("END_PROGRAM"), std::string_view("MOTOR"),      std::string_view("SCALE"),
    std::string_view("VAR_INPUT"),   std::string_view("VAR_OUTPUT"), std::string_view("VAR_MOTOR"),
    std::string_view("END_VAR"),     std::string_view("POWER_UP"),   std::string_view("END_POWER_UP"),
    std::string_view("STEP"),        std::string_view("END_STEP"),   std::string_view("IF"),
    std::string_view("ELSIF"),       std::string_view("ELSE"),       std::string_view("END_IF"),
};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, std::string_view word) {
    return std::any_of(words.begin(), words.end(), [&](std::string_view w) { return same_name(w, word); });
}

std::string shown(const Token& t) {
    if (t.kind == TokenKind::end) return "the end of the file";
    return t.text.size() <= 40 ? fmt::format("'{}'", t.text) : fmt::format("'{}...'", t.text.substr(0, 37));
}

}  // namespace

bool is_reserved(std::string_view word) {
    return contains(kReserved, word);
}

bool is_name(std::string_view text) {
    constexpr std::size_t kLongest = 60;
    if (text.empty() || text.size() > kLongest || (text[0] >= '0' && text[0] <= '9') || is_reserved(text))
        return false;
    return std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    });
}

const Token& Parser::token(std::size_t ahead) const {
    return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
}

bool Parser::at(std::string_view word) const {
    return token().kind == TokenKind::identifier && same_name(token().text, word);
}

bool Parser::at_symbol(std::string_view symbol) const {
    return token().kind == TokenKind::symbol && token().text == symbol;
}

bool Parser::take(std::string_view word) {
    if (!at(word)) return false;
    ++at_;
    return true;
}

bool Parser::take_symbol(std::string_view symbol) {
    if (!at_symbol(symbol)) return false;
    ++at_;
    return true;
}

void Parser::error_here(std::string_view expected, std::string help) {
    if (in_open_comment()) return;
    report_.error("E010", token().span, fmt::format("expected {}, found {}", expected, shown(token())),
                  std::move(help));
}

bool Parser::expect(std::string_view word, std::string_view where) {
    if (take(word)) return true;
    error_here(fmt::format("{} {}", word, where));
    return false;
}

bool Parser::expect_symbol(std::string_view symbol, std::string_view where) {
    if (take_symbol(symbol)) return true;
    error_here(fmt::format("'{}' {}", symbol, where));
    return false;
}

bool Parser::expect_name(ast::Name& name, std::string_view what) {
    if (token().kind != TokenKind::identifier) {
        error_here(what);
        return false;
    }
    name = name_of(token());
    if (is_reserved(name.text)) {
        report_.error("E011", name.span,
                      fmt::format("'{}' is a word of the language, not {}", name.text, what),
                      "choose another name");
        return false;
    }
    ++at_;
    return true;
}

Span Parser::span_since(const Token& first) const {
    const Token& last = tokens_[at_ == 0 ? 0 : at_ - 1];
    const std::uint32_t end =
        std::max(first.span.offset + first.span.length, last.span.offset + last.span.length);
    return {first.span.offset, end - first.span.offset};
}

/// A missing semicolon is reported where it belongs, and reading goes on as if it stood there.
void Parser::end_statement() {
    if (take_symbol(";") || in_open_comment()) return;
    const Token& last = tokens_[at_ == 0 ? 0 : at_ - 1];
    report_.error("E010", {last.span.offset + last.span.length, 1},
                  fmt::format("expected ';' before {}", shown(token())),
                  "every statement ends with a semicolon");
    if (token().kind == TokenKind::identifier && token().span.offset > 0 && !at("ERROR")) return;
    recover();
}

bool Parser::at_boundary() const {
    return token().kind == TokenKind::end ||
           (token().kind == TokenKind::identifier && contains(kBoundaries, token().text));
}

void Parser::recover() {
    while (!at_boundary()) {
        if (take_symbol(";")) return;
        ++at_;
    }
}

bool Parser::at_block_end(std::string_view end_word) const {
    return token().kind == TokenKind::end || at(end_word) || at("END_PROGRAM");
}

void Parser::end_block(std::string_view end_word, Span opened) {
    if (take(end_word)) {
        take_symbol(";");
        return;
    }
    if (in_open_comment()) return;
    Diagnostic& d =
        report_.error("E012", token().span, fmt::format("expected {}, found {}", end_word, shown(token())));
    d.notes.push_back({opened, "it would close what begins here"});
}

ast::Program Parser::parse() {
    ast::Program program;
    const Span opened = token().span;
    program.steps_missing = comment_is_open_;
    if (token().kind == TokenKind::end) {
        if (!report_.has_errors())
            report_.error("E010", opened, "the file holds no program", "write PROGRAM Name ... END_PROGRAM");
        return program;
    }
    if (expect("PROGRAM", "at the start")) {
        if (!expect_name(program.name, "the program's name")) recover();
        take_symbol(";");
    }
    while (token().kind != TokenKind::end && !at("END_PROGRAM") && !report_.full()) parse_item(program);
    end_block("END_PROGRAM", opened);
    if (token().kind != TokenKind::end && !report_.full()) {
        report_.error("E010", token().span, fmt::format("{} stands after END_PROGRAM", shown(token())),
                      "a file holds one program");
    }
    return program;
}

void Parser::parse_item(ast::Program& program) {
    if (take_symbol(";") || (program.steps_missing && take("END_STEP"))) return;
    if (take("MOTOR")) {
        ast::Name motor;
        if (!expect_name(motor, "the motor, such as MAC140")) return recover();
        if (program.motor) report_.error("E020", motor.span, "MOTOR stands twice", "keep one of the two");
        program.motor = motor;
        return end_statement();
    }
    if (at("SCALE")) return parse_scale(program);
    if (at("ON")) return parse_on_error(program);
    if (take("VAR_INPUT")) return parse_variables(program.inputs, false);
    if (take("VAR_OUTPUT")) return parse_variables(program.outputs, false);
    if (take("VAR_MOTOR")) return parse_variables(program.motor_variables, true);
    if (at("POWER_UP")) return parse_power_up(program);
    if (at("STEP")) return parse_step(program);
    if (at("TERM")) {
        if (!parse_raw_term(program.terms)) recover();
        return;
    }
    error_here(
        "MOTOR, SCALE, VAR_INPUT, VAR_OUTPUT, VAR_MOTOR, ON ERROR, POWER_UP, STEP, TERM or END_PROGRAM",
        suggestion(token().text, {"MOTOR", "SCALE", "VAR_INPUT", "VAR_OUTPUT", "VAR_MOTOR", "POWER_UP",
                                  "STEP", "TERM", "END_PROGRAM"}));
    program.steps_missing = true;
    const std::size_t before = at_;
    recover();
    if (at_ == before) ++at_;
}

void Parser::parse_scale(ast::Program& program) {
    const Token first = token();
    ++at_;
    ast::Scale scale;
    ast::Value left;
    ast::Value right;
    if (!parse_value(left) || !expect_symbol("=", "in SCALE, as in SCALE 1 rev = 5 mm;") ||
        !parse_value(right)) {
        return recover();
    }
    scale.span = span_since(first);
    scale.revolutions = left.number;
    scale.length = right.number;
    scale.unit = right.unit;
    const bool sound = same_name(left.unit.text, "rev") && !right.unit.text.empty() && left.number > 0 &&
                       right.number > 0 && !left.is_raw && !right.is_raw && !left.is_time && !right.is_time &&
                       right.unit.text.find_first_of("/%") == std::string_view::npos;
    if (!sound) {
        report_.error("E032", scale.span, "SCALE must say how far the machine moves in some revolutions",
                      "write it as SCALE 1 rev = 5 mm;");
    } else if (program.scale) {
        report_.error("E020", scale.span, "SCALE stands twice", "keep one of the two");
    } else {
        program.scale = scale;
    }
    end_statement();
}

void Parser::parse_on_error(ast::Program& program) {
    const Token first = token();
    ++at_;
    ast::Name step;
    if (!expect("ERROR", "after ON, as in ON ERROR NEXT := Fault;") || !expect("NEXT", "after ON ERROR") ||
        !expect_symbol(":=", "after NEXT") || !expect_name(step, "the name of the fault step")) {
        return recover();
    }
    if (program.on_error)
        report_.error("E020", span_since(first), "ON ERROR stands twice", "keep one of the two");
    program.on_error = step;
    end_statement();
}

void Parser::parse_variables(std::vector<ast::Variable>& variables, bool motor) {
    const Span opened = tokens_[at_ - 1].span;
    const auto declares = [&] {
        return token(1).kind == TokenKind::identifier && same_name(token(1).text, "AT");
    };
    while (!at_block_end("END_VAR") && (!at_boundary() || declares()) && !report_.full()) {
        if (take_symbol(";")) continue;
        const std::size_t before = at_;
        parse_variable(variables, motor);
        if (at_ == before) break;
    }
    end_block("END_VAR", opened);
}

void Parser::parse_variable(std::vector<ast::Variable>& variables, bool motor) {
    ast::Variable variable;
    if (!expect_name(variable.name, "the name of a variable")) {
        if (token().kind == TokenKind::identifier) ++at_;
        return recover();
    }
    if (!expect("AT", motor ? "and a register, as in AT P1" : "and an address, as in AT %IX0.0"))
        return recover();
    if (motor && take("REG")) {
        if (!parse_register_number(variable.register_number)) return recover();
    } else if (token().kind == TokenKind::direct || token().kind == TokenKind::identifier) {
        variable.address = name_of(token());
        ++at_;
    } else {
        error_here(motor ? "a register, such as P1 or V_SOLL" : "an address, such as %IX0.0 or IN0");
        return recover();
    }
    if (!motor && take_symbol(":") && !expect("BOOL", "as the type")) return recover();
    if (motor && take_symbol(":=")) {
        variable.value.emplace();
        if (!parse_value(*variable.value)) return recover();
    }
    variables.push_back(variable);
    end_statement();
}

void Parser::parse_step(ast::Program& program) {
    const Span opened = token().span;
    ++at_;
    ast::Step step;
    if (!expect_name(step.name, "the step's name")) {
        step.name = {"", opened};
        program.steps_missing = true;
        if (!at_boundary()) ++at_;
    }
    if (take("AT")) {
        step.number.emplace();
        if (!parse_value(*step.number)) step.number.reset();
    }
    if (!take_symbol(":")) error_here("':' after the step's name");
    parse_step_body(step, "END_STEP");
    end_block("END_STEP", opened);
    if (!step.name.text.empty()) program.steps.push_back(std::move(step));
}

void Parser::parse_power_up(ast::Program& program) {
    const Token first = token();
    ++at_;
    take_symbol(":");
    ast::Step step;
    step.name = name_of(first);
    parse_step_body(step, "END_POWER_UP");
    end_block("END_POWER_UP", first.span);
    if (program.power_up)
        report_.error("E020", first.span, "POWER_UP stands twice", "put all of it into one");
    program.power_up = std::move(step);
}

void Parser::parse_step_body(ast::Step& step, std::string_view end_word) {
    while (!at_block_end(end_word) && !at("STEP") && !at("POWER_UP") && !at("END_STEP") && !report_.full()) {
        const std::size_t before = at_;
        if (take_symbol(";")) continue;
        if (at("OUT")) {
            parse_out(step);
        } else if (take("OWN")) {
            step.own_error = true;
            step.own_error_span = tokens_[at_ - 1].span;
            if (expect("ERROR", "after OWN")) end_statement();
        } else if (take("ENTRY")) {
            ast::Statement statement;
            if (parse_statement(statement)) step.entry.push_back(std::move(statement));
        } else if (at("TERM")) {
            if (!parse_raw_term(step.terms)) recover();
        } else if (at("IF")) {
            ast::Choice choice;
            if (parse_if(choice)) step.choices.push_back(std::move(choice));
        } else {
            ast::Statement statement;
            if (parse_statement(statement)) {
                if (step.choices.empty() || !step.choices.back().bare) {
                    step.choices.push_back({{ast::Branch{{}, statement.span, {}}}, true});
                }
                step.choices.back().branches.front().statements.push_back(std::move(statement));
            }
        }
        if (at_ == before) ++at_;
    }
}

bool Parser::parse_outputs(std::vector<ast::Name>& outputs) {
    do {
        if (token().kind == TokenKind::direct) {
            outputs.push_back(name_of(token()));
            ++at_;
            continue;
        }
        ast::Name name;
        if (!expect_name(name, "the name of an output")) return false;
        outputs.push_back(name);
    } while (take_symbol(","));
    return true;
}

void Parser::parse_out(ast::Step& step) {
    const Token first = token();
    ++at_;
    std::vector<ast::Name> outputs;
    if (!parse_outputs(outputs)) return recover();
    if (take("WHEN")) {
        ast::ConditionalOutput conditional;
        conditional.outputs = std::move(outputs);
        if (!parse_expression(conditional.condition)) return recover();
        conditional.span = span_since(first);
        step.conditional.push_back(std::move(conditional));
    } else {
        step.outputs.insert(step.outputs.end(), outputs.begin(), outputs.end());
    }
    end_statement();
}

}  // namespace nplc::seqc
