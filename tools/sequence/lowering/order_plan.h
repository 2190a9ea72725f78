#pragma once

#include <cstdint>
#include <vector>

#include "lowering/reduced_step.h"

namespace nplc::seqc {

/// The reduced cases in which one term can be true: inputs under `care` equal `value`, and every zero flag of
/// `zeros` (bit 0 the first one of the step) is set.
struct Region {
    std::uint8_t value = 0;
    std::uint8_t care = 0;
    std::uint8_t zeros = 0;
    bool holds(std::size_t reduced, std::size_t inputs) const {
        const std::size_t low = reduced & ((std::size_t{1} << inputs) - 1);
        return (low & care) == value && ((reduced >> inputs) & zeros) == zeros;
    }
};

enum class Preset : std::uint8_t { none, timer, counter };

/// A term with an order. Orders of one case are in the order of the list.
struct OrderTerm {
    Region region;
    const Send* send = nullptr;
    Preset preset = Preset::none;  ///< the preset carried by it
    bool is_fast() const { return send->reg == nullptr; }
};

using OrderPlan = std::vector<OrderTerm>;

/// Ways to send all orders of the reduced step, in every case once and in order; the shortest first, at least
/// one if a table can do it at all. They differ in which branches share a term for the same order.
std::vector<OrderPlan> order_plans(const ReducedStep& error_branch);

}  // namespace nplc::seqc
