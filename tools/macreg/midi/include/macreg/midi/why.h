#pragma once

#include <string>
#include <vector>

#include "macreg/causes.h"
#include "macreg/midi/module.h"

/// Diagnoses why an axis does not move (000 §VI, 003 §IV, §VII).
namespace nplc::macreg::midi {

/// The input of `why`: the same readings twice, some time apart.
struct Condition {
    Scale scale{};
    Readings before{};
    Readings now{};
};
/// 200 ms apart.
Condition read_condition(Module& module);

/// Two modules answer to one address, so nothing else can be diagnosed.
Finding same_address(std::uint8_t address, bool is_can);

/// The most urgent cause first. Pure; never empty.
std::vector<Finding> why(const Condition& condition);

}  // namespace nplc::macreg::midi
