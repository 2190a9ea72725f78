#pragma once

#include <cstdint>
#include <string>

#include "registers/mac.h"
#include "seqc/seqc.h"

namespace nplc::dap {

/// By a name of VAR_MOTOR or of the register map; throws Problem.
const registers::Register& register_of(const seqc::Symbols& symbols, const std::string& name);
/// "60 mm (49152)"; the raw number for a register without unit.
std::string value_text(const seqc::Symbols& symbols, const std::string& reg, std::int64_t raw);
/// "60 mm", "1500 rpm", "49152"; throws Problem.
std::int64_t raw_value(const seqc::Symbols& symbols, const registers::Register& reg, const std::string& text);

}  // namespace nplc::dap
