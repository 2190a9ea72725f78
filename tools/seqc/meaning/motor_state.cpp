#include <fmt/format.h>

#include <array>

#include "meaning/checker.h"
#include "meaning/commands.h"

namespace nplc::seqc {
namespace {

using protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;

enum ModeBit : std::uint8_t { kInit = 1, kVelocity = 2, kPosition = 4, kOther = 8, kAnyMode = 15 };

/// What may be true of the motor.
struct MotorState {
    std::uint8_t modes = 0;  ///< in which modes it may be; 0: the step is not reached
    bool stopped = false;    ///< V_SOLL may be 0 from a STOP
    Span stop;

    bool join(const MotorState& other) {
        const std::uint8_t before = modes;
        const bool was_stopped = stopped;
        modes |= other.modes;
        if (!stopped && other.stopped) stop = other.stop;
        stopped = stopped || other.stopped;
        return modes != before || stopped != was_stopped;
    }
};

class MotorWalk {
  public:
    MotorWalk(const Plan& plan, Report& report) : plan_(plan), report_(report) {}

    void run() {
        states_[0].modes = kAnyMode;
        bool changed = true;
        while (changed) {
            changed = false;
            for (const StepPlan& step : plan_.steps) changed = pass_on(step) || changed;
        }
        for (const StepPlan& step : plan_.steps) {
            if (states_[step.number].modes == 0) continue;
            for (const Rule& rule : step.rules) judge(step, rule);
        }
    }

  private:
    /// An error puts the motor in INIT (001 §3.2.35), so where ERROR is dealt with it may be there.
    MotorState before(const StepPlan& step, const Rule& rule) const {
        MotorState state = states_[step.number];
        if (step.own_error || (rule.when & truth_of_bit(kErrorBit)).any()) state.modes = kAnyMode;
        return state;
    }

    bool pass_on(const StepPlan& step) {
        if (states_[step.number].modes == 0) return false;
        bool changed = false;
        for (const Rule& rule : step.rules) {
            MotorState state = before(step, rule);
            for (const Send& send : rule.action.sends) apply(send, state);
            const std::uint8_t to = rule.action.next.value_or(step.number);
            changed = states_[to].join(state) || changed;
        }
        return changed;
    }

    static void apply(const Send& send, MotorState& state) {
        if (send.reg != nullptr) return apply_write(send, state);
        if (const auto select = select_command(send.command)) {
            state.modes = select->mode == Mode::init       ? kInit
                          : select->mode == Mode::velocity ? kVelocity
                                                           : kPosition;
            if (select->selection.group == Group::v) state.stopped = false;
            return;
        }
        switch (static_cast<Number>(send.command & 0x1F)) {
            case Number::clear_v_soll:
                state.stopped = true;
                state.stop = send.span;
                break;
            case Number::use_set_1:
            case Number::use_set_2:
            case Number::use_set_3:
            case Number::use_set_4:
                state.stopped = false;
                break;
            case Number::home:
                state.modes = kAnyMode;
                break;  // STARTMODE takes over when it is done
            default:
                break;
        }
    }

    static void apply_write(const Send& send, MotorState& state) {
        switch (send.reg->number) {
            case registers::MODE_REG:
                state.modes = send.value == 0   ? kInit
                              : send.value == 1 ? kVelocity
                              : send.value == 2 ? kPosition
                                                : kOther;
                break;
            case registers::V_SOLL:
                state.stopped = send.value == 0;
                state.stop = send.span;
                break;
            case registers::V_REG_P:
                state.stopped = false;
                break;
            default:
                break;
        }
    }

    void judge(const StepPlan& step, const Rule& rule) {
        MotorState state = before(step, rule);
        for (const Send& send : rule.action.sends) {
            if (const auto select = send.reg == nullptr ? select_command(send.command) : std::nullopt) {
                judge_selection(*select, send, rule, state);
            }
            if (send.reg != nullptr && send.reg->number == registers::MODE_REG) judge_mode(send, rule, state);
            apply(send, state);
        }
    }

    void judge_mode(const Send& send, const Rule& rule, const MotorState& state) {
        if (send.value == 0 || (state.modes & kInit) == 0) return;
        const char* where = send.value == 1   ? " at an old V_SOLL"
                            : send.value == 2 ? " towards an old P_SOLL"
                                              : "";
        complain("W011", send, rule,
                 fmt::format("writing MODE_REG may start the motor{}: it may be in INIT here", where),
                 send.value == 1   ? "VELOCITY(V..); sets the velocity and the mode"
                 : send.value == 2 ? "POSITION(P..); sets the position and the mode"
                                   : "make sure that the registers of this mode are set before");
    }

    void judge_selection(const SelectCommand& select, const Send& send, const Rule& rule,
                         const MotorState& state) {
        const Group group = select.selection.group;
        const bool may_start = (state.modes & kInit) != 0;
        if (select.mode == Mode::position && group != Group::p && may_start) {
            complain("E052", send, rule,
                     fmt::format("{} may start the motor towards an old P_SOLL: it may be in INIT here",
                                 describe_command(send.command)),
                     "select it first: INIT(..); and then only the position: POSITION(P..);");
        } else if (select.mode == Mode::velocity && group != Group::v && may_start) {
            complain("E052", send, rule,
                     fmt::format("{} may start the motor at an old V_SOLL: it may be in INIT here",
                                 describe_command(send.command)),
                     "name the velocity too: VELOCITY(V.., A..);");
        } else if (select.mode == Mode::position && group == Group::p && state.stopped) {
            Diagnostic* said =
                complain("W004", send, rule, "the motor may not move: V_SOLL may still be 0 from a STOP",
                         "select a velocity first, with INIT(V..) or POSITION(V.., P..)");
            if (said != nullptr) said->notes.push_back({state.stop, "V_SOLL becomes 0 here"});
        }
    }

    /// One word for each place in the source: an ENTRY is copied into many branches.
    Diagnostic* complain(const char* code, const Send& send, const Rule& rule, std::string message,
                         std::string help) {
        for (std::uint32_t said : said_) {
            if (said == send.span.offset) return nullptr;
        }
        said_.push_back(send.span.offset);
        Diagnostic& d = code[0] == 'W' ? report_.warning(code, send.span, std::move(message), std::move(help))
                                       : report_.error(code, send.span, std::move(message), std::move(help));
        const bool elsewhere = rule.action.span.offset > send.span.offset ||
                               rule.action.span.offset + rule.action.span.length < send.span.offset;
        if (elsewhere) d.notes.push_back({rule.action.span, "when the step is entered from here"});
        return &d;
    }

    const Plan& plan_;
    Report& report_;
    std::array<MotorState, 64> states_{};
    std::vector<std::uint32_t> said_;
};

}  // namespace

void check_motor_state(const Plan& plan, Report& report) {
    MotorWalk(plan, report).run();
}

}  // namespace nplc::seqc
