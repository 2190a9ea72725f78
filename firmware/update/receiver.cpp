#include "update/receiver.h"

#include <algorithm>

#include "base/crc32.h"

namespace nplc::update {
namespace {

std::uint32_t size_of(std::span<const std::uint8_t> bytes) {
    return static_cast<std::uint32_t>(bytes.size());
}

}  // namespace

Receiver::Receiver(ports::Storage& storage, const Layout& layout, std::uint32_t board, unsigned running)
    : storage_(storage), layout_(layout), board_(board), running_(running) {
    look_again();
}

void Receiver::look_again() {
    for (unsigned slot = 0; slot < kSlots; ++slot) views_[slot] = look(storage_, layout_, slot, board_);
}

void Receiver::confirm() {
    if (waiting_ || is_confirmed() || storage_.state() == ports::StorageState::busy) return;
    program_mark(running_, Mark::confirmed);
    confirming_ = waiting_;
}

Result Receiver::begin(std::uint32_t bytes) {
    if (bytes == 0 || bytes > layout_.capacity()) return Result::no_space;
    if (confirming_) return Result::busy;
    if (!is_confirmed() && views_[target()].is_confirmed()) return Result::not_confirmed;
    phase_ = Phase::erasing;
    room_ = bytes;
    closing_ = Closing::checking;
    erased_ = received_ = programmed_ = in_hand_ = checked_ = checked_crc_ = 0;
    views_[target()] = {};
    return Result::done;
}

Result Receiver::write(std::uint32_t offset, std::span<const std::uint8_t> bytes) {
    if (phase_ == Phase::erasing) return Result::busy;
    if (phase_ != Phase::receiving) return Result::no_upload;
    if (bytes.empty() || bytes.size() > piece_.size() || bytes.size() % 4 != 0) return Result::bad_length;
    if (offset == piece_at_ && offset + size_of(bytes) == received_ &&
        std::equal(bytes.begin(), bytes.end(), piece_.begin()))
        return Result::done;
    if (offset != received_ || received_ % layout_.unit() != 0) return Result::bad_offset;
    if (size_of(bytes) > room_ - received_) return Result::no_space;
    if (programmed_ < received_) return Result::busy;
    std::copy(bytes.begin(), bytes.end(), piece_.begin());
    std::fill(piece_.begin() + size_of(bytes), piece_.end(), std::uint8_t{0xFF});
    piece_at_ = offset;
    received_ += size_of(bytes);
    return Result::done;
}

Result Receiver::finish(std::uint32_t length, std::uint32_t crc) {
    const bool repeats = length == received_ && crc == crc_;
    if ((phase_ == Phase::closing || phase_ == Phase::done) && repeats) return Result::done;
    if (phase_ == Phase::erasing) return Result::busy;
    if (phase_ != Phase::receiving) return Result::no_upload;
    if (length != received_) {
        fail(Result::wrong_check);
        return Result::wrong_check;
    }
    crc_ = crc;
    phase_ = Phase::closing;
    return Result::done;
}

void Receiver::abandon() {
    if (phase_ != Phase::done) phase_ = Phase::idle;
}

void Receiver::poll() {
    if (wait_for_storage()) return;
    switch (phase_) {
        case Phase::erasing:
            return erase_next();
        case Phase::receiving:
            return program_next();
        case Phase::closing:
            return close_next();
        case Phase::idle:
        case Phase::done:
        case Phase::failed:
            return;
    }
}

/// True while the storage is busy, and after a failed operation of this object.
bool Receiver::wait_for_storage() {
    const ports::StorageState state = storage_.state();
    if (state == ports::StorageState::busy) return true;
    if (!waiting_) return false;
    waiting_ = false;
    if (confirming_) {
        confirming_ = false;
        look_again();
        return true;
    }
    if (state == ports::StorageState::ready) {
        programmed_ += in_hand_;
        in_hand_ = 0;
        return false;
    }
    fail(Result::storage_failed);
    return true;
}

/// The block with the marks first: from then on the slot is not started.
void Receiver::erase_next() {
    const std::uint32_t blocks = 1 + (room_ + layout_.block() - 1) / layout_.block();
    if (erased_ == blocks) {
        phase_ = Phase::receiving;
        return;
    }
    const std::uint32_t address =
        erased_ == 0 ? layout_.marks(target()) : layout_.header(target()) + (erased_ - 1) * layout_.block();
    waiting_ = storage_.erase(address).ok();
    if (waiting_) {
        ++erased_;
    } else {
        fail(Result::storage_failed);
    }
}

/// The last bytes are padded to a whole unit.
void Receiver::program_next() {
    if (programmed_ >= received_) return;
    const std::uint32_t from = programmed_ - piece_at_;
    const std::uint32_t unit = layout_.unit();
    const std::uint32_t left = (received_ - programmed_ + unit - 1) / unit * unit;
    const std::uint32_t address = layout_.header(target()) + programmed_;
    in_hand_ = layout_.one_programming(address, left);
    waiting_ = storage_.program(address, std::span(piece_).subspan(from, in_hand_)).ok();
    if (!waiting_) fail(Result::storage_failed);
}

void Receiver::close_next() {
    if (programmed_ < received_) return program_next();
    switch (closing_) {
        case Closing::checking:
            return check_next();
        case Closing::marking:
            closing_ = Closing::marked;
            program_mark(target(), Mark::complete);
            if (!waiting_) fail(Result::storage_failed);
            return;
        case Closing::marked:
            look_again();
            if (!views_[target()].marks.complete) return fail(Result::storage_failed);
            phase_ = Phase::done;
            return;
    }
}

void Receiver::check_next() {
    std::array<std::uint8_t, ports::Storage::kReadAtOnce> piece{};
    const auto bytes = std::span(piece).first(std::min<std::size_t>(piece.size(), received_ - checked_));
    if (bytes.empty()) return end_check();
    if (!storage_.read(layout_.header(target()) + checked_, bytes)) return fail(Result::storage_failed);
    checked_crc_ = base::crc32(bytes, checked_crc_);
    checked_ += size_of(bytes);
}

/// A piece damaged in transmission and one that the storage did not keep cannot be distinguished here.
void Receiver::end_check() {
    if (checked_crc_ != crc_) return fail(Result::wrong_check);
    const Result judgement = judge();
    if (judgement != Result::done) return fail(judgement);
    closing_ = Closing::marking;
}

Result Receiver::judge() const {
    std::array<std::uint8_t, kSignedBytes> bytes{};
    if (!storage_.read(layout_.header(target()), bytes)) return Result::storage_failed;
    const auto header = decode(bytes);
    if (!header) return Result::bad_firmware;
    if (header->board != board_) return Result::other_board;
    const bool is_whole = received_ == kImageAt + (header->length + 3) / 4 * 4;
    if (!is_whole || !layout_.fits(*header, target(), board_)) return Result::bad_firmware;
    const auto& mine = views_[running_].header;
    return mine && header->version <= mine->version ? Result::not_newer : Result::done;
}

void Receiver::program_mark(unsigned slot, Mark mark) {
    const auto place = place_for(storage_, layout_, slot, mark);
    mark_ = bytes_of(mark);
    waiting_ = place && storage_.program(*place, std::span(mark_).first(layout_.unit())).ok();
}

void Receiver::fail(Result error) {
    waiting_ = false;
    in_hand_ = 0;
    error_ = error;
    phase_ = Phase::failed;
}

}  // namespace nplc::update
