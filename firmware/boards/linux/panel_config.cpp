#include "panel_config.h"

#include <charconv>

#include "panel/web_server.h"

namespace nplc::boards {
namespace {

constexpr std::size_t kMostHosts = 16;

/// 127.0.0.1:8080 or [::1]:8080
bool read_place(const std::string& text, PanelConfig& panel) {
    const auto colon = text.rfind(':');
    if (colon == std::string::npos || colon == 0) return false;
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data() + colon + 1, end, panel.port);
    if (error != std::errc{} || read != end || panel.port == 0) return false;
    panel.address = text.substr(0, colon);
    if (panel.address.starts_with('[') && panel.address.ends_with(']'))
        panel.address = panel.address.substr(1, panel.address.size() - 2);
    return true;
}

void read_hosts(Section& section, PanelConfig& panel) {
    const TomlValue* list = section.list("hosts", "a list of names: [\"cell4.example\"]");
    if (list == nullptr) return;
    for (const TomlValue& item : list->items) {
        if (item.kind == TomlValue::Kind::text && !item.text.empty() && panel.hosts.size() < kMostHosts)
            panel.hosts.push_back(item.text);
        else
            section.complain("hosts", "holds something else than 16 names of hosts at the most");
    }
}

}  // namespace

PanelConfig read_panel(Section& root, Findings& findings) {
    Section section(root.table("panel"), "panel", findings);
    PanelConfig panel;
    panel.listen = located_text(section, "listen");
    panel.token_file = located_text(section, "token_file");
    panel.password_file = located_text(section, "password_file");
    read_hosts(section, panel);
    section.finish();
    if (!panel.listen.is_there()) return panel;
    if (!read_place(panel.listen.text, panel)) {
        section.complain("listen", "is no address with a port; write such as \"127.0.0.1:8080\"");
        return panel;
    }
    if (!panel::is_loopback(panel.address) &&
        (!panel.token_file.is_there() || !panel.password_file.is_there()))
        section.complain("listen",
                         "lets other machines in; that takes a password_file and a token_file, or listen at "
                         "\"127.0.0.1\" and put a TLS proxy before it");
    return panel;
}

}  // namespace nplc::boards
