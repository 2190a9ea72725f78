#pragma once

#include <string>

#include "host/byte_client.h"

namespace nplc::hal_windows {

/// `port`: COM1, COM23.
host::ByteClient::Opened open_com_client(const std::string& port, std::uint32_t baud);
/// `where`: 127.0.0.1:PORT; other machines' addresses are refused.
host::ByteClient::Opened open_tcp_client(const std::string& where);

}  // namespace nplc::hal_windows
