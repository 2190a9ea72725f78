#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "seqc/seqc.h"

namespace nplc::seqc {

/// "1500 rpm" for 3146 in V1: the shortest number that the compiler rounds to this value. Nothing for a
/// register without unit, and where the motor is not known.
std::optional<std::string> with_unit(std::int64_t value, std::uint8_t reg, const Symbols* symbols);

}  // namespace nplc::seqc
