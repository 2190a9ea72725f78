#include "placed.h"

#include <fmt/format.h>

namespace nplc::boards {

Placed placed(Section& section, const std::string& key) {
    const std::optional<std::string> text = section.text(key);
    return {text && *text != "none" ? *text : "", section.line_of(key), section.path() + "." + key};
}

bool is_endpoint(const std::string& port) {
    return port.starts_with("pty:") || port.starts_with("unix:") || port.starts_with("tcp:");
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
    else if (port.text.starts_with("tcp:") && !port.text.starts_with("tcp:127."))
        section.complain(key, fmt::format("{} is open to the network; write \"tcp:127.0.0.1:PORT\" and "
                                          "come in through ssh -L",
                                          port.text));
}

}  // namespace nplc::boards
