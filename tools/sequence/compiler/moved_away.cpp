// Moves that start from a P_SOLL or P_FNC that no longer is where the axis stands.
#include "compiler/checker.h"
#include "compiler/guards.h"
#include "compiler/orders.h"
#include "compiler/step_walk.h"
#include "symbols/commands.h"

namespace nplc::seqc {
namespace {

struct AwayState {
    bool known = false;
    bool relative = false;
    bool soll_is_0 = false;  ///< surely, and fnc_is_0: surely what CLEAR_P_FNC made it
    bool fnc_is_0 = false;
    bool searches = false;  ///< `ran` may be a home search that is not over
    Span ran;               ///< what moved the axis away from P_SOLL; length 0: nothing did
    Span cleared;           ///< the CLEAR_P_IST after which P_IST and P_FNC are two places

    bool is_known() const { return known; }
    bool join(const AwayState& other) {
        if (!known) {
            *this = other;
            return other.known;
        }
        const AwayState before = *this;
        relative = relative || other.relative;
        soll_is_0 = soll_is_0 && other.soll_is_0;
        fnc_is_0 = fnc_is_0 && other.fnc_is_0;
        searches = searches || other.searches;
        if (ran.length == 0) ran = other.ran;
        if (cleared.length == 0) cleared = other.cleared;
        return relative != before.relative || soll_is_0 != before.soll_is_0 || fnc_is_0 != before.fnc_is_0 ||
               searches != before.searches || ran != before.ran || cleared != before.cleared;
    }
    /// P_FNC became 0, or P_SOLL.
    void clear_one(bool AwayState::*which) {
        this->*which = true;
        if (soll_is_0 && fnc_is_0) ran = {};
    }
};

class AwayWalk {
  public:
    using State = AwayState;

    explicit AwayWalk(Report& report) : report_(report) {}

    /// After a home search INPOS is that of P_SOLL = 0 (001 §4.4.13).
    static void enter(AwayState& state, const StepPlan&, const Rule& rule) {
        if (!needs_in_position(rule) || !state.searches) return;
        state.searches = false;
        state.ran = {};
    }

    static void apply(AwayState& state, const Send& send) {
        const MotionEffect effect = motion_effect_of(send);
        if (moves(effect)) state.fnc_is_0 = false;
        if (effect == MotionEffect::run || outlasts_stop(effect)) state.ran = send.span;
        if (effect == MotionEffect::init || moves(effect)) state.searches = effect == MotionEffect::home;
        if (effect == MotionEffect::home) {
            state.cleared = {};
            state.soll_is_0 = true;
        }
        if (send.reg != nullptr) return apply_write(state, send);
        apply_command(state, send);
    }

    void judge(const Rule& rule, AwayState state) {
        for (const Send& send : rule.action.sends) {
            if (send.reg == nullptr && kind_of(send) == OrderKind::place) judge_move(send, state);
            apply(state, send);
        }
    }

  private:
    static void apply_write(AwayState& state, const Send& send) {
        const bool is_0 = send.value == 0 && send.set_point == 0;
        switch (send.reg->number) {
            case registers::P_SOLL:
                if (is_0) return state.clear_one(&AwayState::soll_is_0);
                break;
            case registers::P_FNC:
                state.cleared = {};
                if (is_0) return state.clear_one(&AwayState::fnc_is_0);
                break;
            case registers::P_IST:
                break;
            default:
                return;
        }
        state.soll_is_0 = false;
        state.ran = {};  // a written target counts as intended
    }

    static void apply_command(AwayState& state, const Send& send) {
        const OrderKind kind = kind_of(send);
        const auto select = select_command(send.command);
        if (select ? select->selection.group == table::Group::p
                   : kind == OrderKind::moves_by || kind == OrderKind::set) {
            state.soll_is_0 = false;
            state.ran = {};
        }
        if (kind == OrderKind::absolute) state.relative = false;
        if (kind == OrderKind::relative) state.relative = true;
        if (kind == OrderKind::clears_p_soll) state.clear_one(&AwayState::soll_is_0);
        if (kind == OrderKind::clears_p_ist && !state.fnc_is_0) state.cleared = send.span;
        if (kind == OrderKind::clears_p_fnc) {
            state.cleared = {};
            state.clear_one(&AwayState::fnc_is_0);
        }
    }

    void judge_move(const Send& send, const AwayState& state) {
        if (report_.has("W046", send.span)) return;
        if (state.relative && state.ran.length != 0) {
            report_
                .add("W046", send.span,
                     "this relative move may start from an old target: P_SOLL still has the position before "
                     "the axis ran",
                     "make the present position the origin, in INIT: INIT(V..); CLEAR_P_IST; CLEAR_P_FNC; "
                     "CLEAR_P_SOLL;")
                .notes.push_back({state.ran, "the axis ran from here on, and P_SOLL did not change"});
        } else if (!state.relative && state.cleared.length != 0) {
            report_
                .add("W046", send.span,
                     "this position may differ from what P_IST shows: P_FNC still counts from the old origin",
                     "write both, in INIT: INIT(V..); CLEAR_P_IST; CLEAR_P_FNC;")
                .notes.push_back({state.cleared, "P_IST becomes 0 here, and P_FNC does not"});
        }
    }

    Report& report_;
};

}  // namespace

void check_moved_away(const Plan& plan, Report& report) {
    if (has_terms(plan)) return;
    AwayWalk walk(report);
    AwayState at_power_up;
    at_power_up.known = true;
    at_power_up.soll_is_0 = true;
    at_power_up.fnc_is_0 = true;
    walk_steps(plan, at_power_up, walk);
}

}  // namespace nplc::seqc
