#include "report/graph/graph_ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "report/table_text.h"

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

/// Branches of several copies of a step, or one that the compiler split, with the same text are one.
void merge_into(std::vector<GraphWays::Way>& ways, GraphWays::Way way) {
    const auto same = std::find_if(ways.begin(), ways.end(), [&](const GraphWays::Way& other) {
        return other.shown.condition == way.shown.condition && other.shown.actions == way.shown.actions &&
               other.shown.to == way.shown.to;
    });
    if (same == ways.end()) {
        ways.push_back(std::move(way));
        return;
    }
    same->when |= way.when;
    same->shown.on_error = same->shown.on_error && way.shown.on_error;
    if (!same->shown.by) same->shown.by = way.shown.by;
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

std::uint8_t GraphWays::box_of(std::uint8_t step) const {
    return written_ == nullptr || symbols_ == nullptr ? step : step_as_written(*symbols_, step);
}

GraphModel::Steps GraphWays::drawn_with(std::uint8_t step) const {
    GraphModel::Steps steps;
    if (box_of(step) != step) return steps;
    steps.push_back(step);
    for (std::uint8_t other = 0; other < kStepNumbers; ++other) {
        if (other != step && machine_.used.test(other) && box_of(other) == step) steps.push_back(other);
    }
    return steps;
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

/// Whether the table does what the branch is written for; a TERM may have changed that.
bool GraphWays::is_true(const Written::Branch& branch, std::uint8_t step) const {
    const std::uint8_t goes_to = branch.by_helper.value_or(branch.next.value_or(step));
    for (std::size_t c = branch.when._Find_first(); c < kCases; c = branch.when._Find_next(c)) {
        if (machine_.steps[step].in(c).next != goes_to) return false;
    }
    return branch.when.any();
}

/// Of all branches that the compiler made of one, for the copies of a step, and that lead to the same box.
Truth GraphWays::cases_with(const Written::Step& step, const Written::Branch& branch) const {
    Truth cases = branch.when;
    const std::uint8_t to = box_of(branch.next.value_or(step.number));
    for (const Written::Branch& other : step.branches) {
        const bool is_of_it = !other.is_idle && !branch.is_idle && other.condition == branch.condition;
        if (is_of_it && box_of(other.next.value_or(step.number)) == to) cases |= other.when;
    }
    return cases;
}

GraphModel::Way GraphWays::shown(const Written::Step& step, const Written::Branch& branch,
                                 const Truth& told) const {
    const WrittenText text = text_of(step);
    const std::string condition = text.condition(branch);
    GraphModel::Way way{.condition = condition,
                        .actions = text.statements(branch.statements),
                        .to = box_of(branch.next.value_or(step.number)),
                        .by = branch.by_helper};
    const bool is_as_written = (branch.own & ~told) == (cases_with(step, branch) & ~told);
    if (branch.statements.empty() && branch.when == truth_of_bit(kErrorBit)) {
        way.condition = "ERROR";
    } else if (!is_as_written || leads_to_several(step, condition)) {
        way.condition = condition_text(branch.when & ~told, told, symbols_);
    }
    return way;
}

/// Whether a way behind a branch that does nothing would be read wrongly without it, and it is true itself in
/// `reads`: no other IF of the step acts there, and no TERM.
bool GraphWays::is_needed(const Written::Step& step, const Written::Branch& idle, const Truth& reads) const {
    bool has_more = false;
    for (const Written::Branch& other : step.branches) {
        if (other.is_idle) continue;
        if ((other.when & reads).any()) return false;
        has_more = has_more || (&other > &idle && (other.own & reads).any());
    }
    for (std::size_t c = reads._Find_first(); c < kCases; c = reads._Find_next(c)) {
        const table::Outcome& outcome = machine_.steps[step.number].in(c);
        const bool stays =
            outcome.next == step.number ? outcome.is_quiet() : box_of(outcome.next) == box_of(step.number);
        if (!stays) return false;
    }
    return has_more;
}

/// A condition that the compiler split, so that its text does not identify one of the transitions.
bool GraphWays::leads_to_several(const Written::Step& step, const std::string& condition) const {
    std::optional<std::uint8_t> first;
    for (const Written::Branch& branch : step.branches) {
        if (branch.is_idle || !is_true(branch, step.number) || text_of(step).condition(branch) != condition)
            continue;
        const std::uint8_t to = box_of(branch.next.value_or(step.number));
        if (first.value_or(to) != to) return true;
        first = to;
    }
    return false;
}

std::vector<GraphWays::Way> GraphWays::of(std::uint8_t step) const {
    std::vector<Way> ways;
    const GraphModel::Steps steps = drawn_with(step);
    for (const std::uint8_t one : steps) {
        for (Way& way : ways_of(one)) merge_into(ways, std::move(way));
    }
    if (steps.size() == 1) {
        name_the_rest(ways);
    } else {
        std::stable_sort(ways.begin(), ways.end(),
                         [](const Way& a, const Way& b) { return a.place < b.place; });
    }
    return ways;
}

/// ON conditions come before a step's own branches.
std::size_t GraphWays::place_of(const Written::Branch& branch) const {
    const bool is_own =
        std::none_of(written_->everywhere.begin(), written_->everywhere.end(),
                     [&](const Written::Everywhere& on) { return on.condition == branch.condition; });
    return branch.condition.offset + (is_own ? std::size_t{source_.size()} : 0);
}

/// The transitions of a table exclude each other. Those with the shortest conditions come first, so that the
/// others need not name them in the negative; a part of a transition that depends on one bit alone is then a
/// transition of its own.
std::vector<StepTransition> GraphWays::simplest_first(std::vector<StepTransition> reactions, Truth told,
                                                      std::uint8_t step) const {
    constexpr std::size_t kMost = 12;
    std::vector<StepTransition> ordered;
    if (reactions.size() > kMost) return reactions;
    while (!reactions.empty()) {
        auto best = reactions.begin();
        const auto rank = [&](const StepTransition& reaction) {
            return std::pair(blanks_of(reaction, told), reaction.outcome.next == step);
        };
        for (auto it = best + 1; it != reactions.end(); ++it) {
            if (rank(*it) < rank(*best)) best = it;
        }
        if (const auto part = part_before(*best, reactions, told, step)) {
            ordered.push_back(*part);
            for (StepTransition& reaction : reactions) reaction.when &= ~part->when;
        } else {
            ordered.push_back(*best);
            reactions.erase(best);
        }
        told |= ordered.back().when;
    }
    return ordered;
}

std::size_t GraphWays::blanks_of(const StepTransition& reaction, const Truth& told) const {
    const std::string text = condition_text(reaction.when & ~told, told, symbols_);
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), ' '));
}

