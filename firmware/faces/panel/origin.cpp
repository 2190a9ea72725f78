#include "origin.h"

#include <algorithm>
#include <cctype>

#include "panel/web_server.h"

namespace nplc::panel {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

}  // namespace

std::string host_name(std::string_view host) {
    if (host.starts_with('[')) return lower(host.substr(0, host.find(']') + 1));
    return lower(host.substr(0, host.find(':')));
}

bool is_loopback(std::string_view address) {
    const std::string name = lower(address);
    if (name == "localhost" || name == "::1" || name == "[::1]") return true;
    const bool digits = std::all_of(name.begin(), name.end(),
                                    [](unsigned char c) { return std::isdigit(c) != 0 || c == '.'; });
    return digits && name.starts_with("127.") && std::count(name.begin(), name.end(), '.') == 3;
}

bool is_our_host(std::string_view host, const std::vector<std::string>& hosts) {
    const std::string name = host_name(host);
    if (is_loopback(name)) return true;
    return std::any_of(hosts.begin(), hosts.end(),
                       [&](const std::string& own) { return lower(own) == name; });
}

bool is_same_origin(std::string_view origin, std::string_view host) {
    const std::string page = lower(origin);
    const std::string own = lower(host);
    return page == "http://" + own || page == "https://" + own;
}

}  // namespace nplc::panel
