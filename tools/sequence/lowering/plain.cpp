#include "lowering/plain.h"

#include <algorithm>
#include <array>
#include <utility>

#include "lowering/cover.h"
#include "lowering/effects.h"

namespace nplc::seqc {
namespace {

using sequencer::Condition;

constexpr int kNobody = -1;

/// The operations on the counter: none, clear, count down, both.
const std::array<Action, 4> kCounting = [] {
    std::array<Action, 4> actions;
    for (std::size_t i = 0; i < actions.size(); ++i) {
        actions[i].clears_counter = (i & 1U) != 0;
        actions[i].counts_down = (i & 2U) != 0;
    }
    return actions;
}();

/// Zero flags of timer and counter as a layer: bit 0 the timer, bit 1 the counter. A term of a layer is also
/// true in every layer with at least its bits.
enum Layer : std::size_t { kNeither, kTimer, kCounter, kBoth, kLayers };

std::size_t case_of(std::size_t point, bool error, std::size_t layer) {
    return point | (error ? std::size_t{1} << kErrorBit : 0) | (layer << kTimerZero);
}

Condition condition_of(std::uint8_t step, Cube cube, bool error, std::size_t layer) {
    return {
        .step = step,
        .needs_counter_zero = (layer & kCounter) != 0,
        .needs_timer_zero = (layer & kTimer) != 0,
        .input = static_cast<sequencer::InputImage>(cube.value | (error ? sequencer::kError : 0)),
        .care = cube.care,
    };
}

/// Some terms of one effect with one condition.
struct EffectTerms {
    int effect;
    Condition condition;
};

class Lowering {
  public:
    Lowering(const StepPlan& step, Effects effects) : step_(step), effects_(std::move(effects)) {
        owner_.fill(kNobody);
    }

    std::vector<LoweredTerm> run() {
        place_outputs();
        place_layer(kNeither);
        if (needs_zeros()) place_zeros();
        if (!step_.conditional.empty()) mend_outputs();
        std::vector<LoweredTerm> terms;
        for (const EffectTerms& placed : placed_) {
            append_terms(effects_.list[static_cast<std::size_t>(placed.effect)], placed.condition, terms);
        }
        for (const RawTerm& raw : step_.terms) terms.push_back({raw.bytes, raw.span});
        return terms;
    }

    /// An effect would have to be cancelled that cannot be.
    bool failed() const { return failed_; }

  private:
    Effect& effect(int index) { return effects_.list[static_cast<std::size_t>(index)]; }
    bool is_hard(int index) { return index != kNobody && effect(index).is_hard(); }

    /// Without a zero test the terms of the lowest layer act in the others as well.
    bool needs_zeros() const {
        const auto changes = [](const auto& by_case) {
            const std::size_t layer = kCases / kLayers;
            return !std::equal(by_case.begin() + layer, by_case.end(), by_case.begin());
        };
        return changes(effects_.target) || changes(effects_.resting);
    }

    void place_zeros() {
        // Effects that cannot be cancelled are also true when both are zero, so they come after those that
        // can.
        place_undoable(kTimer);
        place_undoable(kCounter);
        place_firm(kTimer);
        place_firm(kCounter);
        place_layer(kBoth);
    }

    /// Outputs that depend on inputs. They come first, so that everything else overrides them. Their order is
    /// free: the shortest result is kept.
    void place_outputs() {
        std::vector<int> order;
        for (int i = 0; i < static_cast<int>(effects_.list.size()); ++i) {
            if (!effect(i).is_hard()) order.push_back(i);
        }
        if (order.empty()) return;
        const auto size = [&](int i) {
            return std::count(effects_.target.begin(), effects_.target.end(), i);
        };
        const auto outputs = [&](int i) { return effect(i).outputs; };
        std::array<std::vector<int>, 3> orders = {order, order, order};
        std::stable_sort(orders[0].begin(), orders[0].end(),
                         [&](int a, int b) { return outputs(a) < outputs(b); });
        std::stable_sort(orders[1].begin(), orders[1].end(), [&](int a, int b) { return size(a) > size(b); });
        std::stable_sort(orders[2].begin(), orders[2].end(), [&](int a, int b) { return size(a) < size(b); });
        std::vector<EffectTerms> best;
        Owners best_owner = owner_;
        const Owners clean = owner_;
        for (const std::vector<int>& attempt : orders) {
            placed_.clear();
            owner_ = clean;
            const std::size_t layers = needs_zeros() ? kLayers : kNeither + 1;
            for (std::size_t layer = kNeither; layer < layers; ++layer) place_outputs_in(layer, attempt);
            if (!best.empty() && placed_.size() >= best.size()) continue;
            best = placed_;
            best_owner = owner_;
        }
        placed_ = best;
        owner_ = best_owner;
    }