/// The part of another transition out of the step without which `next` is shorter: all cases of one bit,
/// without an error.
std::optional<StepTransition> GraphWays::part_before(const StepTransition& next,
                                                     const std::vector<StepTransition>& reactions,
                                                     const Truth& told, std::uint8_t step) const {
    const std::size_t blanks = blanks_of(next, told);
    const std::string text = condition_text(next.when & ~told, told, symbols_);
    if (text.find("NOT ") == std::string::npos || text.find(" AND ") == std::string::npos)
        return std::nullopt;
    for (std::size_t bit = 0; bit < kBits; ++bit) {
        const Truth cases = truth_of_bit(bit) & ~truth_of_bit(kErrorBit) & ~told;
        if (bit == kErrorBit || cases.none()) continue;
        for (const StepTransition& other : reactions) {
            const bool is_part = &other != &next && other.outcome.next != step &&
                                 (cases & ~other.when).none() && cases != other.when;
            if (!is_part || blanks_of(next, told | cases) >= blanks) continue;
            StepTransition part = other;
            part.when = cases;
            return part;
        }
    }
    return std::nullopt;
}

std::vector<GraphWays::Way> GraphWays::ways_of(std::uint8_t step) const {
    const Truth error = truth_of_bit(kErrorBit);
    std::vector<Way> ways;
    Truth told;
    const auto add = [&](const Truth& when, GraphModel::Way shown, bool is_written, std::size_t place) {
        shown.on_error = (when & ~error).none();
        ways.push_back({std::move(shown), when, is_written, place});
        told |= when;
    };
    if (const Written::Step* written = written_step(step)) {
        for (const Written::Branch& branch : written->branches) {
            const Truth reads = branch.own & ~told;
            const bool is_drawn = branch.is_idle ? is_needed(*written, branch, reads)
                                                 : is_true(branch, step) && (branch.when & ~told).any();
            if (!is_drawn) continue;
            add(branch.is_idle ? reads : branch.when, shown(*written, branch, told), true, place_of(branch));
        }
    }
    for (const StepTransition& reaction : simplest_first(reactions_of(machine_, step), told, step)) {
        const Truth rest = reaction.when & ~told;
        const std::uint8_t next = reaction.outcome.next;
        const bool stays_in_box = next != step && box_of(next) == box_of(step);
        if (rest.none() || stays_in_box) continue;
        add(rest,
            {.condition = condition_text(rest, told, symbols_),
             .actions = actions(step, reaction),
             .to = box_of(next)},
            false, SIZE_MAX);
    }
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

std::string GraphWays::actions(std::uint8_t step, const StepTransition& reaction) const {
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

/// "OUT Lamp, Horn BLINKING T#500ms"
std::string GraphWays::blinking_text(std::uint8_t step) const {
    const Written::Step* written = written_step(step);
    if (written == nullptr || written->blinking == 0) return {};
    return fmt::format("OUT {} BLINKING {}", outputs_list(written->blinking, symbols_),
                       text_of(*written).of(written->blink_time));
}

std::vector<std::string> GraphWays::outputs(std::uint8_t step) const {
    using Kind = OutputRule::Kind;
    const std::string blinking = blinking_text(step);
    const std::uint8_t lamps = blinking.empty() ? std::uint8_t{0} : written_step(step)->blinking;
    GraphModel::Steps steps = drawn_with(step);
    if (machine_.reachable.test(step))
        std::erase_if(steps, [this](std::uint8_t one) { return !machine_.reachable.test(one); });
    std::array<std::size_t, 4> on{};
    std::vector<std::string> texts;
    for (const std::uint8_t one : steps) {
        for (const OutputRule& rule : output_rules(machine_, one)) {
            if ((lamps >> rule.bit & 1) != 0) continue;
            if (rule.kind == Kind::on) {
                ++on[rule.bit];
                continue;
            }
            const std::string_view verb = rule.kind == Kind::sets     ? "set"
                                          : rule.kind == Kind::resets ? "reset"
                                                                      : "OUT";
            std::string text =
                fmt::format("{} {} WHEN {}", verb, output_name(rule.bit, symbols_), condition_of(rule, one));
            if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(std::move(text));
        }
    }
    std::string always_on;
    std::string as_before;  // on in some of the copies: SET has been before, or not
    for (std::uint8_t bit = 0; bit < on.size(); ++bit) {
        if (on[bit] != 0)
            append(on[bit] == steps.size() ? always_on : as_before, output_name(bit, symbols_), ", ");
    }
    if (!as_before.empty()) texts.insert(texts.begin(), as_before + " as before");
    if (!blinking.empty()) texts.insert(texts.begin(), blinking);
    if (!always_on.empty()) texts.insert(texts.begin(), "OUT " + always_on);
    return texts;
}

std::string GraphWays::made_as(std::uint8_t step) const {
    if (symbols_ == nullptr || step >= symbols_->made_for.size() || symbols_->made_for[step].empty())
        return {};
    if (const std::uint8_t of = step_as_written(*symbols_, step); of != step)
        return "copy of " + symbols_->steps[of];
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
