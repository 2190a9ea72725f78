#include "hal_linux/byte_server.h"

#include "pty_server.h"
#include "socket_server.h"

namespace nplc::hal_linux {

ByteServer::Opened ByteServer::open(const std::string& endpoint, const Settings& settings) {
    const auto colon = endpoint.find(':');
    const std::string kind = endpoint.substr(0, colon);
    const std::string where = colon == std::string::npos ? std::string() : endpoint.substr(colon + 1);
    if (!where.empty()) {
        if (kind == "pty") return open_pty_server(where, settings.at_once);
        if (kind == "unix") return open_unix_server(where, settings);
        if (kind == "tcp") return open_tcp_server(where, settings.seats);
    }
    return {nullptr, "'" + endpoint + "': write pty:PATH, unix:PATH or tcp:127.0.0.1:PORT"};
}

}  // namespace nplc::hal_linux
