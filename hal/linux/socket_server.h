#pragma once

#include <string>

#include "hal_linux/byte_server.h"

namespace nplc::hal_linux {

ByteServer::Opened open_unix_server(const std::string& path, const ByteServer::Settings& settings);
/// `where`: ADDRESS:PORT
ByteServer::Opened open_tcp_server(const std::string& where);

}  // namespace nplc::hal_linux
