#include "terms/verify.h"

#include <fmt/format.h>

#include <array>

#include "terms/scan.h"

namespace nplc::seqc {
namespace {

using sequencer::MotorOrder;

MotorOrder order_of(const Send& send) {
    if (send.reg == nullptr) return {.command = static_cast<std::uint8_t>(send.command & 0x7F)};
    const bool longword = registers::is_32_bit(send.reg->format);
    return {.is_flex = true,
            .reg = send.reg->number,
            .longword = longword,
            .value = longword ? send.value : send.value & 0xFFFF};
}

/// What the rules want of a scan, but for the outputs.
Outcome wanted_by(const Action& action, std::uint8_t own_step) {
    Outcome outcome;
    outcome.next = action.next.value_or(own_step);
    outcome.timer = action.timer.value_or(0);
    outcome.counter_preset = action.counter.value_or(0);
    outcome.counter = action.clears_counter         ? CounterChange::clear
                      : outcome.counter_preset != 0 ? CounterChange::preset
                      : action.counts_down          ? CounterChange::count_down
                                                    : CounterChange::none;
    for (const Send& send : action.sends) outcome.orders.push_back(order_of(send));
    return outcome;
}

class Comparison {
  public:
    Comparison(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of)
        : step_(step), outputs_of_(outputs_of) {
        wanted_.push_back(wanted_by({}, step.number));
        for (const Rule& rule : step.rules) {
            for (std::size_t c = 0; c < kCases; ++c) {
                if (rule.when.test(c)) rule_of_[c] = wanted_.size();
            }
            wanted_.push_back(wanted_by(rule.action, step.number));
        }
    }

    bool differs(const StepBehaviour& behaviour, std::size_t c) const {
        Outcome wanted = wanted_[rule_of_[c]];
        const bool leaves = wanted.next != step_.number;
        const std::uint8_t outputs = leaves ? entered(wanted.next) : resting(c);
        const bool must_write = leaves || !step_.conditional.empty();
        const Outcome& done = behaviour.in(c);
        if (must_write || done.outputs) wanted.outputs = outputs;
        return done != wanted;
    }

  private:
    std::uint8_t entered(std::uint8_t next) const {
        return next < outputs_of_.size() ? outputs_of_[next] : std::uint8_t{0};
    }

    std::uint8_t resting(std::size_t c) const {
        std::uint8_t outputs = step_.outputs;
        for (const ConditionalOutput& conditional : step_.conditional) {
            if (conditional.when.test(c)) outputs |= conditional.outputs;
        }
        return outputs;
    }

    const StepPlan& step_;
    const std::vector<std::uint8_t>& outputs_of_;
    std::vector<Outcome> wanted_;  ///< of no rule, then of each rule
    std::array<std::size_t, kCases> rule_of_{};
};

}  // namespace

std::optional<std::size_t> first_difference(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                                            const std::vector<LoweredTerm>& terms) {
    std::vector<sequencer::TermView> own;
    for (std::size_t i = 0; i + step.terms.size() < terms.size(); ++i) {
        if (sequencer::step_of(terms[i].bytes) != step.number) return 0;
        own.emplace_back(terms[i].bytes);
    }
    const Comparison comparison(step, outputs_of);
    const StepBehaviour behaviour = behaviour_of(step.number, own);
    for (std::size_t c = 0; c < kCases; ++c) {
        if (comparison.differs(behaviour, c)) return c;
    }
    return std::nullopt;
}

void check_terms(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                 const std::vector<LoweredTerm>& terms, Report& report) {
    const auto found = first_difference(step, outputs_of, terms);
    if (!found) return;
    report.error(
        "E099", step.span,
        fmt::format("internal error of seqc: its terms for '{}' do something else than the program "
                    "when inputs, IN_POS and ERROR are 16#{:02X}, TIMER.Q = {}, COUNTER.Q = {}",
                    step.name, *found & 0xFF, (*found >> kTimerZero) & 1, (*found >> kCounterZero) & 1),
        "no table is written; please report this with the program, and write the step in another "
        "way, with fewer branches");
}

}  // namespace nplc::seqc
