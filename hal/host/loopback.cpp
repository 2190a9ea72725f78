#include "host/loopback.h"

#include <charconv>

namespace nplc::host {
namespace {

/// Decimal, nothing else.
template <typename Number>
std::optional<Number> number_of(std::string_view text) {
    Number value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole ? std::optional(value) : std::nullopt;
}

/// No leading zeros: some programs read 010 as octal.
std::optional<std::uint32_t> ip_of(std::string_view host) {
    if (host == "localhost") host = "127.0.0.1";
    std::uint32_t ip = 0;
    for (int i = 0; i < 4; ++i) {
        const std::size_t end = i < 3 ? host.find('.') : host.size();
        if (end == std::string_view::npos) return std::nullopt;
        const auto part = number_of<std::uint8_t>(host.substr(0, end));
        if (!part || (end > 1 && host[0] == '0')) return std::nullopt;
        ip = ip << 8 | *part;
        host.remove_prefix(i < 3 ? end + 1 : end);
    }
    return ip;
}

}  // namespace

std::optional<LoopbackAddress> loopback_address(std::string_view where) {
    const auto colon = where.rfind(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const auto ip = ip_of(where.substr(0, colon));
    const auto port = number_of<std::uint16_t>(where.substr(colon + 1));
    if (!ip || !port || *ip >> 24 != 127) return std::nullopt;
    return LoopbackAddress{*ip, *port};
}

}  // namespace nplc::host
