#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "meaning/checker.h"
#include "meaning/commands.h"
#include "meaning/motor_state.h"

namespace nplc::seqc {
namespace {

using protocol::fastmac::Group;
using protocol::fastmac::Mode;
using protocol::fastmac::Number;

/// Holds with INPOS where it does not hold without.
bool waits_for_in_position(const Truth& when) {
    const Truth with = when & truth_of_bit(kInPosBit);
    return (with & ~(when << (std::size_t{1} << kInPosBit))).any();
}

bool ends_homing(const Send& send) {
    if (send.reg != nullptr) return send.reg->number == registers::MODE_REG;
    return select_command(send.command).has_value();
}

bool starts_homing(const Send& send) {
    if (send.reg != nullptr) return send.reg->number == registers::MODE_REG && is_home_mode(send.value);
    return !select_command(send.command) && static_cast<Number>(send.command & 0x1F) == Number::home;
}

bool is_move(std::uint8_t command) {
    if (select_command(command)) return false;
    const auto number = static_cast<Number>(command & 0x1F);
    return number == Number::move_p7_by_p_fnc || number == Number::move_p8_by_p_fnc ||
           number == Number::move_p7_by_p_soll || number == Number::move_p8_by_p_soll;
}

class MotorWalk {
  public:
    MotorWalk(const Plan& plan, registers::Model model, Report& report)
        : plan_(plan), start_mode_(registers::find(model, registers::STARTMODE)->name), report_(report) {}

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
            for (const Send& send : rule.action.sends) state.apply(send);
            const std::uint8_t to = rule.action.next.value_or(step.number);
            changed = states_[to].join(state) || changed;
        }
        return changed;
    }

    void judge(const StepPlan& step, const Rule& rule) {
        MotorState state = before(step, rule);
        if (state.homing && !state.ends_in_position && waits_for_in_position(rule.when))
            warn_homing_wait(state, rule);
        const Send* home = nullptr;
        for (const Send& send : rule.action.sends) {
            if (home != nullptr && ends_homing(send)) {
                warn_homing_cut(send, *home, rule);
                home = nullptr;
            }
            if (const auto select = select_command(send.command); send.reg == nullptr && select)
                judge_selection(*select, send, rule, state);
            if (send.reg != nullptr && send.reg->number == registers::MODE_REG) judge_mode(send, rule, state);
            if (send.reg == nullptr && is_move(send.command) && state.stopped)
                warn_stopped(send, rule, state);
            state.apply(send);
            if (starts_homing(send)) home = &send;
        }
    }

    void judge_mode(const Send& send, const Rule& rule, const MotorState& state) {
        if (send.value == 0 || is_home_mode(send.value) || (state.modes & kInit) == 0) return;
        const char* where = send.value == 1   ? " at an old V_SOLL"
                            : send.value == 2 ? " towards an old P_SOLL"
                                              : "";
        Diagnostic* said =
            complain("W011", send, rule,
                     fmt::format("writing MODE_REG may start the motor{}: it may be in INIT here", where),
                     send.value == 1   ? "VELOCITY(V..); sets the velocity and the mode"
                     : send.value == 2 ? "POSITION(P..); sets the position and the mode"
                                       : "make sure that the registers of this mode are set before");
        note_init(said, state);
    }

    void judge_selection(const SelectCommand& select, const Send& send, const Rule& rule,
                         const MotorState& state) {
        const Group group = select.selection.group;
        const bool may_start = (state.modes & kInit) != 0;
        if (select.mode == Mode::position && group != Group::p && may_start) {
            Diagnostic* said =
                complain("E052", send, rule,
                         fmt::format("{} may start the motor towards an old P_SOLL: it may be in INIT here",
                                     describe_command(send.command)),
                         "select it first: INIT(..); and then only the position: POSITION(P..);");
            note_init(said, state);
        } else if (select.mode == Mode::velocity && group != Group::v && may_start) {
            Diagnostic* said =
                complain("E052", send, rule,
                         fmt::format("{} may start the motor at an old V_SOLL: it may be in INIT here",
                                     describe_command(send.command)),
                         "name the velocity too: VELOCITY(V.., A..);");
            note_init(said, state);
        } else if (select.mode == Mode::position && group == Group::p && state.stopped) {
            warn_stopped(send, rule, state);
        }
    }

    void warn_stopped(const Send& send, const Rule& rule, const MotorState& state) {
        Diagnostic* said =
            complain("W004", send, rule, "the motor may not move: V_SOLL may still be 0 from a STOP",
                     "select a velocity first, with INIT(V..) or POSITION(V.., P..)");
        if (said != nullptr) said->notes.push_back({state.stop, "V_SOLL becomes 0 here"});
    }

    static void note_init(Diagnostic* said, const MotorState& state) {
        if (said != nullptr && state.init.length != 0)
            said->notes.push_back({state.init, "it goes to INIT here"});
    }

    void warn_homing_wait(const MotorState& state, const Rule& rule) {
        if (!is_news(rule.condition)) return;
        Diagnostic& d = report_.add(
            "W012", rule.condition,
            "this may wait for ever: INPOS stays 0 while the motor homes, and then depends on " + start_mode_,
            fmt::format(
                "write {} := 2; before it begins: the motor then goes on to position 0, where INPOS comes; "
                "or wait for an input or a time, and move with POSITION(P..)",
                start_mode_));
        d.notes.push_back({state.home, "homing begins here"});
        if (state.start_mode.length != 0)
            d.notes.push_back({state.start_mode, "the mode set here does not set INPOS"});
    }

    void warn_homing_cut(const Send& send, const Send& home, const Rule& rule) {
        Diagnostic* said = complain("W014", send, rule, "this ends the homing before it has begun",
                                    "let a step of its own wait until the motor has homed");
        if (said != nullptr) said->notes.push_back({home.span, "homing begins here, in the same scan"});
    }

    /// One word for each place in the source: an ENTRY is copied into many branches.
    Diagnostic* complain(Code code, const Send& send, const Rule& rule, std::string message,
                         std::string help) {
        if (!is_news(send.span)) return nullptr;
        Diagnostic& d = report_.add(code, send.span, std::move(message), std::move(help));
        const bool elsewhere = rule.action.span.offset > send.span.offset ||
                               rule.action.span.offset + rule.action.span.length < send.span.offset;
        if (elsewhere) d.notes.push_back({rule.action.span, "when the step is entered from here"});
        return &d;
    }

    bool is_news(Span span) {
        if (std::find(said_.begin(), said_.end(), span.offset) != said_.end()) return false;
        said_.push_back(span.offset);
        return true;
    }

    const Plan& plan_;
    std::string start_mode_;
    Report& report_;
    std::array<MotorState, 64> states_{};
    std::vector<std::uint32_t> said_;
};

}  // namespace

void check_motor_state(const Plan& plan, registers::Model model, Report& report) {
    MotorWalk(plan, model, report).run();
}

}  // namespace nplc::seqc
