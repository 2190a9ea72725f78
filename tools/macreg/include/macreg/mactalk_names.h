#pragma once

#include <string_view>

#include "registers/mac.h"

namespace nplc::macreg {

/// What the program MacTalk calls the register (004, "MacTalk name"): "Max velocity". R: of MAC50 to MAC141
/// the register of the same name, for 002 gives none. Empty: it has none of its own.
std::string_view mactalk_name(const registers::Register& reg);

}  // namespace nplc::macreg
