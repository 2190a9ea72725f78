#include "lowering/reduced_step.h"

#include <algorithm>

namespace nplc::seqc {
namespace {

constexpr std::size_t kHalfBits = kBits - 1;
using Wanted = std::array<std::uint16_t, kCases / 2>;  // by case without the bit of ERROR

/// The bit of a case for bit `k` of a case without ERROR.
std::size_t bit_of(std::size_t k) {
    return k < kErrorBit ? k : k + 1;
}

std::size_t case_of(std::size_t branch_case, bool error) {
    const std::size_t low = branch_case & 0x7F;
    return low | (error ? std::size_t{1} << kErrorBit : 0) | (branch_case >> 7 << kTimerZero);
}

Behaviour behaviour_of(const StepPlan& step, const Action* action, std::uint8_t resting,
                       const std::vector<std::uint8_t>& outputs_of) {
    Behaviour result;
    result.action = action;
    result.next = action != nullptr ? action->next.value_or(step.number) : step.number;
    result.leaves = result.next != step.number;
    result.outputs = result.leaves ? outputs_entered(*action, outputs_of) : resting;
    result.writes = result.leaves || !step.conditional.empty() || (action != nullptr && action->counts());
    return result;
}

/// Collects the behaviours, and which of them each case has.
class Sorter {
  public:
    Sorter(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of)
        : step_(step), outputs_of_(outputs_of) {
        resting_.fill(step.outputs);
        for (const ConditionalOutput& conditional : step.conditional) {
            const Truth& when = conditional.when;
            for (std::size_t c = when._Find_first(); c < kCases; c = when._Find_next(c))
                resting_[c] |= conditional.outputs;
        }
        for (std::size_t i = 0; i < step.rules.size(); ++i) {
            const Truth& when = step.rules[i].when;
            for (std::size_t c = when._Find_first(); c < kCases; c = when._Find_next(c))
                rule_[c] = static_cast<std::uint16_t>(i + 1);
        }
    }

    ReducedStep error_branch(bool error) {
        ReducedStep result;
        result.error = error;
        result.step = &step_;
        Wanted wanted;
        std::size_t last = kCases;
        for (std::size_t c = 0; c < wanted.size(); ++c) {
            const std::size_t full = case_of(c, error);
            const bool same = last < kCases && rule_[full] == rule_[last] && resting_[full] == resting_[last];
            wanted[c] = same ? wanted[c - 1] : index_of(result.behaviours, full);
            last = full;
        }
        reduce(result, wanted);
        return result;
    }

  private:
    std::uint16_t index_of(std::vector<Behaviour>& list, std::size_t c) const {
        const Action* action = rule_[c] != 0 ? &step_.rules[rule_[c] - 1U].action : nullptr;
        const Behaviour wanted = behaviour_of(step_, action, resting_[c], outputs_of_);
        const auto found = std::find(list.begin(), list.end(), wanted);
        const auto index = static_cast<std::uint16_t>(found - list.begin());
        if (found == list.end()) list.push_back(wanted);
        return index;
    }

    static bool matters(const Wanted& wanted, std::size_t k) {
        const std::size_t bit = std::size_t{1} << k;
        for (std::size_t block = 0; block < wanted.size(); block += 2 * bit) {
            const auto* low = &wanted[block];
            if (!std::equal(low, low + bit, low + bit)) return true;
        }
        return false;
    }

    static void reduce(ReducedStep& error_branch, const Wanted& wanted) {
        std::vector<std::size_t> kept;
        for (std::size_t k = 0; k < kHalfBits; ++k) {
            if (!matters(wanted, k)) continue;
            kept.push_back(k);
            error_branch.bits.push_back(static_cast<std::uint8_t>(bit_of(k)));
            if (k < kErrorBit) ++error_branch.inputs;
        }
        error_branch.wanted.resize(std::size_t{1} << kept.size());
        for (std::size_t reduced = 0; reduced < error_branch.wanted.size(); ++reduced) {
            std::size_t c = 0;
            for (std::size_t i = 0; i < kept.size(); ++i) c |= ((reduced >> i) & 1U) << kept[i];
            error_branch.wanted[reduced] = wanted[c];
        }
    }

    const StepPlan& step_;
    const std::vector<std::uint8_t>& outputs_of_;
    std::array<std::uint8_t, kCases> resting_{};
    std::array<std::uint16_t, kCases> rule_{};  // 0: none
};

}  // namespace

std::uint8_t Behaviour::output_byte() const {
    unsigned byte = outputs;
    if (action != nullptr && action->clears_counter) byte |= 0x40U;
    if (action != nullptr && action->counts_down) byte |= 0x80U;
    return static_cast<std::uint8_t>(byte);
}

std::array<ReducedStep, 2> error_branches_of(const StepPlan& step,
                                             const std::vector<std::uint8_t>& outputs_of) {
    Sorter sorter(step, outputs_of);
    return {sorter.error_branch(false), sorter.error_branch(true)};
}

}  // namespace nplc::seqc
