#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "base/error.h"
#include "base/result.h"
#include "base/time.h"
#include "ports/storage.h"
#include "registers/vocabulary.h"
#include "store/content.h"
#include "store/layout.h"

namespace nplc::store {

enum class SlotState : std::uint8_t {
    unfinished,  ///< erased, or a write that was not completed
    good,
    damaged,  ///< it was or may have been completed, and its bytes have changed
};

/// Phase of a write; error() has the reason of a failure.
using Phase = registers::gateway::StorePhase;

/// Two slots, one of which is current. New content goes to the other one, is read back and checked there, and
/// becomes the current one when a mark is programmed last. After a power failure at any time, mount() finds
/// the old or the new content, never a mixture, and never none once there was one. The replaced slot is
/// marked as superseded, so that it cannot be taken for the latest when the other one is lost.
///
/// Writing: begin(), write() pieces in order while `receiving`, finish(), and poll() continuously until
/// `done` or `failed`. Each call does at most one storage operation or one read of Storage::kReadAtOnce
/// bytes. The current content can be read meanwhile, with `busy` while the storage is busy.
class Slots {
  public:
    Slots(ports::Storage& storage, const Area& area, Kind kind, Content& content)
        : storage_(storage), content_(content), kind_(kind), layout_(storage.geometry(), area) {}
    Slots(const Slots&) = delete;
    Slots& operator=(const Slots&) = delete;

    /// Reads all bytes of both slots: for a start-up, not for a running loop. Aborts a write in progress.
    /// Errors: busy, bad_geometry, storage_failed.
    base::Status mount();

    bool has_current() const { return current_.has_value(); }
    /// Header of the current content; zeros without one.
    Header current() const { return current_ ? slots_[*current_].header : Header{}; }
    /// There was newer content than the current one, and it is damaged or missing. Cleared by the next
    /// completed write.
    bool is_fallback() const { return fallback_; }
    SlotState state(unsigned slot) const { return slots_[slot & 1U].state; }

    /// Bytes of the current content. Errors: no_table, bad_offset, busy.
    base::Status read(std::uint32_t offset, std::span<std::uint8_t> out);
    /// Copies the whole current content and checks it again; returns its length. If it has changed, the other
    /// slot is tried, if good. Errors: no_table, no_space, busy, damaged.
    base::Result<std::uint32_t> load(std::span<std::uint8_t> out);

    std::uint32_t capacity() const { return layout_.capacity(); }

    /// Aborts a write in progress and begins a new one.
    base::Status begin();
    /// The piece at `offset`: accepted as a whole or not at all. A repeated piece within the last 256 bytes
    /// is accepted if it is the same. Errors: busy (no room yet), not_begun, bad_offset, no_space.
    base::Status write(std::uint32_t offset, std::span<const std::uint8_t> bytes);
    /// `crc` of all `length` bytes, as computed by the sender. May be repeated. Errors: not_begun, busy,
    /// wrong_check (then the write has failed).
    base::Status finish(std::uint32_t length, std::uint32_t crc);
    void abandon() { phase_ = Phase::idle; }
    void poll();
    /// Time of the next poll() needed for the write in progress; `now`: at once.
    base::Instant next_poll(base::Instant now);

    Phase phase() const { return phase_; }
    base::Error error() const { return error_; }          ///< only if phase() is `failed`
    std::uint32_t received() const { return received_; }  ///< bytes accepted by write()

  private:
    static constexpr std::uint32_t kBuffer = kLargestUnit;

    struct Slot {
        SlotState state = SlotState::unfinished;
        bool header_known = false;  ///< header and mark are valid
        bool superseded = false;
        Header header{};
    };
    struct Buffer {
        std::array<std::uint8_t, kBuffer> bytes;  ///< `used` of them
        std::uint32_t begin = 0;  ///< offset in the content of its first byte; of a record its address
        std::uint32_t used = 0;
    };
    /// From `clearing` on the new content is current, and the other slot is marked as superseded.
    enum class Closing : std::uint8_t {
        programming,
        checking,
        header,
        header_back,
        mark,
        mark_back,
        clearing,
        superseding,
    };

    base::Status examine(Slot& slot, unsigned number);
    base::Result<std::uint32_t> crc_of(unsigned slot, std::uint32_t length, std::span<std::uint8_t> out);
    void choose();

    bool wait_for_storage();
    void started(const base::Status& status);
    void erase_next();
    bool is_erased() const { return erased_ == layout_.slot_bytes(); }
    void program_next(std::uint32_t begin);
    bool flushed() const { return flush_.used == flushed_; }
    void flush_fill();
    bool repeats(std::uint32_t offset, std::span<const std::uint8_t> bytes) const;
    void close_next();
    void check_next();
    void end_check();
    void prepare_record(std::span<const std::uint8_t> record, std::uint32_t address, Closing next);
    void program_record(Closing next);
    bool reads_back(std::size_t bytes);
    void set_current();
    void clear_other();
    void end();
    void fail(base::Error error);

    ports::Storage& storage_;
    Content& content_;
    Kind kind_;
    Phase phase_ = Phase::idle;
    base::Error error_{};
    Closing closing_ = Closing::programming;
    bool waiting_ = false;  ///< for the end of a storage operation that was started here
    bool fallback_ = false;
    std::optional<unsigned> current_;
    Layout layout_;
    std::array<Slot, 2> slots_{};

    unsigned target_ = 0;  ///< the slot being written, then the one to be superseded
    std::uint32_t erased_ = 0;
    std::uint32_t received_ = 0;
    std::uint32_t crc_ = 0;
    std::uint32_t checked_ = 0;
    std::uint32_t checked_crc_ = 0;
    std::uint32_t flushed_ = 0;  ///< programmed bytes of flush_, whole units
    std::uint32_t in_hand_ = 0;  ///< bytes of flush_ being programmed
    Header header_;              ///< of the content being written
    Buffer fill_;
    Buffer flush_;
};

/// Marks an erased storage as the replacement of a lost one: mount() then finds no content and reports
/// is_fallback(). Errors as Storage::program, storage_failed.
base::Status note_loss(ports::Storage& storage, const Area& area);

}  // namespace nplc::store
