#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "meaning/scope.h"
#include "sequencer/term.h"

namespace nplc::seqc {
namespace {

constexpr std::uint8_t kNone = sequencer::kLastStep;

}  // namespace

const ast::Step* Scope::step_numbered(std::uint8_t number) const {
    const auto found = std::find(numbers_.begin(), numbers_.end(), number);
    if (number == kNone || found == numbers_.end()) return nullptr;
    return steps_[static_cast<std::size_t>(found - numbers_.begin())];
}

std::optional<std::uint8_t> Scope::written_number(const ast::Step& step) {
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

/// AT first; the others take the lowest free numbers from 1 on. 0 is what POWER_UP has.
void Scope::number_steps() {
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
                        fmt::format("a table holds at most {} named steps",
                                    kLastNamed + (owners[0] != nullptr ? 1 : 0)),
                        "join steps, or use the counter for repetitions");
        }
    }
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        if (numbers_[i] != kNone) result_.symbols.steps[numbers_[i]] = steps_[i]->name.text;
    }
}

}  // namespace nplc::seqc
