#include <algorithm>

#include "base/crc32.h"
#include "store/slots.h"

namespace nplc::store {

base::Status Slots::begin() {
    if (!layout_.is_possible()) return base::Error::bad_geometry;
    phase_ = Phase::erasing;
    closing_ = Closing::programming;
    waiting_ = false;
    target_ = current_ ? 1U - *current_ : 0U;
    slots_[target_] = {};
    erased_ = received_ = crc_ = 0;
    fill_.begin = fill_.used = 0;
    flush_.begin = flush_.used = 0;
    flushed_ = in_hand_ = 0;
    return {};
}

base::Status Slots::write(std::uint32_t offset, std::span<const std::uint8_t> bytes) {
    if (phase_ == Phase::erasing) return base::Error::busy;
    if (phase_ != Phase::receiving) return base::Error::not_begun;
    if (offset != received_) return repeats(offset, bytes) ? base::Status{} : base::Error::bad_offset;
    if (bytes.size() > layout_.capacity() - received_) return base::Error::no_space;
    if (bytes.size() > kBuffer - fill_.used + (flushed() ? kBuffer : 0)) return base::Error::busy;
    crc_ = base::crc32(bytes, crc_);
    received_ += static_cast<std::uint32_t>(bytes.size());
    while (!bytes.empty()) {
        if (fill_.used == kBuffer) flush_fill();
        const auto piece = bytes.first(std::min<std::size_t>(bytes.size(), kBuffer - fill_.used));
        std::copy(piece.begin(), piece.end(), fill_.bytes.begin() + fill_.used);
        fill_.used += static_cast<std::uint32_t>(piece.size());
        bytes = bytes.subspan(piece.size());
    }
    return {};
}

/// The last bytes are still in the two buffers, one after the other up to received_.
bool Slots::repeats(std::uint32_t offset, std::span<const std::uint8_t> bytes) const {
    if (offset > received_ || received_ - offset < bytes.size() || bytes.empty()) return false;
    for (const std::uint8_t byte : bytes) {
        const Buffer& buffer = offset >= fill_.begin ? fill_ : flush_;
        if (offset < buffer.begin || buffer.bytes[offset - buffer.begin] != byte) return false;
        ++offset;
    }
    return true;
}

base::Status Slots::finish(std::uint32_t length, std::uint32_t crc) {
    const bool same = length == received_ && crc == crc_;
    if ((phase_ == Phase::closing || phase_ == Phase::done) && same) return {};
    if (phase_ == Phase::erasing) return base::Error::busy;
    if (phase_ != Phase::receiving) return base::Error::not_begun;
    if (!same) {
        fail(base::Error::wrong_check);
        return base::Error::wrong_check;
    }
    phase_ = Phase::closing;
    return {};
}

void Slots::poll() {
    const bool works = phase_ == Phase::erasing || phase_ == Phase::receiving || phase_ == Phase::closing;
    if (!works || wait_for_storage()) return;
    if (phase_ == Phase::closing) return close_next();
    if (phase_ == Phase::receiving) {
        if (flushed() && fill_.used == kBuffer) flush_fill();
        if (!flushed()) program_next(layout_.content(target_));
    } else if (is_erased()) {
        phase_ = Phase::receiving;
    } else {
        erase_next();
    }
}

base::Instant Slots::next_poll(base::Instant now) {
    constexpr base::Microseconds kLook{1'000};
    const bool has_bytes = waiting_ || !flushed() || fill_.used == kBuffer;
    const bool works =
        phase_ == Phase::erasing || phase_ == Phase::closing || (phase_ == Phase::receiving && has_bytes);
    if (!works) return base::kNever;
    return storage_.state() == ports::StorageState::busy ? now + kLook : now;
}

/// True while the storage is busy, for any user, and after a failed operation of this object.
bool Slots::wait_for_storage() {
    const ports::StorageState state = storage_.state();
    if (state == ports::StorageState::busy) return true;
    if (!waiting_) return false;
    waiting_ = false;
    if (state == ports::StorageState::ready) {
        flushed_ += in_hand_;
        in_hand_ = 0;
        return false;
    }
    fail(base::Error::storage_failed);
    return true;
}

void Slots::started(const base::Status& status) {
    waiting_ = status.ok();
    if (!status && status.error() != base::Error::busy) fail(status.error());
}

void Slots::erase_next() {
    started(storage_.erase(layout_.header(target_) + erased_));
    if (waiting_) erased_ += layout_.erase_block();
}

/// Moves the filled bytes to the program buffer, in whole units.
void Slots::flush_fill() {
    flush_.bytes = fill_.bytes;
    flush_.begin = fill_.begin;
    flush_.used = layout_.whole_units(fill_.used);
    std::fill(flush_.bytes.begin() + fill_.used, flush_.bytes.end(), std::uint8_t{0xFF});
    flushed_ = 0;
    fill_.begin += fill_.used;
    fill_.used = 0;
}

/// `begin`: address to which flush_.begin is relative.
void Slots::program_next(std::uint32_t begin) {
    const std::uint32_t address = begin + flush_.begin + flushed_;
    const std::uint32_t count = layout_.one_programming(address, flush_.used - flushed_);
    started(storage_.program(address, std::span(flush_.bytes).subspan(flushed_, count)));
    if (waiting_) in_hand_ = count;
}

void Slots::close_next() {
    switch (closing_) {
        case Closing::programming:
            if (flushed() && fill_.used > 0) flush_fill();
            if (!flushed()) return program_next(layout_.content(target_));
            checked_ = checked_crc_ = 0;
            content_.begin();
            closing_ = Closing::checking;
            return;
        case Closing::checking:
            return check_next();
        case Closing::header:
            return program_record(Closing::header_back);
        case Closing::header_back:
            if (reads_back(kHeaderBytes))
                prepare_record(mark_for(encode(header_)), layout_.mark(target_), Closing::mark);
            return;
        case Closing::mark:
            return program_record(Closing::mark_back);
        case Closing::mark_back:
            if (reads_back(kMarkBytes)) set_current();
            return;
        case Closing::clearing:
            return clear_other();
        case Closing::superseding:
            return flushed() ? end() : program_record(closing_);
    }
}

void Slots::check_next() {
    std::array<std::uint8_t, ports::Storage::kReadAtOnce> piece;
    const auto bytes = std::span(piece).first(std::min<std::size_t>(piece.size(), received_ - checked_));
    if (bytes.empty()) return end_check();
    if (const auto status = storage_.read(layout_.content(target_) + checked_, bytes); !status)
        return fail(status.error());
    checked_crc_ = base::crc32(bytes, checked_crc_);
    checked_ += static_cast<std::uint32_t>(bytes.size());
    if (const auto status = content_.take(bytes); !status) fail(status.error());
}

void Slots::end_check() {
    if (checked_crc_ != crc_) return fail(base::Error::storage_failed);
    if (const auto status = content_.end(); !status) return fail(status.error());
    const Slot& other = slots_[1U - target_];
    header_ = {.kind = kind_,
               .sequence = other.header_known ? other.header.sequence + 1 : 1,
               .length = received_,
               .crc = crc_};
    prepare_record(encode(header_), layout_.header(target_), Closing::header);
}

/// Header and mark are programmed through flush_, which is free in this phase.
void Slots::prepare_record(std::span<const std::uint8_t> record, std::uint32_t address, Closing next) {
    flush_.bytes.fill(0xFF);
    std::copy(record.begin(), record.end(), flush_.bytes.begin());
    flush_.begin = address;
    flush_.used = layout_.whole_units(record.size());
    flushed_ = 0;
    closing_ = next;
}

void Slots::program_record(Closing next) {
    if (flushed()) {
        closing_ = next;
        return;
    }
    program_next(0);
}

bool Slots::reads_back(std::size_t bytes) {
    std::array<std::uint8_t, kHeaderBytes> piece;
    const auto record = std::span(piece).first(bytes);
    const auto status = storage_.read(flush_.begin, record);
    const bool same = status.ok() && std::equal(record.begin(), record.end(), flush_.bytes.begin());
    if (!same) fail(status.ok() ? base::Error::storage_failed : status.error());
    return same;
}

/// The superseded byte of the other slot needs an erased unit; in a good slot it was erased with the slot.
void Slots::set_current() {
    current_ = target_;
    slots_[target_] = {.state = SlotState::good, .header_known = true, .header = header_};
    target_ = 1U - target_;
    erased_ = layout_.slot_bytes();
    const SlotState other = slots_[target_].state;
    if (other == SlotState::unfinished) erased_ -= layout_.erase_block();
    if (other == SlotState::damaged) erased_ = 0;
    if (other != SlotState::good) slots_[target_] = {};
    closing_ = Closing::clearing;
}

void Slots::clear_other() {
    constexpr std::array<std::uint8_t, 1> kSuperseded{0};
    if (!is_erased()) return erase_next();
    if (slots_[target_].superseded) return end();
    prepare_record(kSuperseded, layout_.superseded(target_), Closing::superseding);
}

void Slots::end() {
    slots_[target_].superseded = true;
    choose();
    phase_ = Phase::done;
}

/// Once the new content is current it stays so, even if marking the other slot fails.
void Slots::fail(base::Error error) {
    waiting_ = false;
    if (closing_ >= Closing::clearing) return end();
    error_ = error;
    phase_ = Phase::failed;
}

base::Status note_loss(ports::Storage& storage, const Area& area) {
    const std::array<std::uint8_t, kLargestUnit> note{};
    const ports::StorageGeometry geometry = storage.geometry();
    const std::uint32_t address = Layout(geometry, area).superseded(0);
    const auto begun = storage.program(address, std::span(note).first(geometry.program_unit));
    if (!begun) return begun;
    while (storage.state() == ports::StorageState::busy) continue;
    return storage.state() == ports::StorageState::ready ? base::Status{} : base::Error::storage_failed;
}

}  // namespace nplc::store
