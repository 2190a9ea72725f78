// Positions at which the axis surely is when a move is ordered: moves without effect, time limits that are
// too short.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "compiler/checker.h"
#include "compiler/guards.h"
#include "compiler/orders.h"
#include "compiler/step_walk.h"
#include "registers/scale.h"
#include "symbols/commands.h"
#include "symbols/units.h"

namespace nplc::seqc {
namespace {

using table::Group;
using table::Mode;

/// The values that a register may have: a set-point's range, or one.
struct Values {
    std::int64_t low = 0;
    std::int64_t high = 0;

    bool operator==(const Values&) const = default;
    bool is_one() const { return low == high; }
};

/// A value of P1..P8 that the axis was sent to.
struct Place {
    Values counts;
    Selection reg{};
    Span span;  ///< the order

    bool operator==(const Place& other) const {
        return counts == other.counts && (counts.is_one() || reg.index == other.reg.index);
    }
};

struct PlaceState {
    bool known = false;     ///< reachable
    bool anywhere = false;  ///< on some way the axis may be at a position that is not in `standing`
    bool relative = false;
    bool idle = false;                   ///< on some way no move is under way
    std::vector<Place> standing;         ///< possible positions, by the ways to this point
    std::vector<Place> going;            ///< the moves that may be under way
    std::vector<std::uint8_t> velocity;  ///< V1..V8, those that may be selected; 0: none of them

    bool is_known() const { return known; }

    bool join(const PlaceState& other) {
        bool news =
            !known || (other.anywhere && !anywhere) || (other.relative && !relative) || (other.idle && !idle);
        known = true;
        idle = idle || other.idle;
        anywhere = anywhere || other.anywhere;
        relative = relative || other.relative;
        for (const Place& place : other.standing) news = add(standing, place) || news;
        for (const Place& place : other.going) news = add(going, place) || news;
        for (const std::uint8_t index : other.velocity) news = add(velocity, index) || news;
        return news;
    }

    /// Nothing is known of the place any more.
    void lose() {
        anywhere = true;
        idle = true;
        standing.clear();
        going.clear();
    }

    template <class T>
    static bool add(std::vector<T>& to, const T& value) {
        if (std::find(to.begin(), to.end(), value) != to.end()) return false;
        to.push_back(value);
        return true;
    }
};

class PlaceWalk {
  public:
    using State = PlaceState;

    PlaceWalk(const Plan& plan, const Symbols& symbols, const std::vector<DeclaredSetPoint>& points,
              std::string_view source, Report& report)
        : plan_(plan), symbols_(symbols), points_(points), source_(source), report_(report) {
        for_each_send(plan, [&](const Send& send) {
            const auto reg = send.reg == nullptr ? std::nullopt : selection_of(send.reg->number);
            if (reg) add_value(*reg, send);
        });
    }

    /// An error may stop a move, and the axis may then be moved by hand.
    void enter(PlaceState& state, const StepPlan&, const Rule& rule) const {
        const bool in_position = rule.condition.length != 0 && needs_in_position(rule);
        if ((rule.when & truth_of_bit(kErrorBit)).any()) return state.lose();
        if (!in_position || state.going.empty()) return;
        if (!state.idle) {
            state.standing.clear();
            state.anywhere = false;
        }
        for (const Place& place : std::exchange(state.going, {})) PlaceState::add(state.standing, place);
        state.idle = true;
    }

    void apply(PlaceState& state, const Send& send) const {
        if (send.reg != nullptr) return apply_write(state, send);
        const auto select = select_command(send.command);
        if (!select) return apply_number(state, kind_of(send));
        if (select->selection.group == Group::v) state.velocity = {select->selection.index};
        const bool to_place = select->mode == Mode::position && select->selection.group == Group::p;
        if (select->mode == Mode::position && !to_place) return;  // POSITION(V1) selects a velocity
        const auto place =
            to_place && !state.relative ? place_of(select->selection, send.span) : std::nullopt;
        if (!place && select->mode == Mode::init && state.going.empty()) {
            state.anywhere = true;  // the shaft is braked and not held
            return;
        }
        if (!place) return state.lose();
        if (!state.going.empty()) state.lose();  // it is sent on from somewhere on its way
        state.going = {*place};
        state.idle = false;
    }

    void judge(const Rule& rule, PlaceState state) {
        for (const Send& send : rule.action.sends) {
            const PlaceState before = state;
            apply(state, send);
            if (waits_with_limit(rule)) judge_distance(rule, send, before.velocity);
            const std::optional<Place> to = move_of(send);
            if (!to) continue;
            // A velocity that is named behind the place counts for this move too.
            PlaceState after = state;
            for (const Send& later : rule.action.sends) {
                if (later.span == send.span) apply_velocity(after, later);
            }
            if (waits_with_limit(rule)) judge_limit(rule, before, *to, after.velocity);
            judge_standing(before, *to);
        }
    }

    /// Once all rules were judged: an ENTRY is sent on every way into its step.
    void report_standing() {
        for (const auto& [offset, way] : standing_) {
            if (!moves_.contains(offset)) warn_standing(way.first, way.second);
        }
    }

