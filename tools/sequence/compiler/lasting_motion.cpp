// Motions that STOP does not end, and motions that begin again without an order for them.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "compiler/checker.h"
#include "compiler/orders.h"
#include "compiler/step_walk.h"
#include "symbols/commands.h"

namespace nplc::seqc {
namespace {

/// What the motor may be doing.
enum MotionBit : std::uint8_t {
    kMayInit = 1,
    kMayInPlace = 2,
    kMayToPlace = 4,
    kMayHalted = 8,  ///< on its way to a place, V_SOLL is 0
    kMayRuns = 16,   ///< velocity and gear modes, V_SOLL 0 or not
    kMayHoming = 32,
    kMayDriven = 64,  ///< a torque mode
};

struct LastingMotion {
    std::uint8_t may_be = 0;
    Span unstoppable;  ///< what began a homing or a torque mode
    Span move;         ///< what began the move to a place

    bool is_known() const { return may_be != 0; }
    bool join(const LastingMotion& other) {
        const std::uint8_t before = may_be;
        if ((may_be & (kMayHoming | kMayDriven)) == 0) unstoppable = other.unstoppable;
        if ((may_be & (kMayToPlace | kMayInPlace | kMayHalted)) == 0) move = other.move;
        may_be |= other.may_be;
        return may_be != before;
    }
    void replace(std::uint8_t was, std::uint8_t is) {
        if ((may_be & was) != 0) may_be = static_cast<std::uint8_t>((may_be & ~was) | is);
    }
};

class LastingMotionWalk {
  public:
    using State = LastingMotion;

    LastingMotionWalk(std::string_view source, Report& report) : source_(source), report_(report) {}

    static void enter(LastingMotion& state, const StepPlan&, const Rule& rule) {
        // An ERROR stops the motor and ends its mode (001 §3.2.35).
        if ((rule.when & ~truth_of_bit(kErrorBit)).none()) state.may_be = kMayInit;
        if (rule.condition.length != 0 && needs_in_position(rule))
            state.replace(kMayToPlace | kMayHoming | kMayHalted, kMayInPlace);
    }

    static void apply(LastingMotion& state, const Send& send) {
        switch (motion_effect_of(send)) {
            case MotionEffect::none:
            case MotionEffect::target:
                return;
            case MotionEffect::init:
                state.may_be = kMayInit;
                return;
            case MotionEffect::run:
                state.may_be = kMayRuns;
                return;
            case MotionEffect::place:
                state.may_be = kMayToPlace;
                state.move = send.span;
                return;
            case MotionEffect::hold:
                state.replace(kMayHalted | kMayRuns | kMayHoming | kMayDriven | kMayInit, kMayToPlace);
                return;
            case MotionEffect::home:
                state.may_be = kMayHoming;
                state.unstoppable = send.span;
                return;
            case MotionEffect::drive:
                state.may_be = kMayDriven;
                state.unstoppable = send.span;
                return;
            case MotionEffect::stop:
                state.replace(kMayToPlace, kMayHalted);
                return;
            case MotionEffect::speed:
                state.replace(kMayHalted, kMayToPlace);
                return;
        }
    }

    void judge(const Rule& rule, LastingMotion state) {
        for (const Send& send : rule.action.sends) {
            judge_send(rule, send, state);
            apply(state, send);
        }
    }

  private:
    /// Another order of the scan determines the motor's motion.
    static bool is_decided(const Rule& rule) {
        return std::any_of(rule.action.sends.begin(), rule.action.sends.end(), [](const Send& send) {
            const MotionEffect effect = motion_effect_of(send);
            return effect == MotionEffect::init || moves(effect);
        });
    }
    static bool clears_all(const Rule& rule) {
        const auto has = [&](OrderKind kind) {
            return std::any_of(rule.action.sends.begin(), rule.action.sends.end(),
                               [&](const Send& send) { return kind_of(send) == kind; });
        };
        return has(OrderKind::clears_p_ist) && has(OrderKind::clears_p_soll) && has(OrderKind::clears_p_fnc);
    }

    void judge_send(const Rule& rule, const Send& send, const LastingMotion& state) {
        if (is_decided(rule)) return;
        const MotionEffect effect = motion_effect_of(send);
        if (effect == MotionEffect::stop && (state.may_be & (kMayHoming | kMayDriven)) != 0) {
            const bool homing = (state.may_be & kMayHoming) != 0;
            warn("W050", send, rule,
                 fmt::format("'{}' does not end {}: the motor goes on", statement_text(source_, send.span),
                             homing ? "a homing" : "a torque mode"),
                 "send INIT, as in INIT(V1);, or MODE_REG := 0;", state.unstoppable, "it begins here");
        } else if (effect == MotionEffect::target && send.reg == nullptr &&
                   (state.may_be & (kMayInPlace | kMayToPlace)) != 0 && !clears_all(rule)) {
            warn("W051", send, rule,
                 fmt::format("in position mode '{}' is another target: the motor moves there",
                             statement_text(source_, send.span)),
                 "send INIT(V1); in front of it; or CLEAR_P_IST; CLEAR_P_SOLL; CLEAR_P_FNC; in one scan, "
                 "which moves nothing",
                 state.move, "position mode since here");
        } else if (effect == MotionEffect::speed && (state.may_be & kMayHalted) != 0) {
            warn("W052", send, rule,
                 fmt::format("with '{}' the move goes on that a STOP has ended",
                             statement_text(source_, send.span)),
                 "send INIT(V1); with the STOP or in front of this; or POSITION(..), if it is to go on",
                 state.move, "the move");
        }
    }

    void warn(Code code, const Send& send, const Rule& rule, std::string message, std::string help,
              Span since, std::string why) {
        if (!said_.insert(send.span.offset).second) return;
        Diagnostic& d = report_.add(code, send.span, std::move(message), std::move(help));
        d.notes.push_back({since, std::move(why)});
        const Span way = rule.action.next_span;  // an ENTRY is copied into the branches that lead to it
        const bool elsewhere = rule.action.span.offset > send.span.offset ||
                               rule.action.span.offset + rule.action.span.length < send.span.offset;
        if (elsewhere && way.length != 0) d.notes.push_back({way, "when the step is entered from here"});
    }

    std::string_view source_;
    Report& report_;
    std::set<std::uint32_t> said_;
};

}  // namespace

void check_lasting_motion(const Plan& plan, std::string_view source, Report& report) {
    LastingMotionWalk walk(source, report);
    LastingMotion at_power_up;
    at_power_up.may_be = kMayInit;
    walk_steps(plan, at_power_up, walk);
}

}  // namespace nplc::seqc
