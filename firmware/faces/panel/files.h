#pragma once

#include <span>

#include "panel/web_server.h"

namespace nplc::panel {

/// The page, embedded in the program.
std::span<const WebFile> page_files();

}  // namespace nplc::panel
