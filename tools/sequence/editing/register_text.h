#pragma once

#include <string>

#include "editing/program.h"

namespace nplc::seqc::analysis {

/// Text of the register map: title, unit, range, access, fields, note; Markdown.
std::string register_text(const Program& program, const registers::Register& reg);
/// "1 mm = 819.2, -41943.04 .. 41943.04 mm" in one line.
std::string register_line(const Program& program, const registers::Register& reg);
/// Raw value of a constant: "16384 (60.0000 mm)".
std::string constant_text(const Program& program, const Constant& constant);

}  // namespace nplc::seqc::analysis