    void place_outputs_in(std::size_t layer, const std::vector<int>& order) {
        for (std::size_t k = 0; k < order.size(); ++k) {
            for (bool error : {false, true}) {
                Points need;
                Points allowed;
                for (std::size_t point = 0; point < kPoints; ++point) {
                    const std::size_t c = case_of(point, error, layer);
                    const int wanted = effects_.target[c];
                    const bool later = std::find(order.begin() + static_cast<std::ptrdiff_t>(k), order.end(),
                                                 wanted) != order.end();
                    need[point] = wanted == order[k] && owner_[c] != order[k];
                    allowed[point] = later || is_hard(wanted);
                }
                for (Cube cube : minimal_cover(need, allowed)) place(order[k], cube, error, layer);
            }
        }
    }

    void place_layer(std::size_t layer) {
        place_undoable(layer);
        place_firm(layer);
    }

    void place_undoable(std::size_t layer) {
        place_effects(layer, false);
        for (bool error : {false, true}) place_stays(error, layer);
    }

    void place_firm(std::size_t layer) { place_effects(layer, true); }

    void place_effects(std::size_t layer, bool firm) {
        const int given = static_cast<int>(effects_.list.size());
        for (int k = 0; k < given; ++k) {
            if (!effect(k).is_hard() || effect(k).action == nullptr || effect(k).cannot_be_undone() != firm)
                continue;
            for (bool error : {false, true}) place_effect(k, error, layer);
        }
    }

    void place_effect(int index, bool error, std::size_t layer) {
        Points need;
        Points allowed;
        for (std::size_t point = 0; point < kPoints; ++point) {
            const std::size_t c = case_of(point, error, layer);
            const int wanted = effects_.target[c];
            allowed[point] = wanted == index;
            if (wanted != index) continue;
            if (owner_[c] == index) continue;
            need.set(point);
            if (!is_hard(owner_[c])) continue;
            take_over(index, owner_[c]);
        }
        const bool once = effect(index).acts_once();
        const auto cubes = once ? disjoint_cover(need) : minimal_cover(need, allowed);
        for (Cube cube : cubes) place(index, cube, error, layer);
    }

    /// Cases in which a term of a lower layer changes the step although nothing should happen: "next = this
    /// step" cancels it.
    void place_stays(bool error, std::size_t layer) {
        std::array<Points, 16> need;
        for (std::size_t point = 0; point < kPoints; ++point) {
            const std::size_t c = case_of(point, error, layer);
            if (is_hard(effects_.target[c]) || !is_hard(owner_[c])) continue;
            const Effect& owner = effect(owner_[c]);
            if (owner.action == nullptr && owner.outputs == effects_.resting[c]) continue;
            override_owner(owner_[c]);
            need[effects_.resting[c]].set(point);
        }
        for (std::size_t outputs = 0; outputs < need.size(); ++outputs) {
            if (need[outputs].none()) continue;
            Points allowed;
            for (std::size_t point = 0; point < kPoints; ++point) {
                const std::size_t c = case_of(point, error, layer);
                allowed[point] = !is_hard(effects_.target[c]) && effects_.resting[c] == outputs;
            }
            Effect stay;
            stay.outputs = static_cast<std::uint8_t>(outputs);
            stay.own_step = step_.number;
            stay.stays = true;
            stay.span = step_.span;
            effects_.list.push_back(stay);
            const int index = static_cast<int>(effects_.list.size()) - 1;
            for (Cube cube : minimal_cover(need[outputs], allowed)) place(index, cube, error, layer);
        }
    }

