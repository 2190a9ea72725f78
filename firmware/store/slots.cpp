#include "store/slots.h"

#include <algorithm>

#include "base/crc32.h"

namespace nplc::store {
namespace {

bool is_blank(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) {
        if (byte != 0xFF) return false;
    }
    return true;
}

}  // namespace

base::Status Slots::mount() {
    if (!layout_.is_possible()) return base::Error::bad_geometry;
    for (unsigned i = 0; i < slots_.size(); ++i) {
        if (const auto status = examine(slots_[i], i); !status) return status;
    }
    choose();
    return {};
}

base::Status Slots::examine(Slot& slot, unsigned number) {
    std::array<std::uint8_t, kHeaderBytes> header;
    std::array<std::uint8_t, kMarkBytes> mark;
    std::array<std::uint8_t, 1> superseded;
    slot = {};
    if (const auto status = storage_.read(layout_.header(number), header); !status) return status;
    if (const auto status = storage_.read(layout_.mark(number), mark); !status) return status;
    if (const auto status = storage_.read(layout_.superseded(number), superseded); !status) return status;
    slot.superseded = !is_blank(superseded);
    if (is_blank(mark)) return {};
    slot.state = SlotState::damaged;
    const auto decoded = decode(header);
    slot.header_known = decoded.ok() && decoded.value().kind == kind_ &&
                        decoded.value().length <= layout_.capacity() && mark == mark_for(header);
    if (!slot.header_known) return {};
    slot.header = decoded.value();
    const auto crc = crc_of(number, slot.header.length, {});
    if (!crc) return crc.error();
    if (crc.value() == slot.header.crc) slot.state = SlotState::good;
    return {};
}

/// In pieces, and copied to `out` if that is not empty.
base::Result<std::uint32_t> Slots::crc_of(unsigned slot, std::uint32_t length, std::span<std::uint8_t> out) {
    std::array<std::uint8_t, ports::Storage::kReadAtOnce> piece;
    std::uint32_t crc = 0;
    for (std::uint32_t at = 0; at < length;) {
        const auto bytes = std::span(piece).first(std::min<std::size_t>(piece.size(), length - at));
        if (const auto status = storage_.read(layout_.content(slot) + at, bytes); !status)
            return status.error();
        crc = base::crc32(bytes, crc);
        if (!out.empty()) std::copy(bytes.begin(), bytes.end(), &out[at]);
        at += static_cast<std::uint32_t>(bytes.size());
    }
    return crc;
}

/// Chooses the newer of the good slots. For a damaged slot without a valid mark, the good slot's superseded
/// byte tells whether it was ever completed.
void Slots::choose() {
    current_.reset();
    for (unsigned i = 0; i < slots_.size(); ++i) {
        if (slots_[i].state != SlotState::good) continue;
        if (!current_ || is_later(slots_[i].header.sequence, slots_[*current_].header.sequence)) current_ = i;
    }
    fallback_ = false;
    for (unsigned i = 0; i < slots_.size(); ++i) {
        const Slot& slot = slots_[i];
        if (slot.superseded) fallback_ |= !current_ || i == *current_;
        if (slot.state != SlotState::damaged) continue;
        fallback_ |= !current_ ||
                     (slot.header_known && is_later(slot.header.sequence, slots_[*current_].header.sequence));
    }
}

base::Status Slots::read(std::uint32_t offset, std::span<std::uint8_t> out) {
    if (!current_) return base::Error::no_table;
    const std::uint32_t length = slots_[*current_].header.length;
    if (offset > length || length - offset < out.size()) return base::Error::bad_offset;
    return storage_.read(layout_.content(*current_) + offset, out);
}

base::Result<std::uint32_t> Slots::load(std::span<std::uint8_t> out) {
    while (current_) {
        const Header header = slots_[*current_].header;
        if (header.length > out.size()) return base::Error::no_space;
        const auto crc = crc_of(*current_, header.length, out);
        if (!crc) return crc.error();
        if (crc.value() == header.crc) return header.length;
        slots_[*current_].state = SlotState::damaged;
        choose();
        if (!current_) return base::Error::damaged;
    }
    return fallback_ ? base::Error::damaged : base::Error::no_table;
}

}  // namespace nplc::store
