#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "terms/case_set.h"
#include "terms/half.h"
#include "terms/open_cases.h"
#include "terms/order_plan.h"
#include "terms/ternary.h"

namespace nplc::seqc {

/// Finds the fewest terms without an order that, together with those of a plan, do what a half wants.
///
/// Works from the last term of the table to the first: a case is open until a term that holds in it decides
/// it, and a term may hold wherever all that is still open wants the same (001 §6.1.9: the last true term
/// decides). A term of the plan is placed as soon as it may be: it costs nothing more.
class LabelSearch {
  public:
    LabelSearch(const Half& half, const OrderPlan& plan);

    /// No table with the orders of the plan has fewer terms without an order.
    std::size_t fewest() const { return bound(start_); }

    /// All terms in table order, at most `limit` of them without an order; `order` points into the plan.
    /// Nothing if there are none, or none are found within a fixed number of steps.
    std::optional<std::vector<PlacedTerm>> run(std::size_t limit);

  private:
    using Kinds = std::uint8_t;
    struct Item {
        const OrderTerm* term;
        CaseSet cases;
        std::vector<std::uint32_t> after;  // items with a case of this one that come later in the plan
    };
    struct State {
        std::vector<OpenBits> open;  // by case
        CaseSet nexts;               // cases whose next step is open, and so on
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
    std::size_t inputs() const { return half_.inputs; }
    bool is_done(const State& state) const;
    std::size_t bound(const State& state) const;

    Kinds kinds_of(OpenBits open) const;
    OpenBits cleared_by(Kinds kind) const;
    void survey(const State& state);
    std::vector<Candidate> candidates(const State& state);
    void add_candidates(const State& state, Ternary::Entry cube, std::size_t zeros, Kinds kinds,
                        std::vector<Candidate>& list);
    CaseSet gains_of(const State& state, const CaseSet& cases, Kinds kind) const;
    std::size_t worth(const State& state, const CaseSet& cases, Kinds kind) const;
    void remove_dominated(std::vector<Candidate>& list) const;
    CaseSet set_of(const Region& region) const { return cases_in(region, half_.inputs, half_.cases()); }

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

    const Half& half_;
    const Ternary& cubes_;
    OpenLayout layout_;
    std::size_t layers_;
    bool unnamed_help_ = false;
    std::vector<Item> items_;
    std::vector<OpenBits> demanded_;  // by case
    std::vector<CaseSet> classes_;    // cases that share next step and outputs
    State start_;

    std::vector<OpenBits> masks_;  // by zeros and cube: all that is open in it
    std::vector<Kinds> kinds_;
    std::vector<PlacedTerm> path_;  // the last term of the table first
    std::vector<PlacedTerm> best_;
    std::size_t best_used_ = 0;
    std::size_t work_ = 0;
    std::size_t most_work_ = 0;
    std::vector<std::pair<std::uint64_t, std::size_t>> failed_;
};

}  // namespace nplc::seqc
