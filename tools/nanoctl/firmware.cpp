#include "nanoctl/firmware.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/bytes.h"
#include "base/crc32.h"

namespace nplc::nanoctl {
namespace {

using gw::StorePhase;
using mactalk_client::LineError;

constexpr std::size_t kOffsetBytes = 4;
constexpr std::size_t kLargestFirmwarePiece = 120;
constexpr std::size_t kSmallestFirmwarePiece = 8;
constexpr unsigned kFirmwareLostInARow = 40;
constexpr base::Milliseconds kFirmwareRoomWait{1'000};
constexpr base::Milliseconds kFirmwarePollPause{50};
constexpr unsigned kMostFirmwarePolls = 600;

[[noreturn]] void firmware_failed(gw::Result result) {
    throw Refused(
        result, gw::FIRMWARE_STATE, 0,
        fmt::format("the firmware was not stored: {}; what runs is unchanged, and starts no sequence before "
                    "`nanoctl reset`",
                    gw::describe(result)));
}

FirmwareStatus firmware_after(GatewayClient& gateway, StorePhase phase) {
    for (unsigned i = 0; i < kMostFirmwarePolls; ++i) {
        const FirmwareStatus status = firmware_status(gateway);
        if (status.phase == StorePhase::failed) firmware_failed(status.result);
        if (status.phase != phase) return status;
        gateway.look_for_interruption();
        gateway.master().pause(kFirmwarePollPause);
    }
    throw LineError(LineError::Kind::no_answer, "the board's flash does not come to an end; restart it");
}

bool send_firmware_piece(GatewayClient& gateway, std::span<const std::uint8_t> bytes, std::size_t at,
                         std::size_t size) {
    std::vector<std::uint8_t> message(kOffsetBytes + size);
    base::store_u32(message.data(), static_cast<std::uint32_t>(at));
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), size, message.begin() + kOffsetBytes);
    return gateway.master().try_write_long(gateway.address(), gw::FIRMWARE_DATA, message, kFirmwareRoomWait);
}

void send_firmware_pieces(GatewayClient& gateway, std::span<const std::uint8_t> bytes,
                          const Progress& progress) {
    std::size_t sent = 0;
    std::size_t piece = kLargestFirmwarePiece;
    unsigned lost_in_a_row = 0;
    while (sent < bytes.size()) {
        gateway.look_for_interruption();
        progress(sent, bytes.size());
        const std::size_t size = std::min(piece, bytes.size() - sent);
        if (send_firmware_piece(gateway, bytes, sent, size)) {
            sent += size;
            lost_in_a_row = 0;
            continue;
        }
        const FirmwareStatus status = firmware_status(gateway);
        if (status.phase != StorePhase::receiving)
            firmware_failed(status.phase == StorePhase::failed ? status.result : gw::Result::no_upload);
        lost_in_a_row = status.received > sent ? 0 : lost_in_a_row + 1;
        sent = std::min<std::size_t>(status.received, bytes.size());
        piece = std::max(piece / 2 / kSmallestFirmwarePiece * kSmallestFirmwarePiece, kSmallestFirmwarePiece);
        if (lost_in_a_row == kFirmwareLostInARow)
            throw LineError(LineError::Kind::no_answer,
                            fmt::format("{}: byte {} of the firmware was never accepted; the line is too bad",
                                        gateway.master().wire().name(), sent));
    }
    progress(sent, bytes.size());
}

void abort_firmware(GatewayClient& gateway) {
    try {
        gateway.command(gw::Command::firmware_abort);
    } catch (const std::exception&) {
        // The next begin cancels it too
    }
}

}  // namespace

FirmwareStatus firmware_status(GatewayClient& gateway) {
    const Block block = gateway.read_block(gw::FIRMWARE_BOARD);
    const auto at = [&](unsigned reg) { return block[reg - gw::FIRMWARE_BOARD]; };
    const std::uint32_t state = at(gw::FIRMWARE_STATE);
    return {.board = at(gw::FIRMWARE_BOARD),
            .phase = static_cast<StorePhase>(state & 0xFF),
            .result = static_cast<gw::Result>((state >> 8) & 0xFF),
            .running = (state & gw::kFirmwareSlot) != 0 ? 1U : 0U,
            .confirmed = (state & gw::kFirmwareConfirmed) != 0,
            .versions = {at(gw::FIRMWARE_VERSION), at(gw::FIRMWARE_VERSION + 1)},
            .slots = {at(gw::FIRMWARE_SLOT), at(gw::FIRMWARE_SLOT + 1)},
            .received = at(gw::FIRMWARE_RECEIVED)};
}

std::string version_text(std::uint32_t version) {
    return fmt::format("{}.{}.{}", version >> 16, (version >> 8) & 0xFF, version & 0xFF);
}

std::vector<FirmwareLink> firmware_links(std::span<const std::uint8_t> file) {
    std::vector<FirmwareLink> links;
    while (file.size() > update::kImageAt) {
        const auto header = update::decode(file.first<update::kSignedBytes>());
        if (!header || header->length > file.size() - update::kImageAt) return {};
        const std::size_t size = update::kImageAt + (std::size_t{header->length} + 3) / 4 * 4;
        if (size > file.size()) return {};
        links.push_back({*header, file.first(size)});
        file = file.subspan(size);
    }
    if (!file.empty() || links.size() != gw::kFirmwareSlots) return {};
    std::sort(links.begin(), links.end(), [](const FirmwareLink& a, const FirmwareLink& b) {
        return a.header.address < b.header.address;
    });
    return links;
}

void send_firmware(GatewayClient& gateway, std::span<const std::uint8_t> bytes, const Progress& progress) {
    gateway.write(gw::UPLOAD_BYTES, static_cast<std::uint32_t>(bytes.size()));
    gateway.command(gw::Command::firmware_begin);
    try {
        firmware_after(gateway, StorePhase::erasing);
        send_firmware_pieces(gateway, bytes, progress);
        gateway.write(gw::UPLOAD_CRC, base::crc32(bytes));
        gateway.command(gw::Command::firmware_commit);
        firmware_after(gateway, StorePhase::closing);
    } catch (...) {
        abort_firmware(gateway);
        throw;
    }
}

}  // namespace nplc::nanoctl
