#include "lowering/set_points.h"

#include <algorithm>
#include <set>

#include "table/terms.h"

namespace nplc::seqc {
namespace {

using set_points::ValueKind;

using Target = table::ValuePlace;

Target target_of(const DeclaredSetPoint& declared) {
    switch (declared.point.kind) {
        case ValueKind::motor_register:
            return {Target::Kind::reg, declared.point.reg};
        case ValueKind::counter:
            return {Target::Kind::counter};
        case ValueKind::timer:
            break;
    }
    return {Target::Kind::timer};
}

void collect(const Action& action, const Target& target, std::set<std::uint32_t>& used) {
    for (const Send& send : action.sends) {
        if (send.reg != nullptr && target == Target{Target::Kind::reg, send.reg->number})
            used.insert(send.value);
    }
    if (action.timer && target.kind == Target::Kind::timer) used.insert(*action.timer);
    if (action.counter && target.kind == Target::Kind::counter) used.insert(*action.counter);
}

std::set<std::uint32_t> used_values(const Plan& plan, const Target& target) {
    std::set<std::uint32_t> used;
    const auto collect_raw = [&](const RawTerm& raw) {
        if (table::value_place(raw.bytes) == target) used.insert(table::value_of(raw.bytes));
    };
    for (const StepPlan& step : plan.steps) {
        for (const Rule& rule : step.rules) collect(rule.action, target, used);
        for (const RawTerm& raw : step.terms) collect_raw(raw);
    }
    for (const RawTerm& raw : plan.terms) collect_raw(raw);
    return used;
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
            sequencer::TermBytes& term = terms[i].bytes;
            if (table::value_place(term) != target_of(points_[p]) || table::value_of(term) != marks_[p])
                continue;
            table::set_value(term, initial);
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
