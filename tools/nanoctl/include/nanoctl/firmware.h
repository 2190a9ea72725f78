#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nanoctl/gateway_client.h"
#include "nanoctl/transfer.h"
#include "update/image.h"

/// The firmware of a board with a boot loader: the contents of its two slots, and an update (REGISTERS.md,
/// Firmware).
namespace nplc::nanoctl {

struct FirmwareStatus {
    std::uint32_t board = 0;  ///< 0: cannot be updated over this port
    gw::StorePhase phase{};
    gw::Result result{};    ///< of a failed update
    unsigned running = 0;   ///< slot
    bool confirmed = true;  ///< of the running image
    std::array<std::uint32_t, gw::kFirmwareSlots> versions{};
    std::array<std::uint32_t, gw::kFirmwareSlots> slots{};  ///< FIRMWARE_SLOT
    std::uint32_t received = 0;

    unsigned other() const { return 1U - running; }
};

FirmwareStatus firmware_status(GatewayClient& gateway);
/// "1.2.3"
std::string version_text(std::uint32_t version);

/// A firmware linked for one slot, as it is in a file of tools/sign_firmware.
struct FirmwareLink {
    update::ImageHeader header;
    std::span<const std::uint8_t> bytes;  ///< header and image, as they are stored in the slot
};
/// The images of a file, one for each slot, in the slots' order. Empty: the file is something else, or
/// incomplete.
std::vector<FirmwareLink> firmware_links(std::span<const std::uint8_t> file);

/// Stores an image in the slot that is not running, and aborts on any error. Lost pieces are sent again. The
/// next reset starts it.
void send_firmware(GatewayClient& gateway, std::span<const std::uint8_t> bytes, const Progress& progress);

}  // namespace nplc::nanoctl
