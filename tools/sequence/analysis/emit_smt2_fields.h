#pragma once

#include <string>
#include <vector>

#include "emit_question.h"

/// States and conditions in the syntax of clauses for Z3.
namespace nplc::verify::smt2 {

using Names = std::vector<std::string>;

std::string bits(std::uint32_t value, unsigned width);
std::string bit(bool value);

/// A part of a state, and its names before and after a scan.
struct Field {
    std::string here;
    std::string there;
    unsigned width = 1;
    std::string at_power_up() const { return bits(0, width); }
};

/// The parts of a state.
struct Fields {
    Field step{"s", "t", 6};
    Field outputs{"o", "p", 4};
    Field timer{"r", "q", 1};  ///< 1 for running, or the remaining time
    Field counter{"c", "d", 1};
    Field motion{"m", "n", 4};  ///< only if it is part of the facts
    Field moved{"v", "w", 1};   ///< only if moves are timed
    bool tells_motion = false;
    bool times_moves = false;

    explicit Fields(const Question& question);
    std::vector<Field> all() const;
    std::string sorts() const;
    std::string at_power_up() const;
    std::string here() const;
    std::string there() const;
};

/// Of image i and the state at a scan's beginning (`here`) or end.
std::string condition_clause(const Condition& condition, const Fields& fields, bool there);
/// Of a scan from here to there, with k and l remembered before it.
std::string formula_clause(const Formula& formula, const Fields& fields);

}  // namespace nplc::verify::smt2
