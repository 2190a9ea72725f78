#pragma once

#include <cstdint>
#include <vector>

#include "lowering/reduced_step.h"

namespace nplc::seqc {

/// The reduced cases of a reduced step that one term can hold in: inputs under `care` equal `value`, and
/// every zero of `zeros` (bit 0 the first one of the step) has come.
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

/// A term that sends. Orders of one case stand in the order of the list.
struct OrderTerm {
    Region region;
    const Send* send = nullptr;
    Preset preset = Preset::none;  ///< what rides on it
    bool is_fast() const { return send->reg == nullptr; }
};

using OrderPlan = std::vector<OrderTerm>;

/// Ways to send everything that the reduced step must send, in every case once and in order; the shortest
/// first, at least one if a table can do it at all. They differ in which branches share a term for the same
/// order.
std::vector<OrderPlan> order_plans(const ReducedStep& half);

}  // namespace nplc::seqc
