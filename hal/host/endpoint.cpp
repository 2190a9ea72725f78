#include "host/endpoint.h"

namespace nplc::host {
namespace {

struct Scheme {
    Endpoint::Kind kind;
    std::string_view prefix;
};

constexpr Scheme kSchemes[] = {
    {Endpoint::Kind::pty, "pty:"},
    {Endpoint::Kind::unix_socket, "unix:"},
    {Endpoint::Kind::tcp, "tcp:"},
    {Endpoint::Kind::can, "can:"},
};

}  // namespace

Endpoint::Endpoint(std::string_view text) : place(text) {
    for (const Scheme& scheme : kSchemes) {
        if (!text.starts_with(scheme.prefix)) continue;
        kind = scheme.kind;
        place = text.substr(scheme.prefix.size());
    }
}

std::string Endpoint::text(Kind kind, std::string_view place) {
    for (const Scheme& scheme : kSchemes) {
        if (scheme.kind == kind) return std::string(scheme.prefix).append(place);
    }
    return std::string(place);
}

}  // namespace nplc::host
