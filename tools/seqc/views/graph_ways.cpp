#include "views/graph_ways.h"

#include <fmt/format.h>

#include <algorithm>

#include "views/table_text.h"

namespace nplc::seqc {
namespace {

/// "A; B": the orders, with the program's names and units.
std::string named_texts(const table::Outcome& outcome, const Symbols* symbols) {
    std::string text;
    for (const auto& order : outcome.orders) append(text, named_order_text(order, symbols), "; ");
    table::Outcome rest = outcome;
    rest.orders.clear();
    for (const std::string& part : action_texts(rest, symbols)) append(text, part, "; ");
    return text;
}

}  // namespace

GraphWays::GraphWays(const Machine& machine, const Symbols* symbols, const GraphSource& source)
    : machine_(machine),
      symbols_(symbols),
      written_(source.written),
      source_(source.text),
      text_(source.text),
      power_up_(power_up_orders(machine)) {
    for (std::uint8_t step = 0; step < kStepNumbers; ++step) entries_[step] = entry_of(machine, step);
}

/// A compiler-generated copy has the text of its original step.
WrittenText GraphWays::text_of(const Written::Step& step) const {
    if (written_ == nullptr || symbols_ == nullptr || step.number >= symbols_->made_for.size()) return text_;
    const std::string_view made_for = symbols_->made_for[step.number];
    for (const Written::Step& other : written_->steps) {
        const bool is_it = &other == &step ||
                           made_for.starts_with(fmt::format("copy of '{}' ", symbols_->steps[other.number]));
        if (is_it && !other.arguments.empty()) return {source_, other.arguments};
    }
    return text_;
}

const Written::Step* GraphWays::written_step(std::uint8_t step) const {
    if (written_ == nullptr) return nullptr;
    const auto found = std::find_if(written_->steps.begin(), written_->steps.end(),
                                    [&](const Written::Step& s) { return s.number == step; });
    return found == written_->steps.end() ? nullptr : &*found;
}

/// Whether the table does what the branch says; a TERM may have changed that.
bool GraphWays::is_true(const Written::Branch& branch, std::uint8_t step) const {
    const std::uint8_t goes_to = branch.by_helper.value_or(branch.next.value_or(step));
    for (std::size_t c = branch.when._Find_first(); c < kCases; c = branch.when._Find_next(c)) {
        if (machine_.steps[step].in(c).next != goes_to) return false;
    }
    return branch.when.any();
}

GraphModel::Way GraphWays::shown(const Written::Step& step, const Written::Branch& branch,
                                 const Truth& told) const {
    const WrittenText text = text_of(step);
    const std::string condition = text.condition(branch);
    GraphModel::Way way{.condition = condition,
                        .actions = text.statements(branch.statements),
                        .to = branch.next.value_or(step.number),
                        .by = branch.by_helper};
    if (branch.statements.empty() && branch.when == truth_of_bit(kErrorBit)) {
        way.condition = "ERROR";
    } else if (leads_to_several(step, condition)) {
        way.condition = condition_text(branch.when & ~told, told, symbols_);
    }
    return way;
}

/// A condition that the compiler split, so that its text does not identify one of the transitions.
bool GraphWays::leads_to_several(const Written::Step& step, const std::string& condition) const {
    std::optional<std::uint8_t> first;
    for (const Written::Branch& branch : step.branches) {
        if (!is_true(branch, step.number) || text_of(step).condition(branch) != condition) continue;
        const std::uint8_t to = branch.next.value_or(step.number);
        if (first.value_or(to) != to) return true;
        first = to;
    }
    return false;
}

std::vector<GraphWays::Way> GraphWays::of(std::uint8_t step) const {
    const Truth error = truth_of_bit(kErrorBit);
    std::vector<Way> ways;
    Truth told;
    const auto add = [&](const Truth& when, GraphModel::Way shown, bool is_written) {
        shown.on_error = (when & ~error).none();
        ways.push_back({std::move(shown), when, is_written});
        told |= when;
    };
    if (const Written::Step* written = written_step(step)) {
        for (const Written::Branch& branch : written->branches) {
            if (!is_true(branch, step)) continue;
            add(branch.when, shown(*written, branch, told), true);
        }
    }
    for (const Reaction& reaction : reactions_of(machine_, step)) {
        const Truth rest = reaction.when & ~told;
        if (rest.none()) continue;
        add(rest,
            {.condition = condition_text(rest, told, symbols_),
             .actions = actions(step, reaction),
             .to = reaction.outcome.next},
            false);
    }
    name_the_rest(ways);
    return ways;
}

/// ELSE before the last transition is written in full if the compiler added one after it.
void GraphWays::name_the_rest(std::vector<Way>& ways) const {
    Truth told;
    for (std::size_t i = 0; i + 1 < ways.size(); ++i) {
        std::string& condition = ways[i].shown.condition;
        if (condition == "ELSE") condition = condition_text(ways[i].when & ~told, told, symbols_);
        told |= ways[i].when;
    }
}

std::string GraphWays::actions(std::uint8_t step, const Reaction& reaction) const {
    table::Outcome outcome = reaction.outcome;
    auto& orders = outcome.orders;
    if (outcome.next != step) {
        const Entry& entry = entries_[outcome.next];
        orders.resize(orders.size() - entry.orders.size());
        if (entry.timer != 0) outcome.timer = 0;
        if (entry.counter_preset != 0) outcome.counter = table::CounterChange::none;
        if (step == 0)
            orders.erase(orders.begin(), orders.begin() + static_cast<std::ptrdiff_t>(power_up_.size()));
    }
    std::string text = named_texts(outcome, symbols_);
    for (std::uint8_t bit = 0; bit < 4; ++bit) {
        if (((reaction.outputs_shown >> bit) & 1) == 0) continue;
        const bool on = ((*outcome.outputs >> bit) & 1) != 0;
        append(text, fmt::format("{} {}", output_name(bit, symbols_), on ? "on" : "off"), "; ");
    }
    return text;
}

std::vector<std::string> GraphWays::entry(std::uint8_t step) const {
    std::vector<std::string> lines;
    if (const Written::Step* written = written_step(step)) {
        const WrittenText own = text_of(*written);
        for (const Span span : written->entry) {
            const std::string text = step == 0 ? own.value(span) : own.statements({span});
            lines.push_back(step == 0 ? text : "ENTRY " + text);
        }
        return lines;
    }
    table::Outcome outcome;
    outcome.orders = step == 0 ? power_up_ : entries_[step].orders;
    outcome.timer = entries_[step].timer;
    outcome.counter_preset = entries_[step].counter_preset;
    if (outcome.counter_preset != 0) outcome.counter = table::CounterChange::preset;
    for (const auto& order : outcome.orders) lines.push_back(named_order_text(order, symbols_));
    outcome.orders.clear();
    for (const std::string& text : action_texts(outcome, symbols_)) lines.push_back(text);
    if (step != 0) {
        for (std::string& line : lines) line = "ENTRY " + line;
    }
    return lines;
}

/// The condition as written in the program, if the table implements exactly that.
std::string GraphWays::condition_of(const OutputRule& rule, std::uint8_t step) const {
    const Written::Step* written = written_step(step);
    if (written != nullptr && rule.kind == OutputRule::Kind::follows) {
        for (const Written::Output& output : written->outputs) {
            const bool is_of_it = ((output.outputs >> rule.bit) & 1) != 0;
            if (is_of_it && (output.when & ~rule.open) == (rule.when & ~rule.open))
                return text_of(*written).of(output.condition);
        }
    }
    return condition_text(rule.when, rule.open, symbols_);
}

std::vector<std::string> GraphWays::outputs(std::uint8_t step) const {
    using Kind = OutputRule::Kind;
    std::string always_on;
    std::vector<std::string> texts;
    for (const OutputRule& rule : output_rules(machine_, step)) {
        const std::string name = output_name(rule.bit, symbols_);
        if (rule.kind == Kind::on) {
            append(always_on, name, ", ");
            continue;
        }
        const std::string_view verb = rule.kind == Kind::sets     ? "set"
                                      : rule.kind == Kind::resets ? "reset"
                                                                  : "OUT";
        texts.push_back(fmt::format("{} {} WHEN {}", verb, name, condition_of(rule, step)));
    }
    if (!always_on.empty()) texts.insert(texts.begin(), "OUT " + always_on);
    return texts;
}

std::string GraphWays::made_as(std::uint8_t step) const {
    if (symbols_ == nullptr || step >= symbols_->made_for.size() || symbols_->made_for[step].empty())
        return {};
    const auto of = symbols_->copy_of[step];
    if (of) return "copy of " + symbols_->steps[*of];
    const std::string& why = symbols_->made_for[step];
    return why.substr(0, why.find_first_of(":,"));
}

std::optional<std::string> GraphWays::where_of(std::string_view condition) const {
    if (written_ == nullptr) return std::nullopt;
    const auto found =
        std::find_if(written_->everywhere.begin(), written_->everywhere.end(),
                     [&](const Written::Everywhere& on) { return text_.of(on.condition) == condition; });
    if (found == written_->everywhere.end()) return std::nullopt;
    return text_.of(found->where);
}

}  // namespace nplc::seqc
