#pragma once

#include <span>

#include "panel/web_server.h"

namespace nplc::panel {

/// The page, as it is built into the program.
std::span<const WebFile> page_files();

}  // namespace nplc::panel
