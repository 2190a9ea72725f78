#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "seqc/diagnostic.h"

/// The syntax tree, names not yet resolved. All text points into the source or `Program::texts`.
namespace nplc::seqc::ast {

struct Name {
    std::string_view text;
    Span span;
};

/// The role of a name at its place.
enum class Role : std::uint8_t {
    other,
    keyword,  ///< a keyword that can be a name elsewhere: SET, R_TRIG
    program,
    motor,
    step,
    step_or_group,
    group,
    input,
    output,
    motor_variable,
    address,  ///< IN0, %QX0.1
    tested,   ///< in a condition: an input; in a property an output too
    command,
    register_name,  ///< a name of VAR_MOTOR or one of the register map
    constant,       ///< of CONST, a mode or a bit
    unit,
    check,  ///< V006
    property,
    sequence,
    parameter,  ///< of a sequence
    argument,   ///< of its call: an input, output, register, constant or step
    set_point,
};

struct Use {
    Role role = Role::other;
    Span span;
    bool declares = false;
};

/// A construct that ends with its own keyword.
struct Block {
    std::string_view end_word;  ///< "END_STEP"
    Span span;                  ///< from its first word to its end, if it has one
    bool closed = false;
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
        rising,   ///< R_TRIG(name)
        falling,  ///< F_TRIG(name)
        step,     ///< in a property, STEP = name; a number is also in `name`; with `value` STEP IN name
        negation,
        all_of,
        any_of,
        odd_of,
    };
    Kind kind = Kind::constant;
    Span span;
    Name name;           ///< Kind::name, rising, falling
    bool value = false;  ///< Kind::constant, step
    std::vector<Expression> operands;
};

/// A constant, or arithmetic on constants. A written number is a literal.
struct Value {
    enum class Kind : std::uint8_t {
        literal,
        name,      ///< of a constant, a mode or a bit
        part,      ///< BY_COMMAND = HOME2_MODE: `name`, and a literal or a name in `operands`
        negation,  ///< of one operand
        inverse,   ///< a divisor in a product
        sum,
        product,
    };
    Kind kind = Kind::literal;
    Span span;
    double number = 0;
    bool is_raw = false;   ///< 16#..., the register's bits
    bool is_time = false;  ///< T#..., `number` is in milliseconds
    Name unit;             ///< empty text: none
    Name name;             ///< for an evaluated literal: a constant in it
    std::vector<Value> operands;
};

/// CONST Pitch := 40 mm;
struct Constant {
    Name name;
    Value value;
};

/// An argument of a call: a name or a value.
struct Argument {
    Name name;
    std::optional<Value> value;
    Span span;
    std::string_view text;  ///< as written
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
        clear_counter,
        set_outputs,    ///< SET: named in `arguments`
        reset_outputs,  ///< RESET
        call,           ///< CALL name(call)
        go_back         ///< RETURN
    };
    Kind kind = Kind::command;
    Span span;
    Name name;  ///< step, command or register
    std::vector<Name> arguments;
    bool has_arguments = false;  ///< parentheses were written
    Value value;
    std::optional<Value> register_number;  ///< Kind::assign_number
    std::vector<Argument> call;
    bool every_scan = false;
    Span every_scan_span;
};

/// A time after a condition: IF INPOS WITHIN T#3s, IF Start FOR 200 ms.
struct Timing {
    bool is_limit =
        false;  ///< WITHIN: ELSE acts after this time. Else FOR: required duration of the condition
    Value time;
    Span span;
};

struct Branch {
    std::optional<Expression> condition;  ///< empty: ELSE, or statements without IF
    Span span;
    std::vector<Statement> statements;
    std::optional<Timing> timing = {};
};

/// One IF with its ELSIFs and ELSE, or a run of statements without IF.
struct Choice {
    std::vector<Branch> branches;
    bool bare = false;
};

/// TERM IF condition THEN statements END_IF;
struct SymbolicTerm {
    Name step;  ///< empty text: the enclosing step
    Expression condition;
    std::vector<Statement> statements;
    std::vector<Name> outputs;
};

struct RawTerm {
    Span span;
    std::vector<std::uint8_t> bytes;      ///< empty if symbolic
    std::optional<SymbolicTerm> symbols;  ///< if symbolic
};

