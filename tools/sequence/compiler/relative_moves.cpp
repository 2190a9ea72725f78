#include <fmt/format.h>

#include <algorithm>
#include <bitset>
#include <cmath>

#include "compiler/checker.h"
#include "compiler/orders.h"
#include "compiler/step_walk.h"
#include "symbols/commands.h"

namespace nplc::seqc {
namespace {

constexpr double kNothing = 1e-6;  // counts; what working out with fractions leaves

using table::Group;

/// Whether selecting a position may be a relative move.
struct PositionState {
    bool known = false;
    bool relative = false;
    Span since;

    bool is_known() const { return known; }
    bool join(const PositionState& other) {
        const bool news = (other.known && !known) || (other.relative && !relative);
        if (other.relative && !relative) since = other.since;
        known = known || other.known;
        relative = relative || other.relative;
        return news;
    }
};

class RelativeWalk {
  public:
    using State = PositionState;

    RelativeWalk(const std::vector<Rounding>& roundings, const Plan& plan, Report& report)
        : roundings_(roundings), plan_(plan), report_(report) {}

    static void enter(PositionState&, const StepPlan&, const Rule&) {}

    static void apply(PositionState& state, const Send& send) {
        const OrderKind kind = kind_of(send);
        if (kind == OrderKind::absolute) state.relative = false;
        if (kind != OrderKind::relative) return;
        state.relative = true;
        state.since = send.span;
    }

    void judge(const Rule& rule, PositionState state) {
        for (const Send& send : rule.action.sends) {
            judge_send(send, state);
            apply(state, send);
        }
    }

  private:
    void judge_send(const Send& send, const PositionState& state) {
        if (send.reg != nullptr) return;
        if (const auto select = select_command(send.command)) {
            if (select->selection.group == Group::p && state.relative)
                warn(select->selection.index, send, state.since);
            return;
        }
        if (const auto move = table::relative_move(send.command)) warn(move->index, send, {});
        const auto set = table::set_used(send.command);
        if (set && state.relative) warn(*set, send, state.since);
    }

    void warn(std::uint8_t index, const Send& selection, Span since) {
        if (said_.test(index)) return;
        const Rounding* rounding = rounding_of(index);
        if (rounding == nullptr) return;
        said_.set(index);
        constexpr double kMoves = 1000;
        const double counts = std::fabs(rounding->lost) * kMoves;
        Diagnostic& d = report_.add(
            "W030", rounding->span,
            fmt::format(
                "this distance is rounded, and the errors of relative moves add up: {:.0f} moves end {:.4g} "
                "counts{} too {}",
                kMoves, counts,
                rounding->unit.empty()
                    ? ""
                    : fmt::format(" ({:.4g} {})", counts / rounding->per_unit, rounding->unit),
                (rounding->lost < 0) != rounding->is_negative ? "far" : "short"),
            rounding->makes_good
                ? "the moves of a cycle do not add up to a whole number of counts: choose a SCALE with which "
                  "they do, or find the position again with a sensor"
                : "let one move of each cycle compensate for it, as in Last AT P2 := 360 deg - 6 * Pitch;");
        d.notes.push_back({selection.span, "the move is here"});
        if (since.length != 0) d.notes.push_back({since, "positions become relative here"});
    }

    /// The rounding of a value that the program writes to P1..P8; null if each is exact or compensated by
    /// another.
    const Rounding* rounding_of(std::uint8_t index) const {
        const Rounding* found = nullptr;
        for_each_send(plan_, [&](const Send& send) {
            const auto place = send.reg == nullptr ? std::nullopt : selection_of(send.reg->number);
            if (!place || place->group != Group::p || place->index != index) return;
            for (const Rounding& rounding : roundings_) {
                const bool inside = rounding.span.offset >= send.span.offset &&
                                    rounding.span.offset < send.span.offset + send.span.length;
                if (inside && std::fabs(rounding.lost) > kNothing && !rounding.is_made_good &&
                    found == nullptr)
                    found = &rounding;
            }
        });
        return found;
    }

    const std::vector<Rounding>& roundings_;
    const Plan& plan_;
    Report& report_;
    std::bitset<9> said_;
};

}  // namespace

void check_relative_moves(const Plan& plan, const std::vector<Rounding>& roundings, Report& report) {
    RelativeWalk walk(roundings, plan, report);
    PositionState at_power_up;
    at_power_up.known = true;
    walk_steps(plan, at_power_up, walk);
}

}  // namespace nplc::seqc