    bool leaves(const Effect& effect) const { return effect.next() && *effect.action->next != step_.number; }

    /// What must be written in a case: outputs in bits 0..3, the action on the counter above them.
    static unsigned counting(const Effect& effect) {
        const Action* action = effect.action;
        return action == nullptr ? 0U : (action->clears_counter ? 1U : 0U) + (action->counts_down ? 2U : 0U);
    }
    unsigned wanted_byte(std::size_t c) {
        const Effect& target = effect(effects_.target[c]);
        return (leaves(target) ? target.outputs : effects_.resting[c]) + counting(target) * 16U;
    }
    unsigned written_byte(std::size_t c) {
        const Effect& owner = effect(owner_[c]);
        return owner.outputs + counting(owner) * 16U;
    }

    /// Terms that only write outputs, where a timer or counter at zero changes the outputs besides the
    /// orders.
    void mend_outputs() {
        const std::size_t layers = needs_zeros() ? kLayers : kNeither + 1;
        for (std::size_t layer = kNeither; layer < layers; ++layer) {
            for (bool error : {false, true}) mend_outputs_in(layer, error);
        }
    }

    void mend_outputs_in(std::size_t layer, bool error) {
        std::array<Points, 64> need;
        std::array<Points, 64> allowed;
        for (std::size_t point = 0; point < kPoints; ++point) {
            const std::size_t c = case_of(point, error, layer);
            allowed[wanted_byte(c)].set(point);
            if (written_byte(c) != wanted_byte(c)) need[wanted_byte(c)].set(point);
        }
        for (unsigned byte = 0; byte < need.size(); ++byte) {
            if (need[byte].none()) continue;
            Effect written;
            written.action = &kCounting[byte / 16];
            written.outputs = static_cast<std::uint8_t>(byte % 16);
            written.own_step = step_.number;
            written.writes_outputs = true;
            written.span = step_.span;
            effects_.list.push_back(written);
            const int index = static_cast<int>(effects_.list.size()) - 1;
            for (Cube cube : minimal_cover(need[byte], allowed[byte])) place(index, cube, error, layer);
        }
    }

    /// Effect `index`, which has no next step of its own, must name one where an earlier effect is true too.
    void take_over(int index, int owner) {
        override_owner(owner);
        if (!effect(index).next()) effect(index).stays = true;
    }

    /// Later terms override an effect in some cases.
    void override_owner(int index) { failed_ = failed_ || effect(index).cannot_be_undone(); }

    void place(int index, Cube cube, bool error, std::size_t layer) {
        placed_.push_back({index, condition_of(step_.number, cube, error, layer)});
        const bool once = effect(index).acts_once();
        const Points points = points_of(cube);
        for (std::size_t above = layer; above < kLayers; ++above) {
            if ((above & layer) != layer) continue;
            for (std::size_t point = points._Find_first(); point < kPoints;
                 point = points._Find_next(point)) {
                const std::size_t c = case_of(point, error, above);
                if (once && effect(index).fired.test(c)) failed_ = true;
                effect(index).fired.set(c);
                const int before = owner_[c];
                if (above != layer && effects_.target[c] == index && before != index && is_hard(before))
                    take_over(index, before);
                owner_[c] = index;
            }
        }
    }

    using Owners = std::array<int, kCases>;

    const StepPlan& step_;
    Effects effects_;
    bool failed_ = false;
    std::vector<EffectTerms> placed_;
    Owners owner_{};
};

}  // namespace

std::vector<LoweredTerm> plain_terms(const StepPlan& step, const std::vector<std::uint8_t>& outputs_of) {
    Lowering along(step, effects_of(step, outputs_of));
    std::vector<LoweredTerm> terms = along.run();
    if (!along.failed()) return terms;
    return Lowering(step, effects_of(step, outputs_of, Outputs::apart)).run();
}

}  // namespace nplc::seqc
