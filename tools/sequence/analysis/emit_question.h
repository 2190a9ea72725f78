#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/property.h"
#include "motor_orders.h"
#include "sequencer/term.h"

/// The question to an external checker, in addition to the table: which scan breaks a property (or is to be
/// reached), and the state that must be stored from earlier scans.
namespace nplc::verify {

/// Of a scan: conditions at its end or beginning, and the two stored facts.
struct Formula {
    enum class Kind : std::uint8_t { ended, began, first, second, negation, all_of, any_of, odd_of, held };
    Kind kind = Kind::ended;
    const Condition* condition = nullptr;  ///< ended, began
    std::vector<Formula> parts{};

    Formula operator!() const { return {Kind::negation, nullptr, {*this}}; }
    friend Formula operator&&(const Formula& a, const Formula& b) { return {Kind::all_of, nullptr, {a, b}}; }
    friend Formula operator||(const Formula& a, const Formula& b) { return {Kind::any_of, nullptr, {a, b}}; }
    friend Formula operator^(const Formula& a, const Formula& b) { return {Kind::odd_of, nullptr, {a, b}}; }
};

/// `bad` is judged after a scan; then both facts are updated.
struct Watch {
    Formula bad{};
    Formula first{};
    Formula second{};
    bool remembers = false;
    bool first_at_power_up = false;
    bool second_at_power_up = false;
    const Condition* lasts = nullptr;  ///< its duration is measured; `held` is for `within_ms`
};

/// Not for ALWAYS POSSIBLE, which concerns later scans.
Watch watch_of(const Property& property);

inline bool asks_for_ways(const Property& property) {
    return property.form == Form::always_possible || property.form == Form::after_possible;
}

/// What becomes of each Motion.
using Motions = std::array<Motion, kMotions>;

struct QuestionTerm {
    sequencer::Term term;
    std::optional<sequencer::MotorOrder> order;
    unsigned cleared() const { return order ? cleared_by(table::kind_of(*order)) : 0U; }
};

/// The state that all properties and assumptions need.
struct Question {
    std::vector<QuestionTerm> terms;
    const std::vector<Property>& properties;
    const std::vector<Assumption>& assumptions;
    unsigned named = 0;  ///< bits of HW_INP that properties name
    unsigned used = 0;   ///< and terms or assumptions
    bool tells_motion =
        false;  ///< motion is part of the state, so INPOS and ERROR matter where they end or disturb a move
    std::uint32_t move_ms = 0;
    std::uint32_t longest_hold = 0;  ///< of NEVER .. WHILE
    unsigned greatest_timer = 0;
    unsigned greatest_counter = 0;

    /// `with_holds`: includes properties with a duration.
    Question(std::span<const std::uint8_t> table, const std::vector<Property>& asked,
             const std::vector<Assumption>& assumed, bool with_holds);
    /// P_SOLL, P_IST and P_FNC may be cleared in one scan.
    bool clears_all() const {
        unsigned all = 0;
        for (const QuestionTerm& term : terms) all |= term.cleared();
        return all == kAllCleared;
    }
    /// Else the timer is zero or runs.
    bool counts_time() const { return move_ms != 0 || longest_hold != 0; }
    /// The value at which it saturates.
    std::uint32_t longest() const {
        return std::max({greatest_timer, move_ms == 0 ? 0 : move_ms + 1, longest_hold});
    }
};

}  // namespace nplc::verify
