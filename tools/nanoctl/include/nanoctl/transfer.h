#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "nanoctl/gateway_client.h"

/// Tables to and from a gateway.
namespace nplc::nanoctl {

/// Bytes done, and their total.
using Progress = std::function<void(std::size_t done, std::size_t all)>;

/// Stores a table in the gateway, and aborts the upload on any error. Lost pieces are sent again, smaller
/// ones while the line is bad. The active table keeps running.
void upload(GatewayClient& gateway, std::span<const std::uint8_t> table, const Progress& progress);

/// The active table, checked against its length and check sum in the gateway. Empty: there is none.
std::vector<std::uint8_t> download(GatewayClient& gateway, const Progress& progress);

}  // namespace nplc::nanoctl
