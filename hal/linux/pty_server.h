#pragma once

#include <string>

#include "hal_linux/byte_server.h"

namespace nplc::hal_linux {

ByteServer::Opened open_pty_server(const std::string& path, bool at_once);

}  // namespace nplc::hal_linux
