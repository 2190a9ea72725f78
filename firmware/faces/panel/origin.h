#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nplc::panel {

/// `Name:80` becomes `name`; `[::1]:80` becomes `[::1]`.
std::string host_name(std::string_view host);

/// A request's Host names us: this machine by its own names, or one of `hosts`. Else another site's name was
/// pointed at this machine.
bool is_our_host(std::string_view host, const std::vector<std::string>& hosts);

/// A page's Origin is the Host that it asks, by http or https. Programs that are no browser send none.
bool is_same_origin(std::string_view origin, std::string_view host);

}  // namespace nplc::panel
