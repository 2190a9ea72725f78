// Outputs that SET switched on and that stay on after a guard or an ERROR.
#include <fmt/format.h>

#include <array>
#include <deque>
#include <set>
#include <utility>
#include <vector>

#include "compiler/checker.h"
#include "compiler/guards.h"
#include "compiler/step_walk.h"

namespace nplc::seqc {
namespace {

constexpr std::size_t kOutputCount = 4;

/// By output, the SET that switched it on; length 0: it is off on every way.
struct OnState {
    bool known = false;
    std::array<Span, kOutputCount> set_at{};

    bool is_known() const { return known; }
    bool join(const OnState& other) {
        bool news = !known;
        known = true;
        for (std::size_t i = 0; i < kOutputCount; ++i) {
            if (set_at[i].length != 0 || other.set_at[i].length == 0) continue;
            set_at[i] = other.set_at[i];
            news = true;
        }
        return news;
    }
};

bool has_bit(std::uint8_t outputs, std::size_t output) {
    return ((unsigned{outputs} >> output) & 1U) != 0;
}

class OnWalk {
  public:
    using State = OnState;

    OnWalk(const ast::Program& program, const Plan& plan, const Symbols& symbols, Report& report)
        : program_(program), plan_(plan), symbols_(symbols), report_(report) {
        for (const StepPlan& step : plan.steps) {
            for (const Rule& rule : step.rules) reset_somewhere_ |= rule.action.resets;
        }
    }

    void enter(OnState& state, const StepPlan& step, const Rule& rule) {
        step_ = &step;
        for (std::size_t i = 0; i < kOutputCount; ++i) {
            if (has_bit(rule.action.resets, i)) state.set_at[i] = {};
            if (has_bit(rule.action.sets, i)) state.set_at[i] = rule.action.output_span;
        }
    }

    static void apply(OnState&, const Send&) {}

    void judge(const Rule& rule, const OnState& state) {
        if (!leaves(*step_, rule)) return;
        for_each_part(rule, [&](const Truth& when, Span condition) {
            if (!is_of_on(condition) && !needs_error(when)) return;
            for (std::size_t i = 0; i < kOutputCount; ++i) {
                if (state.set_at[i].length == 0 || !has_bit(reset_somewhere_, i) ||
                    has_bit(rule.action.sets, i) || is_reset_behind(*rule.action.next, i))
                    continue;
                warn(i, state.set_at[i], condition);
            }
        });
    }

  private:
    /// The condition of an ON for many steps, or of ON ERROR.
    bool is_of_on(Span condition) const {
        return is_guard(program_, condition) ||
               (program_.on_error && program_.on_error->span == condition && condition.length != 0);
    }

    /// Up to where it is SET again; a further guard or ERROR is no way.
    bool is_reset_behind(std::uint8_t number, std::size_t output) const {
        std::set<std::uint8_t> seen = {number};
        for (std::deque<std::uint8_t> open = {number}; !open.empty(); open.pop_front()) {
            const StepPlan* step = step_numbered(plan_, open.front());
            if (step == nullptr) continue;
            for (const Rule& rule : step->rules) {
                bool is_way = false;
                for_each_part(rule,
                              [&](const Truth&, Span condition) { is_way = is_way || !is_of_on(condition); });
                if (!is_way) continue;
                if (has_bit(rule.action.resets, output)) return true;
                if (has_bit(rule.action.sets, output) || !rule.action.next) continue;
                if (seen.insert(*rule.action.next).second) open.push_back(*rule.action.next);
            }
        }
        return false;
    }

    void warn(std::size_t output, Span set_at, Span fall) {
        if (!said_.insert({set_at.offset, output}).second) return;
        const std::string name =
            symbols_.outputs[output].empty() ? fmt::format("OUT{}", output) : symbols_.outputs[output];
        report_
            .add("W043", set_at,
                 fmt::format("'{}' may stay on: where a guard or an ERROR leads, no step resets it", name),
                 fmt::format("write RESET {}; there, or behind it in front of the next SET; or ALLOW W043 "
                             "BECAUSE 'reason'; in the step",
                             name))
            .notes.push_back({fall, "this may end the step while it is on"});
    }

    const ast::Program& program_;
    const Plan& plan_;
    const Symbols& symbols_;
    Report& report_;
    std::uint8_t reset_somewhere_ = 0;  ///< outputs for which W024 is reported
    const StepPlan* step_ = nullptr;
    std::set<std::pair<std::uint32_t, std::size_t>> said_;
};

}  // namespace

void check_left_on(const ast::Program& program, const Plan& plan, const Symbols& symbols, Report& report) {
    if (has_terms(plan)) return;
    OnWalk walk(program, plan, symbols, report);
    OnState at_power_up;
    at_power_up.known = true;
    walk_steps(plan, at_power_up, walk);
}

}  // namespace nplc::seqc
