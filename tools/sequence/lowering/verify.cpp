#include "lowering/verify.h"

#include <fmt/format.h>

#include <array>

#include "compiler/orders.h"
#include "table/step.h"

namespace nplc::seqc {
namespace {

std::uint8_t resting_in(std::size_t c, const StepPlan& step) {
    std::uint8_t outputs = step.outputs;
    for (const ConditionalOutput& conditional : step.conditional) {
        if (conditional.when.test(c)) outputs |= conditional.outputs;
    }
    return outputs;
}

/// The outcome that a rule, or no rule, requires in every case in which it is true; the outputs only if it
/// leaves the step.
table::Outcome wanted_of(const Action& action, const StepPlan& step,
                         const std::vector<std::uint8_t>& outputs_of) {
    table::Outcome wanted;
    wanted.next = action.next.value_or(step.number);
    if (wanted.next != step.number) wanted.outputs = outputs_entered(action, outputs_of);
    wanted.timer = action.timer.value_or(0);
    wanted.counter_preset = action.clears_counter ? std::uint16_t{0} : action.counter.value_or(0);
    wanted.counter = action.clears_counter        ? table::CounterChange::clear
                     : wanted.counter_preset != 0 ? table::CounterChange::preset
                     : action.counts_down         ? table::CounterChange::count_down
                                                  : table::CounterChange::none;
    for (const Send& send : action.sends) wanted.orders.push_back(order_of(send));
    return wanted;
}

/// Whether two outcomes, given by their numbers, are equal apart from the outputs.
class Comparison {
  public:
    Comparison(const std::vector<table::Outcome>& wanted, const std::vector<table::Outcome>& done)
        : wanted_(wanted), done_(done), known_(wanted.size() * done.size()) {}

    bool is_same(std::size_t wanted, std::size_t done) {
        auto& known = known_[wanted * done_.size() + done];
        if (!known) {
            table::Outcome other = done_[done];
            other.outputs = wanted_[wanted].outputs;
            known = other == wanted_[wanted];
        }
        return *known;
    }

  private:
    const std::vector<table::Outcome>& wanted_;
    const std::vector<table::Outcome>& done_;
    std::vector<std::optional<bool>> known_;
};

}  // namespace

std::optional<std::size_t> first_difference(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                                            const std::vector<LoweredTerm>& terms) {
    std::vector<sequencer::TermView> own;
    for (std::size_t i = 0; i + step.terms.size() < terms.size(); ++i) {
        own.emplace_back(terms[i].bytes);
        if (sequencer::step_of(own.back()) != step.number) return 0;
    }
    const table::Step done = table::step_of(step.number, own);

    std::vector<table::Outcome> wanted = {wanted_of({}, step, outputs_of)};
    std::array<std::uint16_t, kCases> rule_in{};  // index into `wanted`
    for (const Rule& rule : step.rules) {
        for (std::size_t c = rule.when._Find_first(); c < kCases; c = rule.when._Find_next(c))
            rule_in[c] = static_cast<std::uint16_t>(wanted.size());
        wanted.push_back(wanted_of(rule.action, step, outputs_of));
    }
    Comparison comparison(wanted, done.outcomes);
    for (std::size_t c = 0; c < kCases; ++c) {
        const table::Outcome& want = wanted[rule_in[c]];
        const std::optional<std::uint8_t> outputs = done.in(c).outputs;
        const bool must_write = want.outputs || !step.conditional.empty();
        const std::uint8_t wanted_outputs = want.outputs ? *want.outputs : resting_in(c, step);
        const bool differs = outputs ? *outputs != wanted_outputs : must_write;
        if (differs || !comparison.is_same(rule_in[c], done.of_case[c])) return c;
    }
    return std::nullopt;
}

void check_terms(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                 const std::vector<LoweredTerm>& terms, Report& report) {
    const auto found = first_difference(step, outputs_of, terms);
    if (!found) return;
    report.add(
        "E099", step.span,
        fmt::format("internal error of seqc: its terms for '{}' do something else than the program "
                    "when inputs, IN_POS and ERROR are 16#{:02X}, TIMER.Q = {}, COUNTER.Q = {}",
                    step.name, *found & 0xFF, (*found >> kTimerZero) & 1, (*found >> kCounterZero) & 1),
        "no table is written; please report this with the program, and write the step in another "
        "way, with fewer branches");
}

}  // namespace nplc::seqc
