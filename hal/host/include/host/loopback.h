#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace nplc::host {

struct LoopbackAddress {
    std::uint32_t ip;  ///< 127.0.0.1 is 7F000001h
    std::uint16_t port;
};

/// HOST:PORT of this machine only, HOST 127.x.x.x or localhost, PORT 0..65535; empty for any other. These
/// lines have no password: no other machine may move a motor.
std::optional<LoopbackAddress> loopback_address(std::string_view where);

}  // namespace nplc::host
