// Moves to a place with a velocity of 0.
#include <fmt/format.h>

#include <compare>
#include <map>
#include <set>

#include "compiler/checker.h"
#include "compiler/orders.h"
#include "compiler/step_walk.h"
#include "symbols/commands.h"

namespace nplc::seqc {
namespace {

using table::Group;

/// What V_SOLL got its value from: V1..V8 by index, or 0 for what is written to V_SOLL itself.
struct Source {
    std::uint8_t index = 0;
    const Send* written = nullptr;
    auto operator<=>(const Source&) const = default;
};

struct SpeedState {
    bool known = false;
    std::set<Source> sources;  ///< none after a STOP, for which W004 is reported elsewhere

    bool is_known() const { return known; }
    bool join(const SpeedState& other) {
        const std::size_t before = sources.size();
        const bool is_new = !known;
        known = true;
        sources.insert(other.sources.begin(), other.sources.end());
        return is_new || sources.size() != before;
    }
};

class SpeedWalk {
  public:
    using State = SpeedState;

    SpeedWalk(const Plan& plan, const Symbols& symbols, const std::vector<DeclaredSetPoint>& points,
              Report& report)
        : symbols_(symbols), points_(points), report_(report) {
        for_each_send(plan, [this](const Send& send) {
            const auto selection =
                send.reg != nullptr ? selection_of(send.reg->number) : std::optional<Selection>();
            if (selection && selection->group == Group::v) given_[selection->index].push_back(&send);
        });
    }

    static void enter(SpeedState&, const StepPlan&, const Rule&) {}

    static void apply(SpeedState& state, const Send& send) {
        if (send.reg != nullptr) {
            if (send.reg->number == registers::V_SOLL) state.sources = {{0, &send}};
            return;
        }
        if (kind_of(send) == OrderKind::stop) state.sources.clear();
        if (const auto velocity = selection_of(table::velocity_taken(order_of(send))))
            state.sources = {{velocity->index, nullptr}};
    }

    void judge(const Rule& rule, SpeedState state) {
        const Send* move = nullptr;
        for (const Send& send : rule.action.sends) {
            if (move == nullptr && moves_to_place(send)) move = &send;
            apply(state, send);
        }
        if (move == nullptr) return;
        for (const Source& source : state.sources) {
            if (const Send* zero = zero_of(source)) tell(*move, source, *zero);
        }
    }

  private:
    static bool moves_to_place(const Send& send) {
        const OrderKind kind = kind_of(send);
        return send.reg == nullptr && (kind == OrderKind::place || kind == OrderKind::moves_by);
    }

    bool may_be_zero(const Send& written) const {
        if (written.set_point == 0) return written.value == 0;
        const set_points::SetPoint& point = points_[written.set_point - 1U].point;
        return point.lowest <= 0 && point.highest >= 0;
    }

    /// The order after which it is 0. A register that is 0 for a time only counts as not 0.
    const Send* zero_of(const Source& source) const {
        if (source.written != nullptr) return may_be_zero(*source.written) ? source.written : nullptr;
        const auto given = given_.find(source.index);
        if (given == given_.end()) return nullptr;
        const Send* zero = nullptr;
        bool always = true;
        for (const Send* send : given->second) {
            if (!may_be_zero(*send)) {
                always = false;
            } else if (zero == nullptr || send->set_point != 0) {
                zero = send;
            }
        }
        return zero != nullptr && (always || zero->set_point != 0) ? zero : nullptr;
    }

    void tell(const Send& move, const Source& source, const Send& zero) {
        if (!said_.insert(move.span.offset).second || report_.has("W004", move.span)) return;
        if (zero.set_point != 0) {
            const DeclaredSetPoint& declared = points_[zero.set_point - 1U];
            report_
                .add("W004", move.span,
                     fmt::format("'{}' may be 0, and the motor then accepts this move without moving",
                                 declared.point.name),
                     "let its RANGE begin above 0")
                .notes.push_back({declared.written->name.span, "the set-point is here"});
            return;
        }
        const std::string name =
            source.index == 0 ? "V_SOLL" : shown_register(symbols_, {Group::v, source.index});
        report_
            .add("W004", move.span,
                 fmt::format("{} is 0, the velocity of this move: the motor accepts it without moving", name),
                 "give it a velocity above 0, or select another one before, as INIT(Fast); does")
            .notes.push_back({zero.span, "it gets its value here"});
    }

    const Symbols& symbols_;
    const std::vector<DeclaredSetPoint>& points_;
    Report& report_;
    std::map<std::uint8_t, std::vector<const Send*>> given_;  ///< every value of V1..V8
    std::set<std::uint32_t> said_;
};

}  // namespace

void check_zero_speed(const Plan& plan, const Symbols& symbols, const std::vector<DeclaredSetPoint>& points,
                      Report& report) {
    SpeedWalk walk(plan, symbols, points, report);
    SpeedState at_power_up;
    at_power_up.known = true;
    walk_steps(plan, at_power_up, walk);
}

}  // namespace nplc::seqc
