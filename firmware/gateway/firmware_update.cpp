#include "gateway/firmware_update.h"

namespace nplc::gateway {

using namespace registers::gateway;

namespace {

std::uint32_t slot_state(const update::SlotView& slot) {
    std::uint32_t state = std::uint32_t{slot.marks.tries} << 8;
    if (slot.is_complete()) state |= kSlotComplete;
    if (slot.is_confirmed()) state |= kSlotConfirmed;
    return state;
}

}  // namespace

Result FirmwareUpdate::abandon() {
    receiver_->abandon();
    return Result::done;
}

Result FirmwareUpdate::write(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kOffsetBytes = 4;
    if (bytes.size() < kOffsetBytes) return Result::bad_length;
    return receiver_->write(base::load_u32(bytes.data()), bytes.subspan(kOffsetBytes));
}

std::uint32_t FirmwareUpdate::state() const {
    const update::Phase phase = receiver_->phase();
    auto state = static_cast<std::uint32_t>(phase);
    if (phase == update::Phase::failed) state |= static_cast<std::uint32_t>(receiver_->error()) << 8;
    if (receiver_->running() != 0) state |= kFirmwareSlot;
    if (receiver_->is_confirmed()) state |= kFirmwareConfirmed;
    return state;
}

std::uint32_t FirmwareUpdate::value(std::uint8_t reg) const {
    const update::SlotView& slot = receiver_->slot(reg & 1U);  // both register pairs begin at an even number
    switch (reg) {
        case FIRMWARE_BOARD:
            return receiver_->board();
        case FIRMWARE_STATE:
            return state();
        case FIRMWARE_VERSION:
        case FIRMWARE_VERSION + 1:
            return slot.header ? slot.header->version : 0;
        case FIRMWARE_SLOT:
        case FIRMWARE_SLOT + 1:
            return slot_state(slot);
        default:
            return receiver_->received();
    }
}

void FirmwareUpdate::poll(std::uint32_t uptime, bool was_reached) {
    if (receiver_->phase() == update::Phase::erasing) {
        if (uptime - erased_at_ < kEraseEvery) return;
        erased_at_ = uptime;
    }
    receiver_->poll();
    if (was_reached && uptime >= kHealthyAfter) receiver_->confirm();
}

}  // namespace nplc::gateway
