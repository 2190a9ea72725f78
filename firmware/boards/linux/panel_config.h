#pragma once

#include "config.h"

namespace nplc::boards {

/// The table [panel] of the configuration.
PanelConfig read_panel(Section& root, Findings& findings);

}  // namespace nplc::boards