/// OUT Lamp BLINKING T#500ms;
struct Blinking {
    std::vector<Name> outputs;
    Value time;  ///< on time, and equal off time
    Span span;
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

/// For a step of a SEQUENCE, in one call.
struct Origin {
    Name sequence;
    std::string_view step;    ///< its name in the SEQUENCE
    Name back;                ///< the return step of the call
    std::vector<Span> calls;  ///< all those with the same arguments and return step share the steps
    std::string_view first;   ///< the same step of the first call; empty: this is the first call
    std::vector<std::pair<std::string_view, std::string_view>> arguments;  ///< parameter and its argument
};

struct Step {
    Name name;
    std::optional<Origin> origin;
    std::optional<Value> number;  ///< AT 5
    std::vector<Name> outputs;
    std::vector<ConditionalOutput> conditional;
    std::vector<Blinking> blinking;
    std::vector<Statement> entry;
    std::vector<Choice> choices;
    std::vector<RawTerm> terms;
    std::vector<Allowance> allowances;
    bool own_error = false;
    Span own_error_span;
    bool no_helper = false;
    Span no_helper_span;
    bool takes_set_points = false;
    Span takes_set_points_span;
};

struct Variable {
    Name name;
    Name address;                          ///< IN0, %IX0.0, OUT1, P1, V_SOLL
    std::optional<Value> register_number;  ///< AT REG(33)
    std::optional<Value> value;
    Span inverted = {};  ///< the NOT of AT NOT IN0; length 0: without
};

/// SET_POINT Name AT register := value RANGE low .. high STEP step;
struct SetPoint {
    Name name;
    Name address;                          ///< empty text: without AT, or REG(33)
    std::optional<Value> register_number;  ///< AT REG(33)
    Value value;
    Value low;
    Value high;
    std::optional<Value> step;
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
    std::vector<Name> steps;  ///< and groups declared before
};

/// OUT outputs IN steps EXCEPT steps;
struct GroupOutput {
    std::vector<Name> outputs;
    std::vector<Name> only;  ///< steps and groups
    std::vector<Name> except;
};

struct Parameter {
    enum class Kind : std::uint8_t { input, output, motor_variable, constant, step };
    Kind kind = Kind::input;
    Name name;
};

/// SEQUENCE Name(parameters) steps END_SEQUENCE
struct Sequence {
    Name name;
    std::vector<Parameter> parameters;
    std::vector<Step> steps;
    bool is_broken = false;  ///< its parameters could not be parsed
};

/// PROPERTY Name: form; or ASSUME form;
struct Claim {
    /// `conditions` stand in the order of the words here, `time` is T.
    enum class Form : std::uint8_t {
        never,             ///< NEVER c
        never_while,       ///< NEVER c WHILE d FOR T
        always,            ///< ALWAYS c
        always_possible,   ///< ALWAYS POSSIBLE c
        after_possible,    ///< AFTER c ALWAYS POSSIBLE d
        whenever,          ///< WHENEVER c THEN d [WITHIN T]
        whenever_for,      ///< WHENEVER c FOR T THEN d
        followed_by,       ///< WHENEVER c FOLLOWED BY d THEN e
        stays_on,          ///< BETWEEN c AND d e STAYS ON
        stays_off,         ///< BETWEEN c AND d e STAYS OFF
        scan_ends,         ///< EVERY_SCAN FROM c ENDS IN d
        only_from,         ///< c ONLY FROM d
        only_after,        ///< c ONLY AFTER d
        only_after_both,   ///< c ONLY AFTER d FOLLOWED BY e
        changes_only_in,   ///< c CHANGES ONLY IN d
        reachable,         ///< c IS REACHABLE
        assume_never,      ///< ASSUME NEVER c
        assume_stable,     ///< ASSUME c STABLE FOR T
        assume_move_ends,  ///< ASSUME c ENDS WITHIN T
    };
    Form form = Form::never;
    Name name;  ///< empty text for ASSUME
    Span span;
    std::vector<Expression> conditions;
    std::optional<Value> time;
    std::vector<std::string_view> words;  ///< its tokens behind `PROPERTY Name:`
    bool is_assumed() const { return form >= Form::assume_never; }
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
    std::vector<Constant> constants;
    std::vector<SetPoint> set_points;
    std::optional<Name> on_error;
    std::vector<OnCondition> on_conditions;
    std::vector<Group> groups;
    std::vector<GroupOutput> group_outputs;
    std::vector<Sequence> sequences;
    bool has_calls = false;  ///< CALL or RETURN
    std::optional<Step> power_up;
    std::vector<Step> steps;
    bool steps_missing = false;  ///< some could not be parsed: an unknown name may be one of them
    bool names_missing = false;  ///< the same with inputs, outputs and registers
    bool motor_missing = false;  ///< the same with MOTOR and SCALE
    bool scale_missing = false;
    std::vector<std::string_view> faulty_names;  ///< declared, but with an error
    std::vector<RawTerm> terms;
    std::vector<Span> includes;     ///< texts after INCLUDE, with their quotes
    std::vector<Claim> claims;      ///< of PROPERTY and ASSUME, in source order
    std::deque<std::string> texts;  ///< of units written with blanks or comments in them
    std::vector<Use> uses;          ///< every parsed name, in source order
    std::vector<Block> blocks;      ///< in the order of their ends
};

}  // namespace nplc::seqc::ast
