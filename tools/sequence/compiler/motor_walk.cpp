#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "compiler/checker.h"
#include "compiler/orders.h"
#include "compiler/step_walk.h"
#include "language/names.h"
#include "registers/details.h"
#include "symbols/commands.h"

namespace nplc::seqc {
namespace {

using table::Group;
using table::Mode;

/// The modes that selecting commands set, and one bit for all others.
enum ModeBit : std::uint8_t { kInit = 1, kVelocity = 2, kPosition = 4, kOther = 8, kAnyMode = 15 };

/// The possible state of the motor, with the places that caused it (length 0 if none).
struct MotorState {
    std::uint8_t modes = 0;     ///< the possible modes; 0: no path leads here
    Span init;                  ///< the order that caused INIT
    bool left_in_init = false;  ///< by the start of the gateway or an order, and not by an error alone
    bool stopped = false;       ///< V_SOLL may be 0 because of a STOP
    Span stop;
    bool has_speed = false;   ///< V_SOLL certainly got a value from the program
    bool has_torque = false;  ///< T_SOLL, likewise
    bool homing = false;      ///< it may be homing, or in STARTMODE after it (001 §4.4.13 - §4.4.15)
    Span home;
    bool ends_in_position = false;  ///< STARTMODE is certainly one in which IN_POS is set
    Span start_mode;                ///< the place that set STARTMODE to another one

    bool is_known() const { return modes != 0; }
    /// Merges the state of another path to the same place; true if it has changed.
    bool join(const MotorState& other);
    /// Applies a sent order.
    void apply(const Send& send);
};

/// Whether a mode sets IN_POS at all: velocity, position and gear modes (001 §4.4).
bool sets_in_position(std::uint32_t mode) {
    const OrderKind kind = table::kind_of_mode(mode);
    return kind == OrderKind::run || kind == OrderKind::place;
}

bool ends_homing(const Send& send) {
    if (send.reg != nullptr) return send.reg->number == registers::MODE_REG;
    return select_command(send.command).has_value();
}

bool gives_torque(const Send& send) {
    if (send.reg != nullptr)
        return send.reg->number == registers::T_SOLL || send.reg->number == registers::T_REG_P;
    const auto select = select_command(send.command);
    return table::set_used(send.command).has_value() || (select && select->selection.group == Group::t);
}

/// What moves the motor in a mode, besides what an order said.
enum class Mover : std::uint8_t {
    speed,          ///< V_SOLL
    place,          ///< P_SOLL
    within_speed,   ///< pulses or volts, no faster than V_SOLL
    within_torque,  ///< volts, or the test itself, no stronger than T_SOLL
    by_itself,
};

Mover mover_of(std::uint32_t mode) {
    constexpr std::array<std::uint32_t, 10> kFollowing = {3, 5, 6, 16, 17, 18, 19, 20, 21, 24};
    if (mode == 1) return Mover::speed;
    if (mode == 2) return Mover::place;
    if (mode == 4 || mode == 9) return Mover::within_torque;
    const bool follows = std::find(kFollowing.begin(), kFollowing.end(), mode) != kFollowing.end();
    return follows ? Mover::within_speed : Mover::by_itself;
}

std::uint8_t modes_after(OrderKind kind, const Send& send) {
    if (kind == OrderKind::init) return kInit;
    if (kind == OrderKind::place || kind == OrderKind::hold) return kPosition;
    if (kind == OrderKind::run && (send.reg == nullptr || send.value == 1)) return kVelocity;
    const bool homes = kind == OrderKind::home && send.reg == nullptr;
    return homes ? kAnyMode : kOther;  // STARTMODE is entered at the end
}

bool MotorState::join(const MotorState& other) {
    if (modes == 0) {
        *this = other;
        return other.modes != 0;
    }
    const MotorState before = *this;
    if ((modes & kInit) == 0) init = other.init;
    if (!stopped) stop = other.stop;
    if (!homing) home = other.home;
    if (ends_in_position) start_mode = other.start_mode;
    modes |= other.modes;
    stopped = stopped || other.stopped;
    left_in_init = left_in_init || other.left_in_init;
    has_speed = has_speed && other.has_speed;
    has_torque = has_torque && other.has_torque;
    homing = homing || other.homing;
    ends_in_position = ends_in_position && other.ends_in_position;
    return modes != before.modes || stopped != before.stopped || left_in_init != before.left_in_init ||
           has_speed != before.has_speed || has_torque != before.has_torque || homing != before.homing ||
           ends_in_position != before.ends_in_position;
}

void MotorState::apply(const Send& send) {
    const sequencer::MotorOrder order = order_of(send);
    const OrderKind kind = table::kind_of(order);
    if (ends_homing(send) || kind == OrderKind::home) {
        modes = modes_after(kind, send);
        left_in_init = kind == OrderKind::init;
        if (kind == OrderKind::init) init = send.span;
        homing = kind == OrderKind::home;
        home = send.span;
    }
    if (send.reg != nullptr && send.reg->number == registers::STARTMODE) {
        ends_in_position = sets_in_position(send.value);
        start_mode = ends_in_position ? Span{} : send.span;
    }
    if (kind == OrderKind::speed || table::velocity_taken(order) != 0) {
        stopped = false;
        has_speed = true;
    }
    has_torque = has_torque || gives_torque(send);
    if (kind == OrderKind::stop) {
        stopped = true;
        stop = send.span;
    }
}

/// True with INPOS and false without it.
bool waits_for_in_position(const Truth& when) {
    const Truth with = when & truth_of_bit(kInPosBit);
    return (with & ~(when << (std::size_t{1} << kInPosBit))).any();
}

class MotorWalk {
  public:
    using State = MotorState;

