#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drive_parts.h"
#include "sim/condition.h"
#include "sim/scenario.h"
#include "sim/text.h"

namespace nplc::sim {

/// An error in the present line, and its position.
struct LineMistake {
    std::string message;
    std::size_t at = 0;
};

struct Token {
    enum class Kind : std::uint8_t { word, number, text, symbol, end } kind = Kind::end;
    std::string_view text;  ///< for a quoted text: the text between the quotes
    double number = 0;
    std::size_t begin = 0;  ///< in the line
    std::size_t end = 0;
};

/// One line, without its comment (`#` or `//`). The last token is of kind `end`. Throws LineMistake.
std::vector<Token> tokens_of(std::string_view line);

/// `from 2 s until 5 s`
struct Window {
    Time from{0};
    std::optional<Time> until;
};

/// Reads tokens one after the other; words are compared without regard to case.
class Reader {
  public:
    Reader(std::string_view line, const Names& names)
        : line_(line), tokens_(tokens_of(line)), names_(names) {}

    const Token& peek(std::size_t ahead = 0) const;
    const Token& next();
    bool at_end() const { return peek().kind == Token::Kind::end; }
    bool is(std::string_view word_or_symbol, std::size_t ahead = 0) const;
    bool take(std::string_view word_or_symbol);
    /// Throws with `what_to_write` if it does not follow.
    void want(std::string_view word_or_symbol, std::string_view what_to_write);
    /// Throws with the token found, and what to write instead.
    [[noreturn]] void fail(std::string_view what_to_write) const;
    /// Throws with the position of the token read last, or of the next one.
    [[noreturn]] void refuse(const std::string& message) const;
    [[noreturn]] void refuse_next(const std::string& message) const { refuse_at(position_, message); }
    [[noreturn]] void refuse_at(std::size_t mark, const std::string& message) const;
    /// Throws with the position of the time read last.
    [[noreturn]] void refuse_time(const std::string& message) const;

    std::size_t mark() const { return position_; }
    /// Where in the line the time read last begins.
    std::size_t time_begin() const { return tokens_[time_at_].begin; }
    /// Reads the rest of the line.
    std::string_view rest();
    /// The source from the token at `mark` to the one read last.
    std::string source_since(std::size_t mark) const;

    double number(std::string_view what_to_write);
    Time duration(std::string_view what_to_write);
    double percent(std::string_view what_to_write);
    bool starts_duration() const;
    bool starts_times() const;
    /// `3 times`
    std::uint64_t times();
    /// `for 200 ms`; 0 without it.
    Time lasting();
    /// Begins at `from` if nothing else is written.
    Window window(Time from = Time{0});

  private:
    std::optional<Time> named_time() const;

    std::string_view line_;
    std::vector<Token> tokens_;
    const Names& names_;
    std::size_t position_ = 0;
    std::size_t time_at_ = 0;  ///< first token of the time read last
};

/// An order as conditions compare it, from the words of the timeline or with the program's names of
/// registers.
struct OrderReading {
    std::string order{};
    std::string mistake{};  ///< empty: there is none
};
OrderReading read_order(std::string_view text, const Names& names);

/// An input as it is named.
struct Terminal {
    unsigned index = 0;
    bool inverted = false;
    /// What the terminal has when the name has `on`.
    bool level(bool on) const { return on != inverted; }
};

/// Conditions and events of the language. All functions throw LineMistake.
class ConditionParser {
  public:
    ConditionParser(Reader& reader, const Names& names) : reader_(reader), names_(names) {}

    Condition condition() { return either(); }
    Event event();
    /// 0, 1, FALSE, TRUE, OFF, ON
    bool level();
    /// An input by its own or the program's name; `use` names its purpose for messages.
    Terminal input(std::string_view use);
    /// An input or output.
    Value signal(std::string_view use);
    /// A step by its name or number.
    double step_number();
    /// A shaft position, in counts.
    std::int64_t place();
    /// The unit after `per`, in counts: a revolution, or the machine's unit.
    double length();
    bool knows(std::string_view word) const { return lookup(word).has_value(); }
    const Names& names() const { return names_; }

  private:
    Condition either();
    Condition both();
    Condition primary();
    Condition nested(Condition (ConditionParser::*part)());
    Condition comparison();
    Condition order();
    Value value();
    void operand(Condition& condition);
    struct Measure {
        double value;  ///< in the value's own unit
        Unit unit;
    };
    void quantity(Condition& condition);
    // set_point_parser.cpp
    void set_point_value(Condition& condition);
    Measure point_measure(const set_points::SetPoint& point, std::string_view what);
    /// A number that may be counts or the machine's unit says which.
    void want_unit(Value::Kind kind, const Measure& measure) const;
    void check_step(unsigned number) const;
    Condition group();
    Measure measure(std::string_view what, Value::Kind kind);
    bool take_unit(std::string_view name);
    /// A word behind a number that is meant as a unit.
    bool at_other_unit() const;
    bool has_share() const;
    std::string written_unit() const;
    [[noreturn]] void refuse_unit(double number, Value::Kind kind);
    void edge(Event& event);
    std::optional<Value> lookup(std::string_view word) const;
    std::string known_values() const;

