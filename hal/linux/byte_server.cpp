#include "hal_linux/byte_server.h"

#include "host/endpoint.h"
#include "pty_server.h"
#include "socket_server.h"

namespace nplc::hal_linux {

ByteServer::Opened ByteServer::open(const std::string& endpoint, const Settings& settings) {
    const host::Endpoint line(endpoint);
    if (!line.place.empty()) {
        switch (line.kind) {
            case host::Endpoint::Kind::pty:
                return open_pty_server(line.place, settings.at_once);
            case host::Endpoint::Kind::unix_socket:
                return open_unix_server(line.place, settings);
            case host::Endpoint::Kind::tcp:
                return open_tcp_server(line.place);
            case host::Endpoint::Kind::device:
            case host::Endpoint::Kind::can:
                break;
        }
    }
    return {nullptr, "'" + endpoint + "': write pty:PATH, unix:PATH or tcp:127.0.0.1:PORT"};
}

}  // namespace nplc::hal_linux
