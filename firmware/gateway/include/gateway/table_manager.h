#pragma once

#include <cstdint>
#include <span>

#include "gateway/command_result.h"
#include "gateway/gateway.h"
#include "gateway/set_points.h"
#include "gateway/standstill.h"
#include "registers/gateway.h"
#include "store/slots.h"
#include "store/table_check.h"

namespace nplc::gateway {

/// Enough for the largest table, with its set-points and its certificate's digest.
inline constexpr std::size_t kTableMemory = (sequencer::kMaxTerms + 1) * sequencer::kTermBytes +
                                            SetPointsPart::kRecordMemory + registers::gateway::kProofBytes;

/// The active table, in the caller's memory; the stored table; and an upload into the store. An upload never
/// changes the active table.
class TableManager final : private store::TermCheck {
  public:
    TableManager(Gateway& gateway, motor::Motor& motor, SetPointsPart& set_points, ports::Storage& storage,
                 const store::Area& area, std::span<std::uint8_t> memory)
        : gateway_(gateway),
          set_points_(set_points),
          memory_(memory),
          standstill_(motor),
          slots_(storage, area, store::Kind::table, check_) {}

    /// For the start-up: reads the store.
    void mount();
    /// The store could be read; else it is unknown whether it has a table.
    bool is_readable() const { return is_readable_; }
    /// Then: makes the stored table the active one. The motor need not be checked for standstill, since run()
    /// stops it before the first scan. nothing_stored: there is none, and none is active. An older table that
    /// replaces a damaged one does not start automatically: the gateway is stopped with bad_table until
    /// run().
    CommandResult start(base::Instant now);
    /// Instead of start(): makes `table` the active one.
    Gateway::LoadResult use(std::span<const std::uint8_t> table, base::Instant now);

    void poll();
    /// When poll() next has work to do for the store.
    base::Instant next_poll(base::Instant now) { return slots_.next_poll(now); }

    base::Status begin_upload();
    /// Writes the piece at `offset`. Error busy: no room yet, retry later.
    base::Status upload(std::uint32_t offset, std::span<const std::uint8_t> piece) {
        return slots_.write(offset, piece);
    }
    base::Status commit(std::uint32_t length, std::uint32_t crc) { return slots_.finish(length, crc); }
    void abandon_upload();
    bool uploads() const;
    std::uint32_t upload_state() const;  ///< register UPLOAD_STATE
    std::uint32_t uploaded() const { return slots_.received(); }

    /// Makes the stored table the active one if the sequence is stopped and the motor stands still.
    void begin_activation(base::Instant now);
    PendingResult poll_activation(base::Instant now);
    base::Instant next_activation(base::Instant now) const { return standstill_.next_poll(now); }
    void drop_activation() { standstill_.drop(); }

    std::span<const std::uint8_t> active() const {
        return active_;
    }  ///< end term included, with the values of set-points in force; empty without one
    std::uint32_t active_crc() const { return active_crc_; }
    /// The bytes that followed the active table's end term in its upload.
    std::span<const std::uint8_t> behind_active() const { return behind_; }
    /// Word of the certificate's digest; 0 without a certificate.
    std::uint32_t proof_word(std::size_t index) const;
    store::Header stored() const { return slots_.current(); }
    std::uint32_t capacity() const;
    bool fell_back() const { return slots_.is_fallback(); }
    bool stored_is_active() const;

  private:
    /// Mark and digest of the certificate behind the end term; empty without one.
    std::span<const std::uint8_t> proof() const;
    bool accepts(sequencer::TermView term) const override { return gateway_.motor_takes(term); }
    CommandResult load_stored(base::Instant now);
    Gateway::LoadResult take(std::size_t length, base::Instant now);

    Gateway& gateway_;
    SetPointsPart& set_points_;
    store::Phase last_phase_ = store::Phase::idle;
    bool is_readable_ = false;
    std::span<std::uint8_t> memory_;
    std::span<const std::uint8_t> active_;
    std::span<const std::uint8_t> behind_;  ///< the bytes behind the end term
    std::uint32_t active_crc_ = 0;
    Standstill standstill_;
    store::TableCheck check_{this};
    store::Slots slots_;
};

}  // namespace nplc::gateway
