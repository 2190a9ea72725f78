// Where the axis surely stands when it is sent somewhere: moves that do nothing, time limits that are too short.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "registers/scale.h"
#include "semantics/checker.h"
#include "semantics/commands.h"
#include "semantics/step_walk.h"
#include "semantics/units.h"

namespace nplc::seqc {
namespace {

using protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;

/// A value of P1..P8 that the axis was sent to.
struct Place {
    std::int64_t counts = 0;
    Selection reg{};
    Span span;  ///< the order

    bool operator==(const Place& other) const { return counts == other.counts; }
};

struct PlaceState {
    bool known = false;     ///< some way leads here
    bool anywhere = false;  ///< on some way the axis may stand at a place that is not in `standing`
    bool relative = false;
    bool idle = false;                   ///< on some way no move is under way
    std::vector<Place> standing;         ///< where it may stand, by the ways that lead here
    std::vector<Place> going;            ///< the moves that may be under way
    std::vector<std::uint8_t> velocity;  ///< V1..V8, those that may be selected; 0: none of them

    bool is_known() const { return known; }

    bool join(const PlaceState& other) {
        bool news = !known || (other.anywhere && !anywhere) || (other.relative && !relative) ||
                    (other.idle && !idle);
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

    PlaceWalk(const Plan& plan, const Symbols& symbols, std::string_view source, Report& report)
        : plan_(plan), symbols_(symbols), source_(source), report_(report) {
        for_each_send(plan, [&](const Send& send) {
            const auto reg = send.reg == nullptr ? std::nullopt : selection_of(send.reg->number);
            if (reg) add_value(*reg, send);
        });
    }

    /// An error may stop a move, and then somebody may move the axis by hand.
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
        if (!select) return apply_number(state, static_cast<Number>(send.command & 0x1F));
        if (select->selection.group == Group::v) state.velocity = {select->selection.index};
        const bool to_place = select->mode == Mode::position && select->selection.group == Group::p;
        if (select->mode == Mode::position && !to_place) return;  // POSITION(V1) selects a velocity
        const auto place = to_place && !state.relative ? place_of(select->selection, send.span) : std::nullopt;
        if (!place) return state.lose();
        if (!state.going.empty()) state.lose();  // it is sent on from somewhere on its way
        state.going = {*place};
        state.idle = false;
    }

    void judge(const Rule& rule, PlaceState state) {
        for (const Send& send : rule.action.sends) {
            const PlaceState before = state;
            apply(state, send);
            const bool is_move = state.going.size() == 1 && state.going.front().span == send.span;
            if (!is_move || !before.going.empty()) continue;
            judge_standing(before, state.going.front());
            // A velocity that is named behind the place counts for this move too.
            PlaceState after = state;
            for (const Send& later : rule.action.sends) {
                if (later.span == send.span) apply_velocity(after, later);
            }
            judge_limit(rule, before, after);
        }
    }

  private:
    struct Value {
        Selection reg{};
        std::int64_t value = 0;
        bool is_one = true;  ///< the program gives it this value alone
    };

    void add_value(Selection reg, const Send& send) {
        const std::int64_t value = static_cast<std::int32_t>(send.value);
        for (Value& known : values_) {
            if (known.reg.group != reg.group || known.reg.index != reg.index) continue;
            known.is_one = known.is_one && known.value == value && send.set_point == 0;
            return;
        }
        values_.push_back({reg, value, send.set_point == 0});
    }

