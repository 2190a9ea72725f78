#include "lowering/lower.h"

#include <algorithm>

#include "lowering/plain.h"
#include "lowering/reduced_step.h"
#include "lowering/shorten.h"
#include "lowering/verify.h"

namespace nplc::seqc {
namespace {

/// `plain` with the terms of each reduced step replaced by a shorter form where there is one.
std::vector<LoweredTerm> shortened(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                                   const std::vector<LoweredTerm>& plain) {
    const std::size_t made = plain.size() - step.terms.size();
    std::vector<LoweredTerm> result(plain.begin(), plain.begin() + static_cast<std::ptrdiff_t>(made));
    for (const ReducedStep& error_branch : error_branches_of(step, outputs_of)) {
        const auto in_branch = [&](const LoweredTerm& term) {
            const sequencer::Condition condition = sequencer::decode(term.bytes).condition;
            return ((condition.input & sequencer::kError) != 0) == error_branch.error;
        };
        const auto count = std::count_if(result.begin(), result.end(), in_branch);
        const std::vector<LoweredTerm> better = shorten(error_branch, static_cast<std::size_t>(count));
        if (better.empty()) continue;
        std::erase_if(result, in_branch);
        result.insert(result.end(), better.begin(), better.end());
    }
    result.insert(result.end(), plain.begin() + static_cast<std::ptrdiff_t>(made), plain.end());
    return result;
}

}  // namespace

std::vector<LoweredTerm> lower(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of,
                               Report& report) {
    const std::vector<LoweredTerm> plain = plain_terms(step, outputs_of);
    std::vector<LoweredTerm> shortest = shortened(step, outputs_of, plain);
    if (shortest.size() < plain.size() && !first_difference(step, outputs_of, shortest)) return shortest;
    check_terms(step, outputs_of, plain, report);
    return plain;
}

}  // namespace nplc::seqc
