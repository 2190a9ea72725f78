#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nplc::panel {

/// `Name:80` becomes `name`; `[::1]:80` becomes `[::1]`.
std::string host_name(std::string_view host);

/// Whether a request's Host is one of this machine's own names or of `hosts`. Otherwise another site's name
/// points at this machine (DNS rebinding).
bool is_our_host(std::string_view host, const std::vector<std::string>& hosts);

/// Whether a page's Origin equals the Host of its request, by http or https. Programs other than browsers
/// send none.
bool is_same_origin(std::string_view origin, std::string_view host);

}  // namespace nplc::panel
