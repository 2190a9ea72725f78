#include "views/table_report.h"

#include <algorithm>

#include "sequencer/term.h"
#include "views/words.h"

namespace nplc::seqc {
namespace {

TableReport::Transition transition_of(std::uint8_t from, const Reaction& reaction, const Symbols* symbols,
                                      bool safe) {
    TableReport::Transition transition;
    transition.from = from;
    transition.to = reaction.outcome.next;
    transition.when = reaction.when;
    for (const auto& order : reaction.outcome.orders) transition.orders.push_back(order_text(order, symbols));
    transition.line = line_use(reaction.outcome.orders, safe);
    return transition;
}

void add_step(const Machine& machine, std::uint8_t step, const Symbols* symbols, TableReport& report) {
    if (!machine.used.test(step)) return;
    report.steps.push_back(
        {step, step_name(step, symbols), machine.steps[step].terms, machine.reachable.test(step)});
    for (const Reaction& reaction : reactions_of(machine, step)) {
        if (reaction.outcome.next == step && reaction.outcome.orders.empty()) continue;
        report.transitions.push_back(
            transition_of(step, reaction, symbols, report.settings.safe_communication));
    }
}

}  // namespace

TableReport report_of(std::span<const std::uint8_t> table, const Symbols* symbols,
                      const LineSettings& settings) {
    const Machine machine = machine_of(table);
    TableReport report;
    if (symbols != nullptr) report.symbols = *symbols;
    report.has_power_up = symbols != nullptr && !symbols->steps[0].empty();
    report.settings = settings;
    report.terms = machine.terms + 1;
    for (std::uint8_t step = 0; step < sequencer::kEndOfTable; ++step)
        add_step(machine, step, symbols, report);
    std::stable_sort(report.transitions.begin(), report.transitions.end(),
                     [](const auto& a, const auto& b) { return a.line.until_done > b.line.until_done; });
    return report;
}

}  // namespace nplc::seqc
