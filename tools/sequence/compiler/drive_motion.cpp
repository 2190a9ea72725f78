// Velocities, accelerations and motion of a drive that the gateway translates for, from step to step.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "compiler/checker.h"
#include "compiler/drive.h"
#include "compiler/orders.h"
#include "compiler/step_walk.h"
#include "symbols/commands.h"
#include "symbols/motors.h"
#include "symbols/units.h"

namespace nplc::seqc {
namespace {

using table::Group;
using table::Mode;

/// A value that a register is given: a constant, or a set-point with every value of its range.
struct Given {
    std::uint32_t value = 0;  ///< of a set-point the default
    std::uint8_t set_point = 0;
    bool operator<(const Given& other) const {
        return std::pair(value, set_point) < std::pair(other.value, other.set_point);
    }
};

/// The possible state of the drive. `v` and `a` do not include values that no statement writes.
struct DriveState {
    bool known = false;
    bool positions = false;  ///< it may be moving to a position
    bool runs = false;       ///< it may be running at a velocity
    Span motion;             ///< the order that started the motion
    std::set<Given> v;
    std::set<Given> a;

    bool is_known() const { return known; }
    bool moves() const { return positions || runs; }
    void stand() { positions = runs = false; }
    bool join(const DriveState& other) {
        const auto sizes = [this] { return std::array{v.size(), a.size()}; };
        const auto before = sizes();
        const bool moved = moves();
        const bool changed = !known || (other.positions && !positions) || (other.runs && !runs);
        known = true;
        if (!moved) motion = other.motion;
        positions = positions || other.positions;
        runs = runs || other.runs;
        v.insert(other.v.begin(), other.v.end());
        a.insert(other.a.begin(), other.a.end());
        return changed || sizes() != before;
    }
};

/// The effect of an order on the drive.
struct Effect {
    std::optional<std::uint8_t> v{};      ///< V_SOLL gets this register's value, 0: the value itself
    std::optional<std::uint8_t> a{};      ///< A_SOLL likewise
    bool sets_position = false;           ///< P_SOLL, in any way
    std::optional<std::uint32_t> mode{};  ///< of MODE_REG
    bool stops = false;                   ///< V_SOLL = 0
};

Effect effect_of_number(const Send& send) {
    if (const auto set = table::set_used(send.command)) {
        return {.v = table::register_of({Group::v, *set}),
                .a = table::register_of({Group::a, *set}),
                .sets_position = true};
    }
    if (const auto move = table::relative_move(send.command)) return {.sets_position = move->from_p_soll};
    const OrderKind kind = kind_of(send);
    return {.sets_position = kind == OrderKind::clears_p_soll, .stops = kind == OrderKind::stop};
}

Effect effect_of_write(const Send& send) {
    switch (send.reg->number) {
        case registers::MODE_REG:
            return {.mode = send.value};
        case registers::V_SOLL:
            return {.v = std::uint8_t{0}, .stops = send.value == 0};
        case registers::A_SOLL:
            return {.a = std::uint8_t{0}};
        case registers::P_SOLL:
            return {.sets_position = true};
        default:
            return {};
    }
}

Effect effect_of(const Send& send) {
    if (send.reg != nullptr) return effect_of_write(send);
    const auto select = select_command(send.command);
    if (!select) return effect_of_number(send);
    Effect effect{.mode = select->mode == Mode::init ? 0U : select->mode == Mode::velocity ? 1U : 2U};
    if (select->selection.group == Group::v) effect.v = table::register_of(select->selection);
    if (select->selection.group == Group::a) effect.a = table::register_of(select->selection);
    effect.sets_position = select->selection.group == Group::p;
    return effect;
}

class DriveWalk {
  public:
    using State = DriveState;

