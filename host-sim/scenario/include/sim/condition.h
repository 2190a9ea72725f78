#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/snapshot.h"

namespace nplc::sim {

/// Something that a scenario can look at.
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
    };
    Kind kind = Kind::input;
    unsigned index = 0;  ///< of an input or output

    bool is_bit() const;
    double of(const Snapshot& snapshot) const;
    std::string name(const Names& names) const;
};

/// What a number is written in.
struct Unit {
    std::string name;  ///< `mm/s`; empty: the value's own steps
    double size = 1;   ///< in those
};

struct Condition {
    enum class Kind : std::uint8_t { compare, ordered, negated, both, either };
    enum class Relation : std::uint8_t { equal, unequal, less, at_most, more, at_least };

    Kind kind = Kind::compare;
    Value value;
    Relation relation = Relation::equal;
    double operand = 1;
    double tolerance = 0;
    Unit unit{};        ///< in which it was asked for
    std::string order;  ///< in words, without blanks, lower case
    std::vector<Condition> parts;

    bool holds(const Snapshot& snapshot, const Names& names) const;
    /// What the snapshot has for every value that the condition looks at.
    std::string seen(const Snapshot& snapshot, const Names& names) const;
};

/// A moment: when a condition becomes true, or false, or a value changes; or when that has lasted for a time.
struct Event {
    enum class Edge : std::uint8_t {
        true_now,  ///< becomes true, or is true from the beginning
        rises,     ///< becomes true
        falls,     ///< becomes false
        changes,   ///< the value becomes another
        each,      ///< at every snapshot in which it is true: for orders, which are true for one only
    };
    Edge edge = Edge::true_now;
    Condition condition;
    std::optional<Condition> guard{};  ///< must be true beside it
    Time span{0};                      ///< that it must last
    std::string text;                  ///< as the scenario has it
};

/// Watches for an Event; must be shown every snapshot.
class EventWatch {
  public:
    explicit EventWatch(const Event& event) : event_(&event) {}
    bool happens(const Snapshot& snapshot, const Names& names);
    /// When what lasts now will have lasted long enough.
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
