#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nanoctl/gateway_client.h"
#include "nanoctl/transfer.h"
#include "update/image.h"

/// The firmware of a board with a loader: what is in its two slots, and a new one (REGISTERS.md, Firmware).
namespace nplc::nanoctl {

struct FirmwareStatus {
    std::uint32_t board = 0;  ///< 0: it is not renewed over this port
    gw::StorePhase phase{};
    gw::Result result{};    ///< of a failed phase
    unsigned running = 0;   ///< slot
    bool confirmed = true;  ///< the running one is
    std::array<std::uint32_t, gw::kFirmwareSlots> versions{};
    std::array<std::uint32_t, gw::kFirmwareSlots> slots{};  ///< FIRMWARE_SLOT
    std::uint32_t received = 0;

    unsigned other() const { return 1U - running; }
};

FirmwareStatus firmware_status(GatewayClient& gateway);
/// "1.2.3"
std::string version_text(std::uint32_t version);

/// One link of a firmware, as a file of tools/sign_firmware has them.
struct FirmwareLink {
    update::ImageHeader header;
    std::span<const std::uint8_t> bytes;  ///< header and image, as they go into the slot
};
/// Those of a file, one for each slot, in the slots' order. Empty: the file is something else, or a part.
std::vector<FirmwareLink> firmware_links(std::span<const std::uint8_t> file);

/// Stores a link in the slot that does not run, and gives that up if anything goes wrong. Pieces that are
/// lost are sent again. The next reset starts it.
void send_firmware(GatewayClient& gateway, std::span<const std::uint8_t> bytes, const Progress& progress);

}  // namespace nplc::nanoctl
