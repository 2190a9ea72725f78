#include "table/step.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "table/terms.h"

namespace nplc::table {
namespace {

using sequencer::Pending;
using sequencer::TermView;

/// What the true terms of a scan leave behind.
struct Done {
    Pending pending;
    std::vector<std::uint16_t> senders;  ///< terms that send
    bool operator==(const Done&) const = default;
};

struct DoneHash {
    std::size_t operator()(const Done& done) const {
        std::size_t hash = done.pending.next_step | (std::size_t{done.pending.output_byte} << 8U);
        const auto mix = [&hash](std::size_t value) { hash = (hash ^ value) * 0x9E3779B97F4A7C15U; };
        mix(done.pending.timer_preset);
        mix(done.pending.counter_preset);
        for (const std::uint16_t term : done.senders) mix(term);
        return hash ^ (hash >> 29U);
    }
};

/// Cases in which the same terms are true.
struct Class {
    Done done;
    Cases cases;
};

/// Splits the classes by whether the term is true.
void execute(const std::vector<TermView>& own, std::uint16_t index, std::vector<Class>& classes) {
    const TermView term = own[index];
    const Cases when = cases_of(term);
    const std::size_t count = classes.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Cases within = classes[i].cases & when;
        if (within.none()) continue;
        if (within != classes[i].cases) {
            classes.push_back({classes[i].done, classes[i].cases & ~when});
            classes[i].cases = within;
        }
        Done& done = classes[i].done;
        if (!sequencer::is_flex(term)) done.pending.fold(term);
        if (sequencer::has_order(term)) done.senders.push_back(index);
    }
}

CounterChange counter_change(const Pending& pending) {
    if ((pending.output_byte & 0x40) != 0) return CounterChange::clear;
    if (pending.counter_preset != 0) return CounterChange::preset;
    return (pending.output_byte & 0x80) != 0 ? CounterChange::count_down : CounterChange::none;
}

Outcome outcome_of(const Done& done, std::uint8_t step, const std::vector<TermView>& own) {
    const Pending& pending = done.pending;
    Outcome outcome;
    outcome.next = pending.next_step == sequencer::kNoSwitch ? step : pending.next_step;
    for (const std::uint16_t index : done.senders) outcome.orders.push_back(sequencer::order_of(own[index]));
    if (!pending.has_output) return outcome;
    outcome.outputs = static_cast<std::uint8_t>(pending.output_byte & 0x0F);
    outcome.timer = pending.timer_preset;
    outcome.counter = counter_change(pending);
    if (outcome.counter == CounterChange::preset) outcome.counter_preset = pending.counter_preset;
    return outcome;
}

std::array<Cases, kKeyBits> make_bits() {
    std::array<Cases, kKeyBits> bits;
    for (std::size_t key = 0; key < sequencer::kKeys; ++key) {
        for (unsigned bit = 0; bit < kKeyBits; ++bit) bits[bit][key] = ((key >> bit) & 1U) != 0;
    }
    return bits;
}

}  // namespace

const Cases& cases_with(unsigned key_bit) {
    static const std::array<Cases, kKeyBits> bits = make_bits();
    return bits[key_bit];
}

Cases cases_of(TermView term) {
    const sequencer::Condition condition = sequencer::decode(term).condition;
    const unsigned compared = condition.care | unsigned{sequencer::kError};
    Cases cases = ~Cases{};
    for (unsigned bit = 0; bit < kTimerZero; ++bit) {
        if (((compared >> bit) & 1U) == 0) continue;
        cases &= ((condition.input >> bit) & 1U) != 0 ? cases_with(bit) : ~cases_with(bit);
    }
    if (condition.needs_timer_zero) cases &= cases_with(kTimerZero);
    if (condition.needs_counter_zero) cases &= cases_with(kCounterZero);
    return cases;
}

Step step_of(std::uint8_t step, std::span<const TermView> terms) {
    std::vector<TermView> own;
    std::copy_if(terms.begin(), terms.end(), std::back_inserter(own),
                 [&](TermView term) { return sequencer::step_of(term) == step; });
    std::vector<Class> classes(1);
    classes[0].cases.set();
    for (std::size_t i = 0; i < own.size(); ++i) execute(own, static_cast<std::uint16_t>(i), classes);
    std::sort(classes.begin(), classes.end(),
              [](const Class& a, const Class& b) { return a.cases._Find_first() < b.cases._Find_first(); });

    Step result;
    result.number = step;
    result.terms = own.size();
    for (const TermView term : own) result.compared |= sequencer::decode(term).condition.care;
    std::unordered_map<Done, std::uint16_t, DoneHash> known;
    for (Class& one : classes) {
        const auto [found, is_new] =
            known.try_emplace(std::move(one.done), static_cast<std::uint16_t>(result.outcomes.size()));
        if (is_new) result.outcomes.push_back(outcome_of(found->first, step, own));
        const Cases& cases = one.cases;
        for (std::size_t key = cases._Find_first(); key < cases.size(); key = cases._Find_next(key))
            result.of_case[key] = found->second;
    }
    return result;
}

std::vector<TermView> terms_of(std::span<const std::uint8_t> table) {
    std::vector<TermView> terms;
    for (std::size_t at = 0; at + sequencer::kTermBytes <= table.size(); at += sequencer::kTermBytes) {
        const TermView term = table.subspan(at).first<sequencer::kTermBytes>();
        if (sequencer::is_end(term)) break;
        terms.push_back(term);
    }
    return terms;
}

std::size_t length_of(std::span<const std::uint8_t> table) {
    const std::size_t length = (terms_of(table).size() + 1) * sequencer::kTermBytes;
    return length <= table.size() ? length : 0;
}

}  // namespace nplc::table
