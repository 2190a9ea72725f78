#pragma once

#include "sim/condition.h"
#include "tokens.h"

namespace nplc::sim {

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

}  // namespace nplc::sim