  private:
    static constexpr std::int64_t kInPositionMs = 10;

    struct Least {
        double seconds = 0;
        bool is_one = true;  ///< the velocity is no range
    };

    struct Value {
        Selection reg{};
        Values values;
        bool is_one = true;  ///< the program gives it nothing else
    };

    void add_value(Selection reg, const Send& send) {
        const Values values = range_of(send);
        for (Value& known : values_) {
            if (known.reg.group != reg.group || known.reg.index != reg.index) continue;
            known.is_one = known.is_one && known.values == values;
            return;
        }
        values_.push_back({reg, values});
    }

    Values range_of(const Send& send) const {
        const auto number = [](std::uint32_t bits) { return std::int64_t{static_cast<std::int32_t>(bits)}; };
        if (send.set_point == 0) return {number(send.value), number(send.value)};
        const set_points::SetPoint& point = points_[send.set_point - 1U].point;
        return {number(bits_of(point.lowest, *send.reg)), number(bits_of(point.highest, *send.reg))};
    }

    std::optional<Values> value_of(Group group, std::uint8_t index) const {
        const auto found = std::find_if(values_.begin(), values_.end(), [&](const Value& known) {
            return known.reg.group == group && known.reg.index == index && known.is_one;
        });
        return found == values_.end() ? std::nullopt : std::optional(found->values);
    }

    std::optional<Place> move_of(const Send& send) const {
        const auto select = send.reg == nullptr ? select_command(send.command) : std::nullopt;
        if (!select || select->mode != Mode::position || select->selection.group != Group::p)
            return std::nullopt;
        return place_of(select->selection, send.span);
    }

    std::optional<Place> place_of(Selection reg, Span span) const {
        const auto counts = value_of(Group::p, reg.index);
        return counts ? std::optional(Place{*counts, reg, span}) : std::nullopt;
    }

    static void apply_velocity(PlaceState& state, const Send& send) {
        const auto select = send.reg == nullptr ? select_command(send.command) : std::nullopt;
        if (select && select->selection.group == Group::v) state.velocity = {select->selection.index};
    }

    static void apply_write(PlaceState& state, const Send& send) {
        const std::uint8_t reg = send.reg->number;
        if (reg == registers::V_SOLL) state.velocity = {0};
        if (reg == registers::MODE_REG || reg == registers::P_SOLL || reg == registers::P_IST ||
            reg == registers::P_FNC || reg == registers::V_SOLL)
            state.lose();
    }

    /// A command that selects nothing.
    static void apply_number(PlaceState& state, OrderKind kind) {
        if (kind == OrderKind::nothing || kind == OrderKind::reset_error) return;
        if (kind == OrderKind::absolute || kind == OrderKind::relative)
            state.relative = kind == OrderKind::relative;
        if (kind == OrderKind::absolute) return;
        if (kind == OrderKind::stop || kind == OrderKind::set) state.velocity = {0};
        state.lose();
    }

    void judge_standing(const PlaceState& before, const Place& to) {
        const bool stands = to.counts.is_one() && !before.relative && before.going.empty() &&
                            !before.anywhere && !before.standing.empty() &&
                            std::all_of(before.standing.begin(), before.standing.end(),
                                        [&](const Place& place) { return place == to; });
        if (stands)
            standing_.try_emplace(to.span.offset, before.standing.front(), to);
        else
            moves_.insert(to.span.offset);
    }

    void warn_standing(const Place& from, const Place& to) {
        const bool is_other = from.reg.index != to.reg.index;
        Diagnostic& d = report_.add(
            "W040", to.span,
            is_other ? fmt::format("the axis stands there already: {} has the value of {}",
                                   shown_register(symbols_, to.reg), shown_register(symbols_, from.reg))
                     : fmt::format("the axis stands at {} already", shown_register(symbols_, to.reg)),
            "name another position, or delete the move; INPOS comes at once");
        d.notes.push_back({from.span, "it was sent there here"});
    }

    /// A constant, or the longest time of a set-point.
    std::int64_t limit_of(const Rule& rule) const {
        const std::uint8_t point = rule.action.timer_point;
        return point == 0 ? *rule.action.timer : points_[point - 1U].point.highest;
    }

    void judge_limit(const Rule& rule, const PlaceState& before, const Place& to,
                     const std::vector<std::uint8_t>& velocity) {
        if (limit_of(rule) < kInPositionMs)
            return warn_limit(
                rule, to, "INPOS comes 6 to 10 ms after the axis is there, and this time limit ends before",
                "write the time that the move takes, and some more");
        if (before.relative) {
            const std::int64_t longest = std::max(std::abs(to.counts.low), std::abs(to.counts.high));
            return judge_time(rule, to, least_time(longest, velocity), to.counts.is_one(),
                              fmt::format("for {}", shown_register(symbols_, to.reg)));
        }
        if (!before.going.empty()) return;
        for (const Place& from : before.standing) {
            if (from.reg.index == to.reg.index) continue;
            judge_time(rule, to, least_time(longest_way(from, to), velocity),
                       from.counts.is_one() && to.counts.is_one(),
                       fmt::format("from {} to {}", shown_register(symbols_, from.reg),
                                   shown_register(symbols_, to.reg)));
        }
    }

