#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/set_points_text.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// Differences in behaviour between two tables, as text.
struct TableDiff {
    struct Step {
        enum class Kind : std::uint8_t { added, removed, renamed, renumbered };
        Kind kind = Kind::added;
        std::string before;  ///< its name; empty if it is new
        std::string now;
        std::uint8_t number_before = 0;
        std::uint8_t number_now = 0;
    };
    /// A register that POWER_UP writes.
    struct Value {
        std::string reg;
        std::string name;                   ///< the program's name of the register, else its own
        std::optional<std::string> before;  ///< empty: not written
        std::optional<std::string> now;
        std::string before_in_units;  ///< "1500 rpm"; empty where unknown
        std::string now_in_units;
    };
    /// A step with different behaviour, under any condition or a specific one.
    struct Change {
        std::string step;
        std::string when;  ///< the condition, "entered", or empty for its outputs
        std::string now;
        std::string before;
    };

    bool same_bytes = false;
    std::string motor_before;  ///< only if both are known and differ
    std::string motor_now;
    std::vector<Step> steps;
    std::vector<Value> values;
    std::vector<Change> outputs;  ///< outputs that are on in a step
    std::vector<Change> entries;  ///< common action of every transition into a step
    std::vector<Change> reactions;
    std::vector<SetPointChange> set_points;

    /// Steps that take changed set-points now, or no more.
    std::vector<std::string> take_now;
    std::vector<std::string> take_no_more;

    /// Names and numbers of steps do not count.
    bool same_behaviour() const;
};

struct NamedTable {
    std::span<const std::uint8_t> table;
    const Symbols* symbols = nullptr;
};

TableDiff diff_of(const NamedTable& before, const NamedTable& now);

std::string text_of(const TableDiff& diff);
std::string json_of(const TableDiff& diff);

}  // namespace nplc::seqc
