// Effects of earlier steps: velocities selected for another move, an INPOS that is already 1.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <vector>

#include "compiler/checker.h"
#include "compiler/orders.h"
#include "compiler/step_walk.h"
#include "symbols/commands.h"

namespace nplc::seqc {
namespace {

using table::Group;

/// V, A and T: the parameters of a move besides its position.
constexpr std::array<Group, 3> kGroups = {Group::v, Group::a, Group::t};

struct Selected {
    std::uint8_t index = 0;   ///< 0: written to V_SOLL itself
    std::uint32_t value = 0;  ///< the written value
    bool for_move = false;    ///< selected together with a move
    Span span;

    bool is_same(const Selected& other) const { return index == other.index && value == other.value; }
};

bool selects_place(const Send& send) {
    return send.reg == nullptr && kind_of(send) == OrderKind::place;
}

/// MOVE_P7_BY_P_SOLL and its like.
bool moves_by(const Send& send) {
    return kind_of(send) == OrderKind::moves_by;
}

bool runs(const Send& send) {
    return send.reg == nullptr && kind_of(send) == OrderKind::run;
}

std::optional<Group> group_written(const Send& send) {
    if (send.reg == nullptr) return std::nullopt;
    switch (send.reg->number) {
        case registers::V_SOLL:
            return Group::v;
        case registers::A_SOLL:
            return Group::a;
        case registers::T_SOLL:
            return Group::t;
        default:
            return std::nullopt;
    }
}

struct SelectionState {
    bool known = false;
    std::array<std::vector<Selected>, kGroups.size()> selected;

    bool is_known() const { return known; }
    bool join(const SelectionState& other) {
        bool news = !known;
        known = true;
        for (std::size_t i = 0; i < kGroups.size(); ++i) {
            for (const Selected& more : other.selected[i]) {
                const bool is_here = std::any_of(
                    selected[i].begin(), selected[i].end(),
                    [&](const Selected& own) { return own.is_same(more) && own.for_move == more.for_move; });
                if (is_here) continue;
                selected[i].push_back(more);
                news = true;
            }
        }
        return news;
    }
};

class SelectionWalk {
  public:
    using State = SelectionState;

    SelectionWalk(const Symbols& symbols, std::string_view source, Report& report)
        : symbols_(symbols), source_(source), report_(report) {}

    void enter(SelectionState&, const StepPlan&, const Rule& rule) {
        moves_ = std::any_of(rule.action.sends.begin(), rule.action.sends.end(), [](const Send& send) {
            return selects_place(send) || moves_by(send) || runs(send);
        });
    }

    void apply(SelectionState& state, const Send& send) const {
        const auto written = group_written(send);
        const auto select = send.reg == nullptr ? select_command(send.command) : std::nullopt;
        const bool stops = send.reg == nullptr && kind_of(send) == OrderKind::stop;
        const auto set = send.reg == nullptr ? table::set_used(send.command) : std::nullopt;
        for (std::size_t i = 0; i < kGroups.size(); ++i) {
            if (written == kGroups[i]) state.selected[i] = {{0, send.value, moves_, send.span}};
            if (select && select->selection.group == kGroups[i])
                state.selected[i] = {{select->selection.index, 0, moves_, send.span}};
            if (stops && kGroups[i] == Group::v) state.selected[i].clear();  // reported as W004
            if (set) state.selected[i] = {{*set, 0, false, send.span}};
        }
    }

    void judge(const Rule& rule, SelectionState state) {
        for (const Send& send : rule.action.sends) {
            if (selects_place(send) || moves_by(send)) judge_move(rule, send, state);
            if (runs(send) && select_command(send.command)->selection.group == Group::v)
                judge_move(rule, send, state);
            apply(state, send);
        }
    }

  private:
    /// `VELOCITY(Fast, Soft)` selects one after the other.
    static bool names_itself(const Rule& rule, const Send& send, Group group) {
        return std::any_of(rule.action.sends.begin(), rule.action.sends.end(), [&](const Send& other) {
            const auto select = other.reg == nullptr ? select_command(other.command) : std::nullopt;
            return select && select->selection.group == group && other.span.offset == send.span.offset;
        });
    }

    void judge_move(const Rule& rule, const Send& send, const SelectionState& state) {
        for (std::size_t i = 0; i < kGroups.size(); ++i) {
            if (names_itself(rule, send, kGroups[i])) continue;
            const std::vector<Selected>& ways = state.selected[i];
            const auto of_move =
                std::find_if(ways.begin(), ways.end(), [](const Selected& way) { return way.for_move; });
            if (of_move == ways.end()) continue;
            const auto other = std::find_if(ways.begin(), ways.end(),
                                            [&](const Selected& way) { return !way.is_same(*of_move); });
            if (other == ways.end() || !said_.insert({send.span.offset, i}).second) continue;
            warn(send, kGroups[i], *of_move, *other);
        }
    }

