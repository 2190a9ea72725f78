#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "compiler/truth.h"
#include "seqc/diagnostic.h"

namespace nplc::seqc {

/// R_TRIG or F_TRIG of an input. It is armed when the wire was off (on) in the previous scan of the same
/// step.
struct Edge {
    std::size_t bit = 0;
    bool rising = true;  ///< of the wire
    Span span;
    /// The cases that arm it for the next scan.
    Truth arming() const { return rising ? ~truth_of_bit(bit) : truth_of_bit(bit); }
    /// The cases in which it is true if it is armed.
    Truth seen() const { return ~arming(); }
};

/// State of a time limit in one half period of BLINKING; the last is the state without BLINKING.
enum class Limit : std::uint8_t { runs, over, ends };

/// A step's memory of earlier scans: each combination becomes a step of the table.
struct Memory {
    std::vector<Edge> edges;
    Truth held;  ///< of IF condition FOR time: cases in which the time runs
    std::uint16_t held_for = 0;
    std::uint8_t blinking = 0;  ///< outputs
    std::uint16_t blink_for = 0;
    std::uint16_t limit = 0;         ///< of WITHIN
    std::optional<Span> timer_span;  ///< the step's own use of the timer: WITHIN, FOR or BLINKING

    bool is_held() const { return held_for != 0; }
    /// Combinations of armed edges, the running time of FOR, and the rest of WITHIN with BLINKING.
    std::size_t states() const { return (counts_halves() ? 3 : 1) * remembered(); }
    /// State for `memory`, a combination without the last one, in a half period of BLINKING.
    std::size_t state_of(std::size_t memory, std::uint16_t half) const {
        return memory + remembered() * static_cast<std::size_t>(limit_in(half));
    }
    Limit limit_of(std::size_t state) const {
        return counts_halves() ? static_cast<Limit>(state / remembered()) : Limit::ends;
    }
    /// BLINKING and WITHIN share the timer: the limit is counted in half periods.
    bool counts_halves() const { return limit != 0 && blink_for != 0; }
    /// Half periods until the limit.
    std::uint16_t halves() const {
        return static_cast<std::uint16_t>((std::uint32_t{limit} + blink_for - 1) / blink_for);
    }
    /// Off in odd ones. Two alternate without a limit, or after it.
    std::uint16_t half_after(std::uint16_t half) const {
        const int last = counts_halves() ? halves() + 1 : 1;
        return static_cast<std::uint16_t>(half < last ? half + 1 : half - 1);
    }
    /// The timer preset for a half period.
    std::uint16_t time_of(std::uint16_t half) const {
        if (limit_in(half) != Limit::ends || !counts_halves()) return blink_for;
        return static_cast<std::uint16_t>(limit - half * blink_for);
    }
    bool is_empty() const { return edges.empty() && !is_held() && blinking == 0; }
    static bool is_armed(std::size_t state, std::size_t edge) { return ((state >> edge) & 1U) != 0; }
    bool runs(std::size_t state) const { return is_held() && ((state >> edges.size()) & 1U) != 0; }

  private:
    std::size_t remembered() const { return std::size_t{1} << (edges.size() + (is_held() ? 1 : 0)); }
    Limit limit_in(std::uint16_t half) const {
        if (!counts_halves() || half + 1 < halves()) return Limit::runs;
        return half < halves() ? Limit::ends : Limit::over;
    }
};

}  // namespace nplc::seqc
