#include "report/decompile/layout.h"

#include <algorithm>
#include <array>
#include <bitset>

#include "report/decompile/vocabulary.h"
#include "table/step.h"

namespace nplc::seqc {
namespace {

using sequencer::kLastStep;
using sequencer::kTermBytes;
using sequencer::TermBytes;

using StepSet = std::bitset<64>;

StepSet named_steps(const Terms& terms) {
    StepSet named;
    for (const TermBytes& bytes : terms) {
        const sequencer::Term term = sequencer::decode(bytes);
        named.set(term.condition.step);
        if (!term.is_flex) named.set(term.fast.next_step);
    }
    named.reset(kLastStep);
    named.reset(sequencer::kEndOfTable);
    if (named.any()) named.set(0);
    return named;
}

/// Inserted before the first step with a higher number, so that numbers ascend as far as the table allows.
void insert_empty(std::vector<Part>& steps, std::uint8_t number) {
    const auto behind =
        std::find_if(steps.begin(), steps.end(), [&](const Part& p) { return p.number > number; });
    steps.insert(behind, Part{number, {}});
}

}  // namespace

Layout layout_of(std::span<const std::uint8_t> table) {
    Layout layout;
    Terms terms;
    for (const sequencer::TermView term : table::terms_of(table))
        std::copy_n(term.begin(), kTermBytes, terms.emplace_back().begin());
    std::copy_n(table.last<kTermBytes>().begin(), kTermBytes, layout.end.begin());
    StepSet missing = named_steps(terms);
    for (const TermBytes& term : terms) {
        const std::uint8_t number = sequencer::step_of(term);
        const bool goes_on = !layout.steps.empty() && layout.steps.back().number == number;
        const bool begins = number != kLastStep && missing.test(number);
        if (!layout.outside.empty() || (!goes_on && !begins)) {
            layout.outside.push_back(term);
            continue;
        }
        if (!goes_on) layout.steps.push_back({number, {}});
        missing.reset(number);
        layout.steps.back().terms.push_back(term);
    }
    for (std::uint8_t number = 0; number < kLastStep; ++number) {
        if (missing.test(number)) insert_empty(layout.steps, number);
    }
    return layout;
}

registers::Model fitting_motor(const Layout& layout) {
    using registers::Model;
    const auto fits = [&](Model model) {
        std::size_t count = 0;
        const auto add = [&](const Terms& terms) {
            for (const TermBytes& term : terms)
                count += sequencer::is_flex(term) && obstacle(term, model).empty() ? 1U : 0U;
        };
        for (const Part& part : layout.steps) add(part.terms);
        add(layout.outside);
        return count;
    };
    return fits(Model::mac800) > fits(Model::mac140) ? Model::mac800 : Model::mac140;
}

}  // namespace nplc::seqc
