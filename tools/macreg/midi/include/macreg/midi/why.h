#pragma once

#include <string>
#include <vector>

#include "macreg/causes.h"
#include "macreg/midi/module.h"

/// Why does it not move? (000 §VI, 003 §IV, §VII)
namespace nplc::macreg::midi {

/// What `why` judges: the same readings twice, some time apart.
struct Condition {
    Scale scale{};
    Readings before{};
    Readings now{};
};
/// 200 ms apart.
Condition read_condition(Module& module);

/// Two modules answer to one address. Nothing else can be judged then.
Finding same_address(std::uint8_t address, bool is_can);

/// What to mend first in front. Pure; never empty.
std::vector<Finding> why(const Condition& condition);

}  // namespace nplc::macreg::midi
