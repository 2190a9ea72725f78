#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "registers/vocabulary.h"
#include "update/marks.h"

namespace nplc::update {

using Phase = registers::gateway::StorePhase;
using Result = registers::gateway::Result;

/// The application's part of the update: writes an image into the slot that it does not run from, and
/// confirms its own.
///
/// Receiving: begin(), write() pieces in order while `receiving`, finish(), and poll() continuously until
/// `done` or `failed`. Each call does at most one operation of the storage or one read of
/// Storage::kReadAtOnce bytes. The received image is started at the chip's next start.
class Receiver {
  public:
    static constexpr std::size_t kLargestPiece = 120;

    /// `running`: the slot that this code runs from.
    Receiver(ports::Storage& storage, const Layout& layout, std::uint32_t board, unsigned running);
    Receiver(const Receiver&) = delete;
    Receiver& operator=(const Receiver&) = delete;

    std::uint32_t board() const { return board_; }
    unsigned running() const { return running_; }
    const SlotView& slot(unsigned number) const { return views_[number & 1U]; }
    /// Of the running image.
    bool is_confirmed() const { return views_[running_].marks.confirmed; }
    /// The running image is healthy. is_confirmed() is true once poll() has recorded that.
    void confirm();

    /// Erases the other slot for `bytes`. Errors: no_space, busy; not_confirmed: the other slot is the
    /// fallback of an image on trial.
    Result begin(std::uint32_t bytes);
    /// The piece at `offset`, a multiple of 4 bytes, and of the program unit except for the last: accepted as
    /// a whole or not at all. A repeated piece is accepted if it is the same. Errors: busy: no room yet,
    /// retry later; no_upload, bad_offset, bad_length, no_space.
    Result write(std::uint32_t offset, std::span<const std::uint8_t> bytes);
    /// `crc` of all `length` bytes, as computed by the sender. Errors: busy, no_upload, wrong_check.
    Result finish(std::uint32_t length, std::uint32_t crc);
    void abandon();
    void poll();

    Phase phase() const { return phase_; }
    /// Valid if phase() is `failed`: the errors of finish(), storage_failed, bad_firmware (no header, or one
    /// for the other slot), other_board, not_newer.
    Result error() const { return error_; }
    std::uint32_t received() const { return received_; }

  private:
    enum class Closing : std::uint8_t { checking, marking, marked };

    unsigned target() const { return 1U - running_; }
    bool wait_for_storage();
    void erase_next();
    void program_next();
    void close_next();
    void check_next();
    void end_check();
    void program_mark(unsigned slot, Mark mark);
    Result judge() const;
    void fail(Result error);
    void look_again();

    ports::Storage& storage_;
    const Layout& layout_;
    std::uint32_t board_;
    unsigned running_;
    Phase phase_ = Phase::idle;
    Closing closing_ = Closing::checking;
    Result error_ = Result::done;
    bool waiting_ = false;     ///< for the end of a storage operation that was started here
    bool confirming_ = false;  ///< that operation is the confirmation
    std::array<SlotView, kSlots> views_;

    std::uint32_t room_ = 0;    ///< bytes, as announced
    std::uint32_t erased_ = 0;  ///< blocks
    std::uint32_t received_ = 0;
    std::uint32_t programmed_ = 0;  ///< bytes of received_
    std::uint32_t in_hand_ = 0;     ///< bytes being programmed
    std::uint32_t checked_ = 0;
    std::uint32_t checked_crc_ = 0;
    std::uint32_t crc_ = 0;  ///< as announced
    std::array<std::uint8_t, kLargestPiece> piece_{};
    std::uint32_t piece_at_ = 0;  ///< offset of its first byte
    std::array<std::uint8_t, kLargestUnit> mark_{};
};

}  // namespace nplc::update
