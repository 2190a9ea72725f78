#include "compiler/step_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "language/names.h"
#include "sequencer/term.h"

namespace nplc::seqc {
namespace {

constexpr std::uint8_t kNone = sequencer::kLastStep;

}  // namespace

void StepNames::declare(const ast::Program& program, Symbols& symbols) {
    for (const ast::Sequence& sequence : program.sequences) {
        sequences_.push_back(sequence.name.text);
        for (const ast::Step& inner : sequence.steps)
            inner_steps_.emplace_back(inner.name.text, sequence.name.text);
    }
    for (const ast::Group& group : program.groups) groups_.push_back(group.name.text);
    steps_missing_ = program.steps_missing;
    for (const ast::Step& step : program.steps) {
        const auto [earlier, is_new] = places_.try_emplace(upper(step.name.text), steps_.size());
        if (!is_new) {
            report_
                .add("E020", step.name.span, fmt::format("step '{}' stands twice", step.name.text),
                     "give one of them another name")
                .notes.push_back({steps_[earlier->second]->name.span, "the first one is here"});
            continue;
        }
        steps_.push_back(&step);
    }
    number_all(symbols);
}

const ast::Step* StepNames::numbered(std::uint8_t number) const {
    const auto found = std::find(numbers_.begin(), numbers_.end(), number);
    if (number == kNone || found == numbers_.end()) return nullptr;
    return steps_[static_cast<std::size_t>(found - numbers_.begin())];
}

const ast::Step* StepNames::named(std::string_view name) const {
    const auto place = places_.find(upper(name));
    return place == places_.end() ? nullptr : steps_[place->second];
}

bool StepNames::has(std::string_view name) const {
    return places_.contains(upper(name));
}

std::optional<std::uint8_t> StepNames::number_of(const ast::Name& name,
                                                 const std::vector<std::string_view>& groups) {
    const auto place = places_.find(upper(name.text));
    if (place != places_.end()) return numbers_[place->second];
    if (steps_missing_) return std::nullopt;
    if (report_.full_of_errors()) {  // not shown: a guess among many names would take long
        report_.add("E021", name.span, fmt::format("there is no step '{}'", name.text));
        return std::nullopt;
    }
    std::vector<std::string_view> names = groups;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (numbers_[i] <= kLastNamed) names.push_back(steps_[i]->name.text);
    }
    std::string help = suggestion(name.text, names);
    const bool is_sequence = std::find(sequences_.begin(), sequences_.end(), name.text) != sequences_.end();
    const bool is_inner = std::any_of(inner_steps_.begin(), inner_steps_.end(),
                                      [&](const auto& inner) { return same_name(inner.first, name.text); });
    const bool begins_with_digit = help.empty() && name.text.front() >= '0' && name.text.front() <= '9';
    if (help.empty() || is_sequence || is_inner || is_group(name.text)) help = help_for(name.text);
    if (begins_with_digit)
        help = fmt::format("a name begins with a letter: STEP S{0}: and NEXT := S{0};", name.text);
    report_.add("E021", name.span,
                fmt::format("there is no {} '{}'", groups.empty() ? "step" : "step or group", name.text),
                help);
    return std::nullopt;
}

/// AT first; the others get the lowest free numbers from 1 on. 0 is POWER_UP.
void StepNames::number_all(Symbols& symbols) {
    numbers_.assign(steps_.size(), kNone);
    std::array<const ast::Step*, kLastNamed + 1U> owners{};
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        const auto number = written_number(*steps_[i]);
        if (!number) continue;
        if (owners[*number] != nullptr) {
            report_
                .add("E095", steps_[i]->number->span,
                     fmt::format("'{}' has the number {} already", owners[*number]->name.text, *number),
                     "choose another number, or leave AT out")
                .notes.push_back({owners[*number]->number->span, "it is given here"});
            continue;
        }
        owners[*number] = steps_[i];
        numbers_[i] = *number;
    }
    std::uint8_t next = 1;
    bool too_many = false;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (numbers_[i] != kNone) continue;
        while (next <= kLastNamed && owners[next] != nullptr) ++next;
        if (next <= kLastNamed) {
            numbers_[i] = next++;
        } else if (!too_many) {
            too_many = true;
            report_.add("E083", steps_[i]->name.span,
                        fmt::format("{} steps: a table holds at most {} named ones", steps_.size(),
                                    kLastNamed + (owners[0] != nullptr ? 1 : 0)),
                        "join steps, or use the counter for repetitions");
        }
    }
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (numbers_[i] != kNone) symbols.steps[numbers_[i]] = steps_[i]->name.text;
    }
}

std::optional<std::uint8_t> StepNames::written_number(const ast::Step& step) {
    if (!step.number) return std::nullopt;
    const ast::Value& value = *step.number;
    const bool plain = value.unit.text.empty() && !value.is_time && std::floor(value.number) == value.number;
    if (plain && value.number >= 0 && value.number <= kLastNamed)
        return static_cast<std::uint8_t>(value.number);
    Diagnostic& d = report_.add("E095", value.span, fmt::format("steps have the numbers 0..{}", kLastNamed),
                                "leave AT out if the number does not matter");
    if (plain && value.number == sequencer::kLastStep)
        d.notes.push_back({value.span, "62 in a NEXT means no switch, so this step could never be entered"});
    if (plain && value.number == sequencer::kEndOfTable) d.notes.push_back({value.span, "63 ends the table"});
    return std::nullopt;
}

std::string StepNames::help_for(std::string_view name) const {
    for (std::string_view sequence : sequences_) {
        const bool is_it = same_name(sequence, name);
        if (is_it || upper(name).starts_with(upper(sequence) + "_"))
            return fmt::format("{}: write CALL {}(..); NEXT := Step;",
                               is_it ? "it is a SEQUENCE" : "the steps of a SEQUENCE are entered through it",
                               sequence);
    }
    for (const auto& [step, sequence] : inner_steps_) {
        if (same_name(step, name))
            return fmt::format("it is a step of SEQUENCE {0}, entered by CALL {0}(..); NEXT := Step;",
                               sequence);
    }
    if (is_group(name)) return "it is a GROUP of several steps: name the one that is meant";
    return fmt::format("write STEP {}: ... END_STEP, or name one of the steps there are", name);
}

bool StepNames::is_group(std::string_view name) const {
    return std::any_of(groups_.begin(), groups_.end(),
                       [&](std::string_view group) { return same_name(group, name); });
}

}  // namespace nplc::seqc
