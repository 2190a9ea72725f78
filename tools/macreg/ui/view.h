#pragma once

#include <string>

#include "macreg/ui_model.h"
#include "terminal.h"

namespace nplc::macreg {

/// Smaller screens show a request for a larger one.
inline constexpr int kLeastRows = 16;
inline constexpr int kLeastColumns = 60;

/// Draws the whole screen. `title` is the port and the motor.
void draw(UiModel& model, const Terminal& terminal, const std::string& title);

}  // namespace nplc::macreg
