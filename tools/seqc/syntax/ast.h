#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "seqc/diagnostic.h"

/// The program as written, names not yet resolved. All text points into the source or `Program::texts`.
namespace nplc::seqc::ast {

struct Name {
    std::string_view text;
    Span span;
};

struct Expression {
    enum class Kind : std::uint8_t {
        constant,
        name,
        in_pos,
        error,
        any_error,
        timer_q,
        counter_q,
        negation,
        all_of,
        any_of,
        odd_of,
    };
    Kind kind = Kind::constant;
    Span span;
    Name name;           ///< Kind::name
    bool value = false;  ///< Kind::constant
    std::vector<Expression> operands;
};

struct Value {
    Span span;
    double number = 0;
    bool is_raw = false;   ///< 16#..., taken as the register's bits
    bool is_time = false;  ///< T#..., `number` is in milliseconds
    Name unit;             ///< empty text: none
};

struct Statement {
    enum class Kind : std::uint8_t {
        next,
        command,
        assign,
        assign_number,
        timer,
        counter,
        count_down,
        clear_counter
    };
    Kind kind = Kind::command;
    Span span;
    Name name;  ///< step, command or register
    std::vector<Name> arguments;
    bool has_arguments = false;  ///< parentheses were written
    Value value;
    std::optional<Value> register_number;  ///< Kind::assign_number
    bool every_scan = false;
    Span every_scan_span;
};

struct Branch {
    std::optional<Expression> condition;  ///< none: ELSE, or statements without IF
    Span span;
    std::vector<Statement> statements;
};

/// One IF with its ELSIFs and ELSE, or a run of statements without IF.
struct Choice {
    std::vector<Branch> branches;
    bool bare = false;
};

/// TERM IF condition THEN statements END_IF;
struct SymbolicTerm {
    Name step;  ///< empty text: that of the step it stands in
    Expression condition;
    std::vector<Statement> statements;
    std::vector<Name> outputs;
};

struct RawTerm {
    Span span;
    std::vector<std::uint8_t> bytes;      ///< empty with symbols
    std::optional<SymbolicTerm> symbols;  ///< written in symbols, not bytes
};

struct ConditionalOutput {
    std::vector<Name> outputs;
    Expression condition;
    Span span;
};

/// ALLOW V006 BECAUSE 'reason';
struct Allowance {
    Name code;
    Name reason;  ///< without its quotes
};

struct Step {
    Name name;
    std::optional<Value> number;  ///< AT 5
    std::vector<Name> outputs;
    std::vector<ConditionalOutput> conditional;
    std::vector<Statement> entry;
    std::vector<Choice> choices;
    std::vector<RawTerm> terms;
    std::vector<Allowance> allowances;
    bool own_error = false;
    Span own_error_span;
    bool no_helper = false;
    Span no_helper_span;
};

struct Variable {
    Name name;
    Name address;                          ///< IN0, %IX0.0, OUT1, P1, V_SOLL
    std::optional<Value> register_number;  ///< AT REG(33)
    std::optional<Value> value;
};

/// ON condition IN steps EXCEPT steps NEXT := Step;
struct OnCondition {
    Expression condition;
    std::vector<Name> only;  ///< steps and groups; none: all steps
    std::vector<Name> except;
    Statement next;
    Span span;
};

/// GROUP Name: steps;
struct Group {
    Name name;
    std::vector<Name> steps;  ///< and groups that stand before
};

struct Scale {
    Span span;
    double revolutions = 1;
    double length = 1;
    Name unit;
};

struct Program {
    Name name;
    std::optional<Name> motor;
    std::optional<Scale> scale;
    std::vector<Variable> inputs;
    std::vector<Variable> outputs;
    std::vector<Variable> motor_variables;
    std::optional<Name> on_error;
    std::vector<OnCondition> on_conditions;
    std::vector<Group> groups;
    std::optional<Step> power_up;
    std::vector<Step> steps;
    bool steps_missing = false;  ///< some could not be read: an unknown name may be one of them
    bool names_missing = false;  ///< the same with inputs, outputs and registers
    bool motor_missing = false;  ///< the same with MOTOR and SCALE
    bool scale_missing = false;
    std::vector<std::string_view> faulty_names;  ///< declared, but with a mistake
    std::vector<RawTerm> terms;
    std::vector<Span> properties;   ///< PROPERTY Name: ... ; each
    std::deque<std::string> texts;  ///< of units that are written with blanks or comments in them
};

}  // namespace nplc::seqc::ast