    /// MOVE_P7_BY_P_SOLL and its like, from wherever the axis stands.
    void judge_distance(const Rule& rule, const Send& send, const std::vector<std::uint8_t>& velocity) {
        const auto move = send.reg == nullptr ? table::relative_move(send.command) : std::nullopt;
        if (!move) return;
        const Selection reg{Group::p, move->index};
        const auto by = place_of(reg, send.span);
        if (!by) return;
        const std::int64_t longest = std::max(std::abs(by->counts.low), std::abs(by->counts.high));
        judge_time(rule, *by, least_time(longest, velocity), by->counts.is_one(),
                   fmt::format("for {}", shown_register(symbols_, reg)));
    }

    void judge_time(const Rule& rule, const Place& to, const std::optional<Least>& least, bool is_one,
                    const std::string& way) {
        const double limit = static_cast<double>(limit_of(rule)) / 1000;
        if (!least || least->seconds <= limit) return;
        warn_limit(rule, to,
                   fmt::format("this time limit ends before the move does: {:.2f} s {}{}, and {:.2f} s here",
                               least->seconds, way,
                               is_one && least->is_one ? "" : " with the least favourable set-points", limit),
                   fmt::format("write more than {} ms, with time for the ramps, or select a higher velocity",
                               std::lround(std::ceil(least->seconds * 1000))));
    }

    void warn_limit(const Rule& rule, const Place& to, std::string message, std::string help) {
        if (!said_limits_.insert(rule.action.timer_span.offset).second) return;
        Diagnostic& d = report_.add("W041", rule.action.timer_span, std::move(message), std::move(help));
        d.notes.push_back({to.span, fmt::format("'{}' is the move", statement_text(source_, to.span))});
    }

    static std::int64_t longest_way(const Place& from, const Place& to) {
        return std::max(std::abs(to.counts.high - from.counts.low),
                        std::abs(from.counts.high - to.counts.low));
    }

    /// It presets the timer and leads to a step with a branch for INPOS and another one for the timer.
    bool waits_with_limit(const Rule& entering) const {
        if (symbols_.drive != nullptr || !entering.action.timer || !entering.action.next) return false;
        const auto step = std::find_if(plan_.steps.begin(), plan_.steps.end(), [&](const StepPlan& each) {
            return each.number == *entering.action.next;
        });
        if (step == plan_.steps.end()) return false;
        bool arrives = false;
        bool ends = false;
        for (const Rule& rule : step->rules) {
            if (!leaves(*step, rule)) continue;
            arrives = arrives || needs_in_position(rule);
            ends = ends || (depends_on(rule.when, kTimerZero) && !needs_in_position(rule));
        }
        return arrives && ends;
    }

    /// At full velocity all the way; ramps come on top. With the lowest velocity of a range.
    std::optional<Least> least_time(std::int64_t counts, const std::vector<std::uint8_t>& velocity) const {
        if (velocity.size() != 1 || velocity.front() == 0) return std::nullopt;
        const auto raw = value_of(Group::v, velocity.front());
        const registers::Register* reg = register_of(Group::v, velocity.front());
        if (!raw || reg == nullptr) return std::nullopt;
        const std::int64_t slowest = std::min(std::abs(raw->low), std::abs(raw->high));
        const auto per_rpm = raw_per_unit(*reg, symbols_.motor, {}, "rpm");
        if (slowest == 0 || !per_rpm) return std::nullopt;
        const double rounds_per_second = static_cast<double>(slowest) / std::fabs(*per_rpm) / 60;
        return Least{static_cast<double>(counts) /
                         static_cast<double>(registers::exact_scale_of(symbols_.motor).counts_per_rev) /
                         rounds_per_second,
                     raw->is_one()};
    }

    const registers::Register* register_of(Group group, std::uint8_t index) const {
        const registers::Register* found = nullptr;
        for_each_send(plan_, [&](const Send& send) {
            const auto reg = send.reg == nullptr ? std::nullopt : selection_of(send.reg->number);
            if (reg && reg->group == group && reg->index == index) found = send.reg;
        });
        return found;
    }

    const Plan& plan_;
    const Symbols& symbols_;
    const std::vector<DeclaredSetPoint>& points_;
    std::string_view source_;
    Report& report_;
    std::vector<Value> values_;
    std::map<std::uint32_t, std::pair<Place, Place>> standing_;  ///< by the order's offset: from and to
    std::set<std::uint32_t> moves_;                              ///< orders that move the axis on some way
    std::set<std::uint32_t> said_limits_;
};

}  // namespace

void check_known_places(const Plan& plan, const Symbols& symbols, const std::vector<DeclaredSetPoint>& points,
                        std::string_view source, Report& report) {
    if (has_terms(plan)) return;
    PlaceWalk walk(plan, symbols, points, source, report);
    PlaceState at_power_up;
    at_power_up.known = true;
    at_power_up.anywhere = true;
    at_power_up.idle = true;
    at_power_up.velocity = {0};
    walk_steps(plan, at_power_up, walk);
    walk.report_standing();
}

}  // namespace nplc::seqc