    void warn(const Send& send, Group group, const Selected& of_move, const Selected& other) {
        const std::string_view what = group == Group::v   ? "velocity"
                                      : group == Group::a ? "acceleration"
                                                          : "torque";
        Diagnostic& d =
            report_.add("W035", send.span,
                        fmt::format("the {} of this move depends on the way into the step: {} or {}", what,
                                    name_of(group, of_move), name_of(group, other)),
                        fmt::format("write its value in front of the move: {}_SOLL := ..; {};",
                                    letter_of(group), statement_text(source_, send.span)));
        d.notes.push_back({of_move.span, "selected here for another move, and it stays"});
        d.notes.push_back({other.span, "selected here on another way"});
    }

    std::string name_of(Group group, const Selected& selected) const {
        if (selected.index == 0) return fmt::format("'{}'", statement_text(source_, selected.span));
        return shown_register(symbols_, {group, selected.index});
    }

    const Symbols& symbols_;
    std::string_view source_;
    Report& report_;
    bool moves_ = false;
    std::set<std::pair<std::uint32_t, std::size_t>> said_;
};

/// Whether an order may have been sent since INPOS was last tested.
struct InPosState {
    bool known = false;
    bool may_move = false;
    Span seen;

    bool is_known() const { return known; }
    bool join(const InPosState& other) {
        const bool news = !known || (other.may_move && !may_move);
        if (!known) seen = other.seen;
        known = true;
        may_move = may_move || other.may_move;
        return news;
    }
};

class InPosWalk {
  public:
    using State = InPosState;

    explicit InPosWalk(Report& report) : report_(report) {}

    void enter(InPosState& state, const StepPlan& step, const Rule& rule) {
        step_ = &step;
        before_ = state;
        if (rule.condition.length == 0 || !needs_in_position(rule)) return;
        state.may_move = false;
        state.seen = rule.condition;
    }

    static void apply(InPosState& state, const Send&) { state.may_move = true; }

    void judge(const Rule& rule, const InPosState&) {
        if (before_.may_move || !leaves(*step_, rule)) return;
        for (const RulePart& part : rule.parts) judge_wait(part.when, part.condition);
        if (rule.parts.empty()) judge_wait(rule.when, rule.condition);
    }

  private:
    void judge_wait(const Truth& when, Span condition) {
        if (condition.length == 0 || before_.seen == condition || (when & ~truth_of_bit(kInPosBit)).any() ||
            asks_for_more(when) || report_.has("W036", condition))
            return;
        report_
            .add("W036", condition, "this holds at once: nothing was ordered since INPOS came last",
                 "order the move that it is to wait for, or take INPOS out")
            .notes.push_back({before_.seen, "INPOS came here"});
    }

    /// Whether something other than INPOS decides, if no other branch without INPOS takes the case: `ON
    /// Guard`, a preceding `IF Guard THEN`, `AND NOT Guard`.
    bool asks_for_more(const Truth& when) const {
        const Truth left = ~guards();
        for (const std::size_t bit :
             {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{4}, std::size_t{5},
              std::size_t{kTimerZero}, std::size_t{kCounterZero}}) {
            const std::size_t other = std::size_t{1} << bit;
            const Truth off = ~truth_of_bit(bit) & left & (left >> other);  // both cases of the bit remain
            if (((when ^ (when >> other)) & off).any()) return true;
        }
        return false;
    }

    Truth guards() const {
        Truth taken;
        for (const Rule& rule : step_->rules) {
            if (!leaves(*step_, rule)) continue;
            for (const RulePart& part : rule.parts) {
                if (!depends_on(part.when, kInPosBit)) taken |= part.when;
            }
        }
        return taken;
    }

    Report& report_;
    InPosState before_;
    const StepPlan* step_ = nullptr;
};

}  // namespace

void check_lasting_selections(const Plan& plan, const Symbols& symbols, std::string_view source,
                              Report& report) {
    SelectionWalk walk(symbols, source, report);
    SelectionState at_power_up;
    at_power_up.known = true;
    walk_steps(plan, at_power_up, walk);
}

void check_standing_in_position(const Plan& plan, Report& report) {
    InPosWalk walk(report);
    InPosState at_power_up;
    at_power_up.known = true;
    at_power_up.may_move = true;
    walk_steps(plan, at_power_up, walk);
}

}  // namespace nplc::seqc
