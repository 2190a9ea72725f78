#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "analysis/property.h"

/// A table and its properties as input of an external checker, under `any`. Written from 001 §6.1 alone and
/// sharing nothing with the explorer, so that the two can be compared.
namespace nplc::verify {

struct Emission {
    std::string text;
    std::vector<std::string> left_out;  ///< names of properties that the language cannot state
};

/// For Spin: a model with one `ltl p_NAME` a property. Assumptions are to be without STABLE. Time is counted
/// only where an assumption or a property needs it.
Emission promela_of(std::span<const std::uint8_t> table, const std::vector<Property>& properties,
                    const std::vector<Assumption>& assumptions = {});
/// For Z3's Datalog engine: Horn clauses with one `query` a property.
Emission smt2_of(std::span<const std::uint8_t> table, const std::vector<Property>& properties,
                 const std::vector<Assumption>& assumptions = {});

}  // namespace nplc::verify
