#include "lowering/set_points.h"

#include <algorithm>
#include <set>

namespace nplc::seqc {
namespace {

using set_points::ValueKind;

/// Kind and register of a value.
using Target = std::pair<ValueKind, std::uint8_t>;

Target target_of(const DeclaredSetPoint& declared) {
    return {declared.point.kind, declared.point.reg};
}

Target target_of(const sequencer::Term& term) {
    if (term.is_flex) return {ValueKind::motor_register, term.flex.reg};
    return {term.fast.presets_counter ? ValueKind::counter : ValueKind::timer, std::uint8_t{0}};
}

std::uint32_t value_of(const sequencer::Term& term) {
    if (!term.is_flex) return term.fast.preset;
    return term.flex.low_word | (term.flex.longword ? std::uint32_t{term.flex.high_word} << 16 : 0U);
}

void collect(const Action& action, const Target& target, std::set<std::uint32_t>& used) {
    for (const Send& send : action.sends) {
        if (send.reg != nullptr && target == Target{ValueKind::motor_register, send.reg->number})
            used.insert(send.value);
    }
    if (action.timer && target.first == ValueKind::timer) used.insert(*action.timer);
    if (action.counter && target.first == ValueKind::counter) used.insert(*action.counter);
}

std::set<std::uint32_t> used_values(const Plan& plan, const Target& target) {
    std::set<std::uint32_t> used;
    const auto collect_raw = [&](const RawTerm& raw) {
        const sequencer::Term term = sequencer::decode(raw.bytes);
        if (target_of(term) == target) used.insert(value_of(term));
    };
    for (const StepPlan& step : plan.steps) {
        for (const Rule& rule : step.rules) collect(rule.action, target, used);
        for (const RawTerm& raw : step.terms) collect_raw(raw);
    }
    for (const RawTerm& raw : plan.terms) collect_raw(raw);
    return used;
}

void set_value(sequencer::TermBytes& bytes, std::uint32_t value) {
    sequencer::Term term = sequencer::decode(bytes);
    if (term.is_flex) {
        term.flex.low_word = static_cast<std::uint16_t>(value);
        if (term.flex.longword) term.flex.high_word = static_cast<std::uint16_t>(value >> 16);
    } else {
        term.fast.preset = static_cast<std::uint16_t>(value);
    }
    bytes = sequencer::encode(term);
}

}  // namespace

SetPointMarks::SetPointMarks(const Plan& plan, const std::vector<DeclaredSetPoint>& points)
    : points_(points), marked_(plan) {
    for (const DeclaredSetPoint& declared : points) marks_.push_back(free_value(declared));
    for (StepPlan& step : marked_.steps) {
        for (Rule& rule : step.rules) {
            mark(rule.action);
            for (RulePart& part : rule.parts) mark(part.action);
        }
    }
}

/// A value other than 0, which presets nothing, and not used elsewhere.
std::uint32_t SetPointMarks::free_value(const DeclaredSetPoint& declared) const {
    constexpr std::uint32_t kHighest = 0xFFFF;
    const std::set<std::uint32_t> used = used_values(marked_, target_of(declared));
    std::uint32_t value = kHighest;
    while (used.contains(value) || std::find(marks_.begin(), marks_.end(), value) != marks_.end()) --value;
    return value;
}

void SetPointMarks::mark(Action& action) const {
    for (Send& send : action.sends) {
        if (send.set_point != 0) send.value = marks_[send.set_point - 1U];
    }
    if (action.timer_point != 0) action.timer = static_cast<std::uint16_t>(marks_[action.timer_point - 1U]);
    if (action.counter_point != 0)
        action.counter = static_cast<std::uint16_t>(marks_[action.counter_point - 1U]);
}

void SetPointMarks::place(std::vector<LoweredTerm>& terms, std::vector<set_points::SetPoint>& points) const {
    points.clear();
    for (std::size_t p = 0; p < points_.size(); ++p) {
        set_points::SetPoint& point = points.emplace_back(points_[p].point);
        if (!points_[p].is_decided) continue;
        const std::uint32_t initial = points_[p].reg == nullptr ? static_cast<std::uint32_t>(point.initial)
                                                                : bits_of(point.initial, *points_[p].reg);
        for (std::size_t i = 0; i < terms.size(); ++i) {
            const sequencer::Term term = sequencer::decode(terms[i].bytes);
            if (target_of(term) != target_of(points_[p]) || value_of(term) != marks_[p]) continue;
            set_value(terms[i].bytes, initial);
            point.places.push_back(static_cast<std::uint16_t>(i));
        }
    }
}

set_points::Record record_of(const Plan& plan, const std::vector<DeclaredSetPoint>& declared,
                             const std::vector<set_points::SetPoint>& placed) {
    set_points::Record record;
    for (std::size_t p = 0; p < placed.size(); ++p) {
        if (declared[p].is_decided && !placed[p].places.empty()) record.values.push_back(placed[p]);
    }
    if (record.values.empty()) return record;
    for (const StepPlan& step : plan.steps) {
        const bool is_power_up = step.number == 0 && step.name == "POWER_UP";
        if (step.takes_set_points || is_power_up) record.takes |= std::uint64_t{1} << step.number;
    }
    return record;
}

}  // namespace nplc::seqc
