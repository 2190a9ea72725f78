#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/condition.h"
#include "sim/scenario.h"
#include "sim/text.h"

namespace nplc::sim {

/// What is wrong with the line at hand.
struct LineMistake {
    std::string message;
};

struct Token {
    enum class Kind : std::uint8_t { word, number, text, symbol, end } kind = Kind::end;
    std::string_view text;  ///< of a quoted text: what stands between the quotes
    double number = 0;
    std::size_t begin = 0;  ///< in the line
    std::size_t end = 0;
};

/// One line, without its comment (`#` or `//`). The last token is of kind `end`. Throws LineMistake.
std::vector<Token> tokens_of(std::string_view line);

/// Reads tokens one after the other; words are compared without regard to case.
class Reader {
  public:
    explicit Reader(std::string_view line) : line_(line), tokens_(tokens_of(line)) {}

    const Token& peek(std::size_t ahead = 0) const;
    const Token& next();
    bool at_end() const { return peek().kind == Token::Kind::end; }
    bool is(std::string_view word_or_symbol, std::size_t ahead = 0) const;
    bool take(std::string_view word_or_symbol);
    /// Throws with `what_to_write` unless it is there.
    void want(std::string_view word_or_symbol, std::string_view what_to_write);
    /// What was found, and what to write instead.
    [[noreturn]] void fail(std::string_view what_to_write) const;

    std::size_t mark() const { return position_; }
    bool was_first(std::string_view word) const { return same_name(tokens_.front().text, word); }
    /// The source from the token at `mark` to the one read last.
    std::string source_since(std::size_t mark) const;

    double number(std::string_view what_to_write);
    Time duration(std::string_view what_to_write);
    double percent(std::string_view what_to_write);
    bool starts_duration() const;

  private:
    std::string_view line_;
    std::vector<Token> tokens_;
    std::size_t position_ = 0;
};

/// Conditions and events of the language. All functions throw LineMistake.
class ConditionParser {
  public:
    ConditionParser(Reader& reader, const Names& names) : reader_(reader), names_(names) {}

    Condition condition() { return either(); }
    Event event();
    /// 0, 1, FALSE, TRUE, OFF, ON
    bool level();
    /// An input by its own or the program's name; `use` says what it is wanted for.
    unsigned input(std::string_view use);
    /// Where the shaft is, in counts, written as counts or revolutions.
    std::int64_t place();
    double counts_per_revolution() const { return registers::scale_of(names_.motor).counts_per_rev; }
    bool knows(std::string_view word) const { return lookup(word).has_value(); }

  private:
    Condition either();
    Condition both();
    Condition primary();
    Condition nested(Condition (ConditionParser::*part)());
    Condition comparison();
    Condition order();
    Value value();
    void operand(Condition& condition);
    void quantity(Condition& condition);
    double step_number();
    double scaled(double number, Value::Kind kind);
    std::optional<Value> lookup(std::string_view word) const;
    std::string known_values() const;

    Reader& reader_;
    const Names& names_;
    int depth_ = 0;  ///< of parentheses and NOTs
};

/// What a scenario can do. All functions throw LineMistake.
class ActionParser {
  public:
    ActionParser(Reader& reader, ConditionParser& conditions) : reader_(reader), conditions_(conditions) {}

    /// [after TIME] ACTION {, [after TIME] ACTION}; times add up.
    Actions actions();

  private:
    template <class What>
    static void add(Actions& list, Time after, What what) {
        list.push_back({after, std::move(what)});
    }

    void action(Actions& list, Time after);
    void set_input(Actions& list, Time after);
    void check_known_word();
    void pulse(Actions& list, Time after);
    void line(Actions& list, Time after);
    void line_direction(action::SpoilLine& spoil);
    bool fault(action::SpoilLine& spoil);
    void motor(Actions& list, Time after);
    action::LoadMotor motor_load();
    action::MotorBrake motor_brake();
    action::PowerMotor motor_power();
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
    void seed(Actions& list, Time after);
    void log(Actions& list, Time after);

    Reader& reader_;
    ConditionParser& conditions_;
};

}  // namespace nplc::sim
