#include "placed.h"

#include <fmt/format.h>

#include "host/endpoint.h"

namespace nplc::boards {

Placed placed(Section& section, const std::string& key) {
    const std::optional<std::string> text = section.text(key);
    return {text && *text != "none" ? *text : "", section.line_of(key), section.path() + "." + key};
}

namespace {

bool is_open_to_network(const host::Endpoint& port) {
    return port.kind == host::Endpoint::Kind::tcp && !port.place.starts_with("127.");
}

}  // namespace

bool is_endpoint(const std::string& port) {
    return host::Endpoint(port).is_served();
}

void check_port(Section& section, const Placed& port, bool may_be_endpoint) {
    const std::string key = port.key.substr(port.key.rfind('.') + 1);
    if (!port.is_there() || port.text.starts_with('/')) return;
    if (!may_be_endpoint)
        section.complain(key, fmt::format("{} is no device; write such as \"/dev/ttyUSB0\"", port.text));
    else if (!is_endpoint(port.text))
        section.complain(key, fmt::format("{} is no port; write \"/dev/ttyUSB1\", \"unix:PATH\", "
                                          "\"pty:PATH\", \"tcp:127.0.0.1:PORT\" or \"none\"",
                                          port.text));
    else if (is_open_to_network(host::Endpoint(port.text)))
        section.complain(key, fmt::format("{} is open to the network; write \"tcp:127.0.0.1:PORT\" and "
                                          "come in through ssh -L",
                                          port.text));
}

}  // namespace nplc::boards
