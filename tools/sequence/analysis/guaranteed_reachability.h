#pragma once

#include <cstdint>

#include "ways_back.h"

namespace nplc::verify {

/// Whether from every scan in `ways` outside of `target` some course that is possible with the gateway
/// certainly leads to `target`: with inputs that keep their levels for the debounce time, and a timer that is
/// only known to run. True is a proof; false is no result. `ways` must be complete and include lost links.
/// From each scan, or from `only` these. `held`: the inputs, as bits, that keep their levels for longer; they
/// change only where the scans do nothing.
bool surely_possible(const Explorer& ways, const Target& target, std::uint8_t held,
                     const ScanKeys* only = nullptr);
/// The same from power-up.
bool surely_reached(const Explorer& ways, const Target& target, std::uint8_t held);

}  // namespace nplc::verify
