#include "host/byte_client.h"

#include <algorithm>
#include <cctype>
#include <chrono>

#include "clients.h"
#include "host/clock.h"
#include "host/endpoint.h"

namespace nplc::hal_windows {
namespace {

/// "COM3" of COM3, com3, COM3: and \\.\COM3; empty for anything else.
std::string com_port(std::string text) {
    if (text.starts_with("\\\\.\\")) text.erase(0, 4);
    if (text.ends_with(':')) text.pop_back();
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const bool digits = text.size() > 3 && text.size() <= 6 && text[3] != '0' &&
                        text.find_first_not_of("0123456789", 3) == std::string::npos;
    return text.starts_with("COM") && digits ? text : std::string();
}

}  // namespace
}  // namespace nplc::hal_windows

namespace nplc::host {

base::Instant steady_now() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return base::Instant(std::chrono::duration_cast<base::Microseconds>(since));
}

ByteClient::Opened ByteClient::open(const std::string& endpoint, std::uint32_t baud, Holding /*holding*/) {
    if (const std::string port = hal_windows::com_port(endpoint); !port.empty())
        return hal_windows::open_com_client(port, baud);
    const Endpoint line(endpoint);
    if (line.kind == Endpoint::Kind::tcp && !line.place.empty())
        return hal_windows::open_tcp_client(line.place);
    if (line.kind == Endpoint::Kind::pty || line.kind == Endpoint::Kind::unix_socket)
        return {nullptr, "'" + endpoint + "': Windows has no such lines; write " + forms(), true};
    return {nullptr, "'" + endpoint + "': write " + forms(), true};
}

std::string ByteClient::forms() {
    return "a serial line such as COM3, or tcp:127.0.0.1:PORT";
}

}  // namespace nplc::host