    DriveWalk(const Plan& plan, const registers::DriveModel& drive,
              const std::vector<DeclaredSetPoint>& points, Report& report, std::vector<Rounding>& roundings)
        : drive_(drive), points_(points), report_(report), roundings_(roundings) {
        for_each_send(plan, [this](const Send& send) {
            if (send.reg != nullptr) given_[send.reg->number].insert({send.value, send.set_point});
        });
    }

    static void enter(DriveState& state, const StepPlan&, const Rule& rule) {
        if ((rule.when & ~truth_of_bit(kInPosBit)).none()) state.positions = false;
    }

    void apply(DriveState& state, const Send& send) const { apply(send, effect_of(send), state); }

    void judge(const Rule& rule, DriveState state) {
        moved_before_ = state.moves();
        for (const Send& send : rule.action.sends) {
            const Effect effect = effect_of(send);
            const bool goes_on = !effect.mode || *effect.mode != 0;
            if (state.moves() && goes_on && !effect.stops) judge_wait(effect, send, state);
            apply(send, effect, state);
            const bool starts = effect.mode ? *effect.mode != 0 : effect.sets_position && state.moves();
            if (starts) judge_ramps(send, state);
        }
    }

  private:
    std::set<Given> given_to(std::uint8_t number, const Send& send) const {
        if (number == 0) return {{send.value, send.set_point}};
        const auto found = given_.find(number);
        return found == given_.end() ? std::set<Given>() : found->second;
    }

    /// For a set-point the default and both ends of its range: a ramp is longest with one combination of
    /// ends, shortest with another.
    std::vector<std::uint32_t> values_of(const Given& given) const {
        if (given.set_point == 0) return {given.value};
        const DeclaredSetPoint& declared = points_[given.set_point - 1U];
        return {given.value, bits_of(declared.point.lowest, *declared.reg),
                bits_of(declared.point.highest, *declared.reg)};
    }

    void apply(const Send& send, const Effect& effect, DriveState& state) const {
        if (effect.v) state.v = given_to(*effect.v, send);
        if (effect.a) state.a = given_to(*effect.a, send);
        const bool selects_only = effect.mode == 2U && !effect.sets_position && send.reg == nullptr;
        if (selects_only && !state.runs) {
            // It is at P_SOLL, or moving to it: see E052 for INIT.
        } else if (effect.mode) {
            state.stand();
            state.runs = *effect.mode == 1;
            state.positions = *effect.mode == 2;
            state.motion = send.span;
        } else if (effect.sets_position && state.moves()) {
            state.motion = send.span;
        }
        if (effect.stops) state.stand();
    }

    /// Orders that the drive refuses in motion, so that the gateway keeps them until standstill.
    void judge_wait(const Effect& effect, const Send& send, const DriveState& state) {
        const bool to_velocity = effect.mode ? *effect.mode == 1 : state.runs;
        const char* what = effect.sets_position       ? "a position"
                           : effect.a                 ? "an acceleration"
                           : effect.v && !to_velocity ? "the velocity of moves to positions"
                                                      : nullptr;
        if (what == nullptr || !drive_.family->waits_for_standstill() ||
            !waited_.insert(send.span.offset).second)
            return;
        const bool starts_itself = state.motion == send.span && !moved_before_;
        report_
            .add("W015", send.span,
                 fmt::format("this waits until the drive is at rest: in motion a {} accepts no {}",
                             drive_.program_name,
                             std::string_view(what).substr(std::string_view(what).find(' ') + 1)),
                 starts_itself ? "VELOCITY sends V first, which starts the motor: INIT(A..); VELOCITY(V..); "
                                 "selects A while "
                                 "it is at rest, and what was selected stays selected"
                               : "wait for INPOS before, or STOP first; leave it if the wait is intended")
            .notes.push_back(
                {state.motion, starts_itself ? "its first command starts the motor"
                               : state.motion == send.span
                                   ? "the same order, given in the cycle before, may not be finished"
                                   : "it may still be moving because of this"});
    }

