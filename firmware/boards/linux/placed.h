#pragma once

#include <string>

#include "section.h"

namespace nplc::boards {

/// A text of the configuration and where it stands.
struct Placed {
    std::string text{};
    int line = 0;
    std::string key{};
    bool is_there() const { return !text.empty(); }
};

/// Empty where the key is not there or "none".
Placed placed(Section& section, const std::string& key);

bool is_endpoint(const std::string& port);

/// A device, or, if it may be, an endpoint that the network does not reach: whoever reaches the port can move
/// the motor.
void check_port(Section& section, const Placed& port, bool may_be_endpoint);

}  // namespace nplc::boards