    MotorWalk(const Plan& plan, const Symbols& symbols, std::string_view source, Report& report)
        : symbols_(symbols),
          source_(source),
          start_mode_(registers::find(symbols.motor, registers::STARTMODE)->name),
          report_(report) {
        for_each_send(plan, [this](const Send& send) {
            if (send.reg != nullptr && send.set_point != 0) set_points_.push_back(send.reg->number);
        });
    }

    /// An error puts the motor in INIT (001 §3.2.35), so it may be in INIT where ERROR is handled.
    void enter(MotorState& state, const StepPlan& step, const Rule& rule) {
        step_ = &step;
        if (step.own_error || (rule.when & truth_of_bit(kErrorBit)).any()) state.modes = kAnyMode;
    }

    static void apply(MotorState& state, const Send& send) { state.apply(send); }

    void judge(const Rule& rule, MotorState state) {
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
            if (kind_of(send) == OrderKind::moves_by) judge_relative(send, rule, state);
            state.apply(send);
            if (kind_of(send) == OrderKind::home) home = &send;
        }
    }

  private:
    void judge_mode(const Send& send, const Rule& rule, const MotorState& state) {
        if (send.value == 0 || kind_of(send) == OrderKind::home) return;
        const Mover mover = mover_of(send.value);
        if (mover == Mover::within_speed && state.stopped) return warn_stopped(send, rule, state);
        if ((state.modes & kInit) == 0) return;
        if (mover == Mover::within_speed || mover == Mover::within_torque)
            return judge_limit(send, rule, state, mover);
        const char* where = mover == Mover::speed   ? " at an old V_SOLL"
                            : mover == Mover::place ? " towards an old P_SOLL"
                                                    : "";
        Diagnostic* said =
            complain("W011", send, rule,
                     fmt::format("writing MODE_REG may start the motor{}: it may be in INIT here", where),
                     mover == Mover::speed   ? "VELOCITY(V..); sets the velocity and the mode"
                     : mover == Mover::place ? "POSITION(P..); sets the position and the mode"
                                             : "make sure that the registers of this mode are set before");
        note_init(said, state);
    }

