#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/checks.h"
#include "analysis/course.h"
#include "analysis/machine.h"
#include "analysis/property.h"
#include "sequencer/table.h"

namespace nplc::verify {

enum class Verdict : std::uint8_t { proved, broken, undecided };

/// A set-point in a course that needs another value than the table's.
struct SetValue {
    std::string name;
    std::string text;  ///< the value in its unit
    std::uint16_t preset = 0;
    std::vector<std::uint16_t> places;  ///< numbers of the terms with it
};

struct Result {
    std::string name{};
    std::string code{};                  ///< of a built-in check
    std::optional<std::uint8_t> step{};  ///< of a finding of a check
    std::string text{};                  ///< the property, or what was checked
    Verdict verdict = Verdict::undecided;
    Severity severity = Severity::fault;
    std::string reason{};        ///< why it is broken or undecided; of a proof, what is to be known of it
    std::string conflict{};      ///< undecided: why the last course that was tried is impossible
    bool vacuous = false;        ///< proved vacuously: its condition never occurs
    bool only_by_error = false;  ///< proved possible, but somewhere only by ways on which an ERROR begins
    std::string allowed{};       ///< for a finding of a check that was switched off in its step: the reason
    std::uint32_t time_ms = 0;   ///< WITHIN or FOR, which the course's scan that `begins` begins
    bool is_late = false;        ///< the course ends some time after its last scan, at a deadline
    std::optional<Course> course{};       ///< the shortest counterexample, or course to what IS REACHABLE
    std::vector<ChosenPreset> presets{};  ///< values of ranges with which the course can be played
    std::vector<SetValue> set_values{};   ///< the same by the program's names
};

struct Options {
    Assume assume = Assume::driver;
    OrderTime order_time;
    std::uint32_t debounce_ms = 3;
    std::size_t most_states = 2'000'000;
    std::vector<Allowance> allowances;
    std::vector<Assumption> assumptions;
    PresetRanges ranges;  ///< proofs hold for each value of them
    /// Motor registers whose range has 0 in it: V1..V8, V_SOLL.
    std::vector<std::uint8_t> may_be_zero;
    bool checks = true;  ///< run the built-in checks; else properties alone
};

struct Report {
    std::size_t states = 0;
    bool complete = true;  ///< all states were explored
    /// Steps with a name or terms in which no scan begins; none if not complete.
    std::vector<std::uint8_t> unreachable;
    std::vector<Result> results;  ///< built-in checks, then the properties
    std::vector<Assumption> assumptions;
};

/// Whether the assumptions contradict each other, so that everything would be proved.
bool contradict(const std::vector<Assumption>& assumptions);

Report verify(const sequencer::Table& table, const Names& names, const std::vector<Property>& properties,
              const Options& options);

}  // namespace nplc::verify
