#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lowering/case_set.h"
#include "lowering/order_plan.h"
#include "lowering/reduced_step.h"
#include "lowering/ternary.h"

namespace nplc::seqc {

/// The open decisions of a case, one bit per next step, output byte, timer value and counter value.
using RemainingEffects = std::uint64_t;

inline bool at_most_one(RemainingEffects bits) {
    return (bits & (bits - 1)) == 0;
}

/// A term in the order of the search, from the last term of the table to the first.
struct PlacedTerm {
    Region region;
    const OrderTerm* order = nullptr;  ///< in the plan; null: it sends nothing
    std::uint8_t next = 0;
    std::uint8_t output_byte = 0;
    Preset preset = Preset::none;
    std::uint16_t value = 0;
    bool names_next = true;
};

/// The meaning of the bits of RemainingEffects in one reduced step.
class OpenLayout {
  public:
    explicit OpenLayout(const ReducedStep& error_branch);

    bool fits() const { return fits_; }
    RemainingEffects wanted(std::size_t behaviour) const { return wanted_[behaviour]; }
    /// The part of `wanted` that is required for a correct case.
    RemainingEffects demanded(std::size_t behaviour) const { return demanded_[behaviour]; }

    RemainingEffects nexts = 0;
    RemainingEffects outputs = 0;
    RemainingEffects timers = 0;
    RemainingEffects counters = 0;
    RemainingEffects no_timer = 0;  ///< set in cases without a timer preset, and never cleared
    RemainingEffects no_counter = 0;

  private:
    template <class T>
    RemainingEffects bit_for(std::vector<T>& seen, std::vector<RemainingEffects>& bits, T value,
                             RemainingEffects& group);

    bool fits_ = true;
    unsigned used_ = 0;
    std::vector<RemainingEffects> wanted_;
    std::vector<RemainingEffects> demanded_;
};

/// Finds the minimum number of terms without an order that, together with a plan's terms, implement a reduced
/// step.
///
/// Works from the last term of the table to the first: a case is open until a term that is true in it decides
/// it, and a term may be true wherever all open decisions are the same (001 §6.1.9: the last true term
/// decides). A term of the plan is placed as soon as possible, since it has no further cost.
class LabelSearch {
  public:
    LabelSearch(const ReducedStep& error_branch, const OrderPlan& plan);

    /// Lower bound of the number of terms without an order for this plan.
    std::size_t fewest() const { return bound(start_); }

    /// All terms in table order, at most `limit` of them without an order; `order` points into the plan.
    /// Empty if there is no solution, or none is found within a fixed number of steps.
    std::optional<std::vector<PlacedTerm>> run(std::size_t limit);

  private:
    using Kinds = std::uint8_t;
    struct Item {
        const OrderTerm* term;
        CaseSet cases;
        std::vector<std::uint32_t> after;  // items with a case of this one that are later in the plan
    };
    struct State {
        std::vector<RemainingEffects> open;  // by case
        CaseSet nexts;                       // cases whose next step is open, and so on
        CaseSet outputs;
        CaseSet timers;
        CaseSet counters;
        std::vector<std::uint8_t> placed;  // by item
        std::size_t left = 0;              // items not placed yet
    };
    struct Candidate {
        Region region;
        Kinds kind = 0;
        CaseSet gains;  // cases in which it decides something
        std::size_t gain = 0;
    };

    bool fits() const { return layout_.fits(); }
    std::size_t inputs() const { return error_branch_.inputs; }
    bool is_done(const State& state) const;
    std::size_t bound(const State& state) const;

    Kinds kinds_of(RemainingEffects open) const;
    RemainingEffects cleared_by(Kinds kind) const;
    void survey(const State& state);
    std::vector<Candidate> candidates(const State& state);
    void add_candidates(const State& state, Cube cube, std::size_t zeros, Kinds kinds,
                        std::vector<Candidate>& list);
    CaseSet gains_of(const State& state, const CaseSet& cases, Kinds kind) const;
    std::size_t worth(const State& state, const CaseSet& cases, Kinds kind) const;
    void remove_dominated(std::vector<Candidate>& list) const;
    CaseSet set_of(const Region& region) const {
        return cases_in(region, error_branch_.inputs, error_branch_.cases());
    }

    void place(State& state, const Region& region, Kinds kind, const OrderTerm* order = nullptr);
    void place_items(State& state);
    bool may_place(const State& state, const Item& item) const;

    void try_orders(const State& state, std::uint32_t classes, std::size_t used);
    std::size_t cover_class(State& state, const CaseSet& cases, std::size_t used);
    const Candidate* most_in(const State& state, const CaseSet& cases,
                             const std::vector<Candidate>& list) const;
    bool search(const State& state, std::size_t most, std::size_t depth);
    bool search_up_to(const State& state, std::size_t first, std::size_t last);
    bool finish_with_one(const State& state);
    bool failed_before(const State& state, std::size_t most, bool remember);
    void keep(std::size_t used);
    std::vector<PlacedTerm> result() const;

    const ReducedStep& error_branch_;
    const Ternary& cubes_;
    OpenLayout layout_;
    std::size_t layers_;
    bool unnamed_help_ = false;
    std::vector<Item> items_;
    std::vector<RemainingEffects> demanded_;  // by case
    std::vector<CaseSet> classes_;            // cases with the same next step and outputs
    State start_;

    std::vector<RemainingEffects> masks_;  // by zeros and cube: all open bits in it
    std::vector<Kinds> kinds_;
    std::vector<PlacedTerm> path_;  // the last term of the table first
    std::vector<PlacedTerm> best_;
    std::size_t best_used_ = 0;
    std::size_t work_ = 0;
    std::size_t most_work_ = 0;
    std::vector<std::pair<std::uint64_t, std::size_t>> failed_;
};

}  // namespace nplc::seqc