    Reader& reader_;
    const Names& names_;
    int depth_ = 0;  ///< nesting of parentheses and NOTs
};

/// The expectations of a scenario. All functions throw LineMistake.
class ExpectationParser {
  public:
    ExpectationParser(Reader& reader, ConditionParser& conditions)
        : reader_(reader), conditions_(conditions) {}

    /// `at`: the time before the word.
    Expectation expectation(std::optional<Time> at);
    /// Where in the line the moment is written from which on it looks, or at which.
    std::size_t moment_begin() const { return moment_begin_; }

  private:
    void held_condition(Expectation& result);
    void always(Expectation& result, bool never);
    void all_the_time(Expectation& result);
    void take_window(Expectation& result);
    void at_time(Expectation& result);
    void event_or_condition(Expectation& result);
    void after_event(Expectation& result);
    void of_event(Expectation& result);
    bool starts_count() const;
    void count(Expectation& result);
    Time moment(std::string_view what_to_write);
    void refuse_awaited_change(const Event& event) const;

    Reader& reader_;
    ConditionParser& conditions_;
    std::size_t moment_begin_ = 0;
};

/// The changes of set-points. All functions throw LineMistake.
class SetPointParser {
  public:
    /// `recipes`: names of the recipes that the scenario has saved so far.
    SetPointParser(Reader& reader, ConditionParser& conditions, std::vector<std::string>& recipes)
        : reader_(reader), conditions_(conditions), recipes_(recipes) {}

    /// set Length := 60 mm and Dwell := 800 ms
    action::SetPoints set();
    /// recipe save "Short", recipe load "Short"
    action::SetPoints recipe();

  private:
    void needs_set_points() const;
    std::string no_such_point(std::string_view name) const;

    Reader& reader_;
    ConditionParser& conditions_;
    std::vector<std::string>& recipes_;
};

/// The actions of a scenario. All functions throw LineMistake.
class ActionParser {
  public:
    /// `recipes`: names of the recipes that the scenario has saved so far.
    ActionParser(Reader& reader, ConditionParser& conditions, std::vector<std::string>& recipes)
        : reader_(reader), conditions_(conditions), recipes_(recipes) {}

    /// [after TIME] ACTION {, [after TIME] ACTION}; times add up.
    Actions actions();
    /// HW_SETUP := XPRINP NOFILT, after `motor`.
    StoredRegister stored_register();

  private:
    template <class What>
    static void add(Actions& list, Time after, What what, bool takes_back = false) {
        list.push_back({after, std::move(what), takes_back});
    }

    /// Also adds the reverse action where `for TIME` follows.
    template <class What>
    void add_for(Actions& list, Time after, What what, What back) {
        add(list, after, std::move(what));
        if (const Time span = reader_.lasting(); span != Time{0})
            add(list, after + span, std::move(back), true);
    }

    void action(Actions& list, Time after);
    action::Cancel cancelled();
    void set_input(Actions& list, Time after);
    void check_known_word();
    void pulse(Actions& list, Time after);
    void line(Actions& list, Time after);
    void line_direction(action::SpoilLine& spoil);
    bool fault(action::SpoilLine& spoil);
    void motor(Actions& list, Time after);
    bool motor_surroundings(Actions& list, Time after);
    bool drive_input(Actions& list, Time after);
    /// Throws if the drive has no such part.
    void needs(DrivePart part) const;
    action::LoadMotor motor_load();
    action::MotorBrake motor_brake();
    StoredRegister stored_parameter();
    void motor_power(Actions& list, Time after);
    std::uint32_t stored_value(const registers::Register& reg, registers::Model model);
    std::uint32_t stored_bits(const registers::Register& reg, registers::Model model);
    void motor_stop(Actions& list, Time after);
    double spring();
    action::MotorSensor motor_sensor();
    action::MotorAnalogue motor_analogue();
    action::MotorPulses motor_pulses(bool with_direction);
    action::MotorSupply motor_supply(bool logic);
    action::MotorTemperature motor_temperature();
    bool above_or_below(std::string_view example);
    int whole(std::string_view what, double least, double most, std::string_view mistake);
    void gateway(Actions& list, Time after);
    void force(Actions& list, Time after);
    void seed(Actions& list, Time after);
    void log(Actions& list, Time after);

    Reader& reader_;
    ConditionParser& conditions_;
    std::vector<std::string>& recipes_;
};

}  // namespace nplc::sim
