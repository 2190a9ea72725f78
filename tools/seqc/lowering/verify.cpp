#include "lowering/verify.h"

#include <fmt/format.h>

#include <array>

namespace nplc::seqc {
namespace {

using sequencer::Condition;
using sequencer::FastStatement;
using sequencer::FlexStatement;
using sequencer::Term;

/// The effect of a scan in one case.
struct Done {
    std::uint8_t next = 0;  ///< the active step after the scan
    std::uint8_t outputs = 0;
    bool writes_outputs = false;
    bool clears = false;
    bool counts = false;
    bool wrong_order = false;
    std::uint16_t timer = 0;
    std::uint16_t counter = 0;
    std::size_t sent = 0;
};

bool is_order_of(const Term& term, const Send& send) {
    if (!term.is_flex) return send.reg == nullptr && term.fast.command == (send.command & 0x7F);
    if (send.reg == nullptr) return false;
    const FlexStatement& flex = term.flex;
    return flex.reg == send.reg->number && flex.longword == registers::is_32_bit(send.reg->format) &&
           flex.low_word == (send.value & 0xFFFF) && (!flex.longword || flex.high_word == send.value >> 16);
}

void apply_fast(const FastStatement& fast, Done& done) {
    if (fast.next_step != sequencer::kNoSwitch) done.next = fast.next_step;
    done.outputs = fast.outputs;
    done.writes_outputs = true;
    done.clears = fast.clears_counter;
    done.counts = fast.counts_down;
    if (fast.preset != 0) (fast.presets_counter ? done.counter : done.timer) = fast.preset;
}

class Comparison {
  public:
    Comparison(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of)
        : step_(step), outputs_of_(outputs_of) {
        static const Action kNothing{};
        Done start;
        start.next = step.number;
        done_.fill(start);
        wanted_.push_back(wanted_of(kNothing));
        for (const Rule& rule : step.rules) {
            const auto index = static_cast<std::uint16_t>(wanted_.size());
            wanted_.push_back(wanted_of(rule.action));
            for (std::size_t c = rule.when._Find_first(); c < kCases; c = rule.when._Find_next(c))
                rule_[c] = index;
        }
    }

    void apply(const Term& term) {
        const Condition& condition = term.condition;
        const std::size_t wanted = (condition.input & (condition.care | sequencer::kError)) |
                                   (condition.needs_timer_zero ? std::size_t{1} << kTimerZero : 0) |
                                   (condition.needs_counter_zero ? std::size_t{1} << kCounterZero : 0);
        const std::size_t compared = wanted | condition.care | sequencer::kError;
        const std::size_t open = (kCases - 1) & ~compared;
        std::size_t free = 0;
        do {
            apply_in(term, wanted | free);
            free = (free - open) & open;
        } while (free != 0);
    }

    bool differs(std::size_t c) const {
        const Wanted& wanted = wanted_[rule_[c]];
        const Done& done = done_[c];
        const std::uint8_t outputs = wanted.leaves ? wanted.outputs : resting(c);
        const bool must_write = wanted.leaves || !step_.conditional.empty();
        return done.next != wanted.next || done.wrong_order || done.sent != wanted.sends ||
               done.timer != wanted.timer || done.counter != wanted.counter || done.clears != wanted.clears ||
               done.counts != wanted.counts || (done.writes_outputs ? done.outputs != outputs : must_write);
    }

  private:
    /// The requirements of a rule, or of no rule, in every case in which it is true.
    struct Wanted {
        const Action* action = nullptr;
        std::uint8_t next = 0;
        std::uint8_t outputs = 0;
        bool leaves = false;
        bool clears = false;
        bool counts = false;
        std::uint16_t timer = 0;
        std::uint16_t counter = 0;
        std::size_t sends = 0;
    };

    Wanted wanted_of(const Action& action) const {
        Wanted wanted;
        wanted.action = &action;
        wanted.next = action.next.value_or(step_.number);
        wanted.leaves = wanted.next != step_.number;
        wanted.outputs = wanted.leaves ? outputs_entered(action, outputs_of_) : std::uint8_t{0};
        wanted.clears = action.clears_counter;
        wanted.counts = action.counts_down;
        wanted.timer = action.timer.value_or(0);
        wanted.counter = action.counter.value_or(0);
        wanted.sends = action.sends.size();
        return wanted;
    }

    void apply_in(const Term& term, std::size_t c) {
        Done& done = done_[c];
        if (term.is_flex || term.fast.sends) {
            const Wanted& wanted = wanted_[rule_[c]];
            const bool expected =
                done.sent < wanted.sends && is_order_of(term, wanted.action->sends[done.sent]);
            done.wrong_order = done.wrong_order || !expected;
            ++done.sent;
        }
        if (!term.is_flex) apply_fast(term.fast, done);
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
    std::vector<Wanted> wanted_;
    std::array<std::uint16_t, kCases> rule_{};  // index into `wanted_`
    std::array<Done, kCases> done_;
};

}  // namespace

std::optional<std::size_t> first_difference(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                                            const std::vector<LoweredTerm>& terms) {
    Comparison comparison(step, outputs_of);
    for (std::size_t i = 0; i + step.terms.size() < terms.size(); ++i) {
        const Term term = sequencer::decode(terms[i].bytes);
        if (term.condition.step != step.number) return 0;
        comparison.apply(term);
    }
    for (std::size_t c = 0; c < kCases; ++c) {
        if (comparison.differs(c)) return c;
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