    /// It changes P_SOLL or P_FNC, and no mode.
    void judge_relative(const Send& send, const Rule& rule, const MotorState& state) {
        if (state.stopped) return warn_stopped(send, rule, state);
        if (!state.left_in_init || symbols_.drive != nullptr) return;
        Diagnostic* said = complain(
            "W004", send, rule,
            fmt::format("the motor may not move: it may be in INIT here, and {} does not change that",
                        statement_text(source_, send.span)),
            "let a POSITION(P..) come before on every way: the motor stays in "
            "position mode then");
        note_init(said, state);
    }

    /// These modes have no command of their own; pulses or volts move the motor.
    void judge_limit(const Send& send, const Rule& rule, const MotorState& state, Mover mover) {
        const bool by_speed = mover == Mover::within_speed;
        if (by_speed ? state.has_speed : state.has_torque) return;
        const std::string_view name = registers::name_of_value(symbols_.motor, *send.reg, send.value);
        Diagnostic* said = complain(
            "W011", send, rule,
            fmt::format("{} takes {} as its limit, and on some way here the program gives it no value",
                        name.empty() ? fmt::format("mode {}", send.value) : std::string(name),
                        by_speed ? "V_SOLL" : "T_SOLL"),
            by_speed ? "select a velocity before, with INIT(V..), or write V_SOLL := ..;"
                     : "select a torque before, with INIT(T..), or write T_SOLL := ..;");
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
                                     named(send, rule)),
                         help_for_position(send, rule, state));
            note_init(said, state);
        } else if (select.mode == Mode::velocity && group != Group::v && may_start) {
            Diagnostic* said =
                complain("E052", send, rule,
                         fmt::format("{} may start the motor at an old V_SOLL: it may be in INIT here",
                                     named(send, rule)),
                         fmt::format("name the velocity too: VELOCITY({}, {});",
                                     selected_beside(send, rule, Group::v), name_of(select.selection)));
            note_init(said, state);
        } else if (select.mode == Mode::position && group == Group::p && state.stopped) {
            warn_stopped(send, rule, state);
        } else if (select.mode != Mode::init && !is_value_of(select) &&
                   selected_beside(send, rule, value_group(select)).ends_with("..")) {
            judge_change_of_mode(select, send, rule, state);
        }
    }

    static Group value_group(const SelectCommand& select) {
        return select.mode == Mode::position ? Group::p : Group::v;
    }
    static bool is_value_of(const SelectCommand& select) {
        return select.selection.group == value_group(select);
    }

    /// POSITION(V1) while the motor turns in velocity mode.
    void judge_change_of_mode(const SelectCommand& select, const Send& send, const Rule& rule,
                              const MotorState& state) {
        const bool to_position = select.mode == Mode::position;
        const std::uint8_t others = state.modes & (to_position ? kVelocity | kOther : kPosition | kOther);
        if (others == 0) return;
        const std::string value = name_of(select.selection);
        complain("E052", send, rule,
                 fmt::format("{} may start the motor {}: it may be in {} mode here", named(send, rule),
                             to_position ? "towards an old P_SOLL" : "at an old V_SOLL",
                             others == kVelocity   ? "velocity"
                             : others == kPosition ? "position"
                                                   : "another"),
                 to_position
                     ? fmt::format("name the position too: POSITION(P.., {}){}", value,
                                   select.selection.group == Group::v
                                       ? fmt::format("; the velocity alone is VELOCITY({})", value)
                                       : "")
                     : fmt::format("name the velocity too: VELOCITY(V.., {}); or write {}_SOLL := ..;", value,
                                   letter_of(select.selection.group)));
    }

    /// INIT brakes: it is correct if the motor is at standstill anyway.
    std::string help_for_position(const Send& send, const Rule& rule, const MotorState& state) const {
        const std::string place = selected_beside(send, rule, Group::p);
        const std::vector<Selection> others = selected_with(send, rule);
        const bool writable = std::all_of(others.begin(), others.end(), [&](const Selection& selection) {
            return !is_set_point(selection) && (selection.group == Group::v || selection.group == Group::a ||
                                                selection.group == Group::t);
        });
        std::string names;
        std::string writes;
        for (const Selection& selection : others) {
            names += fmt::format("{}{}", names.empty() ? "" : ", ", name_of(selection));
            writes += fmt::format("{}_SOLL := ..; ", letter_of(selection.group));
        }
        const std::string_view entry = is_in_entry(send) ? "ENTRY " : "";
        const std::string first = fmt::format("{0}INIT({1}); {0}POSITION({2});", entry, names, place);
        if (state.modes == kInit || !writable) return fmt::format("select it first: {}", first);
        if (!entry.empty()) return fmt::format("select it first, if the motor may stop for it: {}", first);
        return fmt::format("write the value itself: {}POSITION({}); or, if the motor may stop for it, {}",
                           writes, place, first);
    }

    /// In an ENTRY, where `first` could not be inserted as it is.
    bool is_in_entry(const Send& send) const {
        constexpr std::string_view kWord = "ENTRY";
        std::string_view before = source_.substr(0, send.span.offset);
        while (!before.empty() && std::isspace(static_cast<unsigned char>(before.back())) != 0)
            before.remove_suffix(1);
        return before.size() >= kWord.size() && same_name(before.substr(before.size() - kWord.size()), kWord);
    }

    /// The operator sets its value, so no other register may have it (E026).
    bool is_set_point(const Selection& selection) const {
        return std::any_of(set_points_.begin(), set_points_.end(), [&](std::uint8_t number) {
            const auto own = selection_of(number);
            return own && own->group == selection.group && own->index == selection.index;
        });
    }

    /// The other selections of the same statement, without positions.
    static std::vector<Selection> selected_with(const Send& send, const Rule& rule) {
        std::vector<Selection> selections;
        for (const Send& other : rule.action.sends) {
            const auto also = select_command(other.command);
            if (other.reg == nullptr && other.span.offset == send.span.offset && also &&
                also->selection.group != Group::p)
                selections.push_back(also->selection);
        }
        return selections;
    }

    /// The program's name of the register.
    std::string name_of(const Selection& selection) const { return shown_register(symbols_, selection); }

    /// The register of a group that the same statement selects, or "P..".
    std::string selected_beside(const Send& send, const Rule& rule, Group group) const {
        for (const Send& other : rule.action.sends) {
            const auto also = select_command(other.command);
            if (other.reg == nullptr && other.span.offset == send.span.offset && also &&
                also->selection.group == group)
                return name_of(also->selection);
        }
        return group == Group::p ? "P.." : "V..";
    }

    /// "POSITION(Fast) names a velocity and no position, so it"
    std::string named(const Send& send, const Rule& rule) const {
        constexpr std::array<std::string_view, 6> kKinds = {"a position", "a velocity",    "an acceleration",
                                                            "a torque",   "a load factor", "a window"};
        const auto select = select_command(send.command);
        const bool to_position = select->mode == Mode::position;
        const std::string wanted = selected_beside(send, rule, to_position ? Group::p : Group::v);
        std::string shown = statement_text(source_, send.span);
        if (!wanted.ends_with("..")) return shown;
        return fmt::format("{} names {} and no {}, so it", shown,
                           kKinds.at(static_cast<std::size_t>(select->selection.group)),
                           to_position ? "position" : "velocity");
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
            fmt::format(
                "{}: INPOS stays 0 while the motor homes, and then depends on {}",
                has_time_limit(*step_) ? "this may always end by its time limit" : "this may wait for ever",
                start_mode_),
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

    /// One report per source place: an ENTRY is copied into many branches.
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

    const Symbols& symbols_;
    std::string_view source_;
    const StepPlan* step_ = nullptr;
    std::string start_mode_;
    Report& report_;
    std::vector<std::uint32_t> said_;
    std::vector<std::uint8_t> set_points_;  ///< registers whose value is a set-point
};

}  // namespace

void check_motor_state(const Plan& plan, const Symbols& symbols, std::string_view source, Report& report) {
    MotorWalk walk(plan, symbols, source, report);
    MotorState at_power_up;
    at_power_up.modes = kAnyMode;
    at_power_up.left_in_init = true;
    walk_steps(plan, at_power_up, walk);
}

}  // namespace nplc::seqc