    std::optional<std::int64_t> value_of(Group group, std::uint8_t index) const {
        const auto found = std::find_if(values_.begin(), values_.end(), [&](const Value& known) {
            return known.reg.group == group && known.reg.index == index && known.is_one;
        });
        return found == values_.end() ? std::nullopt : std::optional(found->value);
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

    static void apply_number(PlaceState& state, Number number) {
        switch (number) {
            case Number::nop:
            case Number::reset_error:
                return;
            case Number::positions_absolute:
                state.relative = false;
                return;
            case Number::positions_relative_p_soll:
            case Number::positions_relative_p_fnc:
                state.relative = true;
                break;
            default:
                break;
        }
        state.velocity = {0};
        state.lose();
    }

    void judge_standing(const PlaceState& before, const Place& to) {
        if (before.anywhere || before.standing.empty() || said_.contains(to.span.offset) ||
            std::any_of(before.standing.begin(), before.standing.end(),
                        [&](const Place& place) { return !(place == to); }))
            return;
        said_.insert(to.span.offset);
        const Place& from = before.standing.front();
        const bool is_other = from.reg.index != to.reg.index;
        Diagnostic& d = report_.add(
            "W040", to.span,
            is_other ? fmt::format("the axis stands there already: {} has the value of {}",
                                   shown_register(symbols_, to.reg), shown_register(symbols_, from.reg))
                     : fmt::format("the axis stands at {} already", shown_register(symbols_, to.reg)),
            "name another place, or take the move out; INPOS comes at once");
        d.notes.push_back({from.span, "it was sent there here"});
    }

    void judge_limit(const Rule& rule, const PlaceState& before, const PlaceState& after) {
        if (symbols_.drive != nullptr || !rule.action.timer || rule.action.timer_point != 0 ||
            !rule.action.next || !waits_with_limit(*rule.action.next))
            return;
        const Place& to = after.going.front();
        for (const Place& from : before.standing) {
            const auto seconds = least_time(from, to, after.velocity);
            if (!seconds || *seconds * 1000 <= *rule.action.timer ||
                !said_limits_.insert(rule.action.timer_span.offset).second)
                continue;
            Diagnostic& d = report_.add(
                "W041", rule.action.timer_span,
                fmt::format("this time limit ends before the move does: {:.2f} s from {} to {}, and {:.2f} s here",
                            *seconds, shown_register(symbols_, from.reg), shown_register(symbols_, to.reg),
                            *rule.action.timer / 1000.0),
                fmt::format("write more than {} ms, with time for the ramps, or select a higher velocity",
                            std::lround(std::ceil(*seconds * 1000))));
            d.notes.push_back({to.span, fmt::format("'{}' is the move", statement_text(source_, to.span))});
        }
    }

    /// A step that INPOS leaves, and the timer for another one.
    bool waits_with_limit(std::uint8_t number) const {
        const auto step = std::find_if(plan_.steps.begin(), plan_.steps.end(),
                                       [&](const StepPlan& each) { return each.number == number; });
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

    /// At full velocity all the way; ramps come on top.
    std::optional<double> least_time(const Place& from, const Place& to,
                                     const std::vector<std::uint8_t>& velocity) const {
        if (velocity.size() != 1 || velocity.front() == 0) return std::nullopt;
        const auto raw = value_of(Group::v, velocity.front());
        const registers::Register* reg = register_of(Group::v, velocity.front());
        if (!raw || *raw == 0 || reg == nullptr) return std::nullopt;
        const auto per_rpm = raw_per_unit(*reg, symbols_.motor, {}, "rpm");
        if (!per_rpm) return std::nullopt;
        const double rounds_per_second = std::fabs(static_cast<double>(*raw) / *per_rpm) / 60;
        const auto distance = static_cast<double>(std::abs(to.counts - from.counts));
        return distance / static_cast<double>(registers::exact_scale_of(symbols_.motor).counts_per_rev) /
               rounds_per_second;
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
    std::string_view source_;
    Report& report_;
    std::vector<Value> values_;
    std::set<std::uint32_t> said_;
    std::set<std::uint32_t> said_limits_;
};

}  // namespace

void check_known_places(const Plan& plan, const Symbols& symbols, std::string_view source, Report& report) {
    const bool has_terms = !plan.terms.empty() || std::any_of(plan.steps.begin(), plan.steps.end(),
                                                              [](const StepPlan& s) { return !s.terms.empty(); });
    if (has_terms) return;
    PlaceWalk walk(plan, symbols, source, report);
    PlaceState at_power_up;
    at_power_up.known = true;
    at_power_up.anywhere = true;
    at_power_up.idle = true;
    at_power_up.velocity = {0};
    walk_steps(plan, at_power_up, walk);
}

}  // namespace nplc::seqc