    void judge_ramps(const Send& send, const DriveState& state) {
        std::vector<std::string> impossible;
        registers::Refusal why;
        for (const Given& v : state.v) {
            for (const Given& a : state.a) {
                std::string refused = refused_pair(send, v, a, why);
                if (!refused.empty()) impossible.push_back(std::move(refused));
            }
        }
        if (impossible.empty() || !refused_.insert(send.span.offset).second) return;
        const bool always = impossible.size() == state.v.size() * state.a.size();
        const std::string message =
            fmt::format("a {} cannot reach {}", drive_.program_name, impossible.front());
        if (always)
            report_.add("E044", send.span, message, std::string(why));
        else
            report_.add("W016", send.span, message + ", if they meet here", std::string(why));
    }

    /// Values of the two that the drive refuses; empty if it takes all of them.
    std::string refused_pair(const Send& send, const Given& v, const Given& a, registers::Refusal& why) {
        for (const std::uint32_t v_bits : values_of(v)) {
            for (const std::uint32_t a_bits : values_of(a)) {
                const auto velocity = static_cast<std::int16_t>(v_bits);
                const auto acceleration = static_cast<std::uint16_t>(a_bits);
                const registers::Refusal found =
                    drive_.family->refuses_profile(drive_, velocity, acceleration);
                if (found.empty()) {
                    note_ramp(send, velocity, acceleration);
                    continue;
                }
                why = found;
                return fmt::format("{:.6g} rpm{} with {:.6g} rpm/s{}", rpm(velocity), whose(v),
                                   rpm_per_s(acceleration), whose(a));
            }
        }
        return {};
    }

    std::string whose(const Given& given) const {
        if (given.set_point == 0) return {};
        return fmt::format(" (a value of '{}')", points_[given.set_point - 1U].point.name);
    }

    /// Too small a difference to warn of.
    void note_ramp(const Send& send, std::int16_t v, std::uint16_t a) {
        const auto ramp = drive_.family->ramp_of(drive_, v, a);
        if (!ramp || !noted_.insert({v, a}).second) return;
        const double done = ramp->raw / raw_per_rpm_per_s();
        const double error = (done - rpm_per_s(a)) / rpm_per_s(a);
        roundings_.push_back(
            {send.span,
             fmt::format("{:.6g} rpm with {:.6g} rpm/s, on a {} {} ({:.6g} rpm/s, "
                         "{:+.3f} %)",
                         rpm(v), rpm_per_s(a), drive_.program_name, text_of(*ramp), done, error * 100)});
    }

    double rpm(std::int16_t v) const { return v / *raw_per_unit(*reg(registers::V_SOLL), kMap, {}, "rpm"); }
    double rpm_per_s(std::uint16_t a) const { return a / raw_per_rpm_per_s(); }
    double raw_per_rpm_per_s() const { return *raw_per_unit(*reg(registers::A_SOLL), kMap, {}, "rpm/s"); }
    static const registers::Register* reg(std::uint8_t number) { return registers::find(kMap, number); }

    static constexpr registers::Model kMap = registers::Model::mac140;

    const registers::DriveModel& drive_;
    const std::vector<DeclaredSetPoint>& points_;
    Report& report_;
    std::vector<Rounding>& roundings_;
    std::map<std::uint8_t, std::set<Given>> given_;  ///< every value that a register is given
    bool moved_before_ = false;                      ///< the scan whose orders are judged
    std::set<std::uint32_t> waited_;
    std::set<std::uint32_t> refused_;
    std::set<std::pair<std::int16_t, std::uint16_t>> noted_;
};

}  // namespace

void check_drive_motion(const Plan& plan, const registers::DriveModel& drive,
                        const std::vector<DeclaredSetPoint>& points, Report& report,
                        std::vector<Rounding>& roundings) {
    DriveWalk walk(plan, drive, points, report, roundings);
    DriveState at_power_up;
    at_power_up.known = true;
    walk_steps(plan, at_power_up, walk);
}

}  // namespace nplc::seqc
