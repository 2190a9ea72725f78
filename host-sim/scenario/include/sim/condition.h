#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/snapshot.h"

namespace nplc::sim {

/// A value that a scenario can test.
struct Value {
    enum class Kind : std::uint8_t {
        input,
        output,
        inputs,
        outputs,
        step,
        timer,
        counter,
        in_position,
        error,
        link,
        running,
        p_ist,
        v_ist,
        shaft,
        torque,
        set_point,  ///< in force, in its steps
    };
    Kind kind = Kind::input;
    unsigned index = 0;     ///< of an input, an output or a set-point
    bool inverted = false;  ///< an input whose terminal is off when it is 1

    bool is_bit() const;
    double of(const Snapshot& snapshot) const;
    std::string name(const Names& names) const;
};

/// The unit of a number.
struct Unit {
    std::string name;  ///< `mm/s`; empty: the value's own unit
    double size = 1;   ///< in the value's own unit
};

struct Condition {
    enum class Kind : std::uint8_t { compare, ordered, negated, both, either };
    enum class Relation : std::uint8_t { equal, unequal, less, at_most, more, at_least };

    Kind kind = Kind::compare;
    Value value;
    Relation relation = Relation::equal;
    double operand = 1;
    double tolerance = 0;
    Unit unit{};        ///< as written in the scenario
    std::string order;  ///< in words, without blanks, lower case
    std::vector<Condition> parts;

    bool holds(const Snapshot& snapshot, const Names& names) const;
    /// The snapshot's values for all operands of the condition.
    std::string seen(const Snapshot& snapshot, const Names& names) const;
    /// A number of the value in the unit in which it was asked for.
    std::string in_its_unit(double number) const;
};

/// An event: a condition becomes true or false, or a value changes, possibly after a duration.
struct Event {
    enum class Edge : std::uint8_t {
        true_now,  ///< becomes true, or is true from the beginning
        rises,     ///< becomes true
        falls,     ///< becomes false
        changes,   ///< the value changes
        each,      ///< every snapshot in which it is true: for orders, which are true in one snapshot only
    };
    Edge edge = Edge::true_now;
    Condition condition;
    std::optional<Condition> guard{};  ///< must be true as well
    Time span{0};                      ///< required duration
    std::string text;                  ///< as written in the scenario
};

/// Detects an Event; must be shown every snapshot.
class EventWatch {
  public:
    explicit EventWatch(const Event& event) : event_(&event) {}
    bool happens(const Snapshot& snapshot, const Names& names);
    /// When the present state will have lasted long enough.
    std::optional<Time> due() const;

  private:
    bool sets_in(const Snapshot& snapshot, const Names& names);
    bool lasts(const Snapshot& snapshot, const Names& names) const;

    const Event* event_;
    std::optional<double> before_;
    std::optional<Time> since_;
};

/// A register or command in words as conditions compare it: lower case, no blanks.
std::string normal_order(const std::string& words);

}  // namespace nplc::sim
