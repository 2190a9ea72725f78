#include <algorithm>
#include <optional>
#include <set>

#include "compiler/checker.h"
#include "compiler/orders.h"

namespace nplc::seqc {
namespace {

enum class Motion : std::uint8_t { none, place, velocity, home, end };

/// A VELOCITY without a velocity only selects.
Motion motion_of(const Send& send) {
    if (send.reg != nullptr) return Motion::none;
    switch (kind_of(send)) {
        case OrderKind::init:
        case OrderKind::stop:
            return Motion::end;
        case OrderKind::run:
            return table::velocity_taken(order_of(send)) != 0 ? Motion::velocity : Motion::none;
        case OrderKind::place:
            return Motion::place;
        case OrderKind::home:
            return Motion::home;
        default:
            return Motion::none;
    }
}

/// Homing that another order ends is reported as W014; a velocity after a velocity is one motion, and one
/// before HOME selects.
bool replaces(Motion later, Motion earlier) {
    if (earlier == Motion::velocity) return later == Motion::place || later == Motion::end;
    return earlier == Motion::place;
}

void judge(const Rule& rule, std::set<std::uint32_t>& said, Report& report) {
    const Send* move = nullptr;
    for (const Send& send : rule.action.sends) {
        const Motion motion = motion_of(send);
        if (motion == Motion::none) continue;
        if (move != nullptr && replaces(motion, motion_of(*move))) {
            if (!said.insert(send.span.offset).second) return;
            report
                .add("W031", send.span,
                     motion == Motion::end
                         ? "this ends the motion that is ordered before it in the same scan"
                         : "this replaces the move that is ordered before it in the same scan",
                     "delete one of the two, or let a step of its own wait until the first is done")
                .notes.push_back(
                    {move->span, "the motor gets this order, and the other within some milliseconds"});
            return;
        }
        move = motion == Motion::place || motion == Motion::velocity ? &send : nullptr;
    }
}

}  // namespace

/// Relative positions add up, so two of them may be intended.
void check_replaced_moves(const Plan& plan, Report& report) {
    bool relative = false;
    for_each_send(plan,
                  [&](const Send& send) { relative = relative || kind_of(send) == OrderKind::relative; });
    if (relative) return;
    std::set<std::uint32_t> said;
    for (const StepPlan& step : plan.steps) {
        for (const Rule& rule : step.rules) judge(rule, said, report);
    }
}

}  // namespace nplc::seqc
