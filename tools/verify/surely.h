#pragma once

#include "explorer.h"

namespace nplc::verify {

/// Whether from every scan that `ways` knows, outside of `target`, a course of the gateway's surely leads to
/// `target`: with inputs that keep their levels for the debounce time, and a timer of which is known only
/// that it runs. True is a proof; false says nothing. `ways` must be complete and know lost links.
/// From each scan, or from `only` these. `held`: inputs, as bits, that keep their levels for longer; they
/// only change where nothing else happens.
bool surely_possible(const Explorer& ways, const Target& target, std::uint8_t held,
                     const Explorer::Scans* only = nullptr);
/// The same from power-up.
bool surely_reached(const Explorer& ways, const Target& target, std::uint8_t held);

}  // namespace nplc::verify
