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

/// For every table that a gateway takes, with its set-points and its certificate's digest.
inline constexpr std::size_t kTableMemory = (sequencer::kMaxTerms + 1) * sequencer::kTermBytes +
                                            SetPointsPart::kRecordMemory + registers::gateway::kProofBytes;

/// The table that the sequence runs, in the caller's memory; the stored one; and a new one on its way into
/// the store. Uploading never touches the active table.
class TableManager final : private store::TermCheck {
  public:
    TableManager(Gateway& gateway, motor::Motor& motor, SetPointsPart& set_points, ports::Storage& storage,
                 const store::Area& area, std::span<std::uint8_t> memory)
        : gateway_(gateway),
          set_points_(set_points),
          memory_(memory),
          standstill_(motor),
          slots_(storage, area, store::Kind::table, check_) {}

    /// For the start-up: looks at the store.
    void mount();
    /// It could be looked at: else nobody knows whether there is a table.
    bool is_readable() const { return is_readable_; }
    /// Then: the stored table, if there is one, becomes the active one. It needs no question to the motor,
    /// since run() stops it before the first scan. nothing_stored: there is none, and none is active. One
    /// that stands in for a damaged one does not start by itself: the gateway is stopped with bad_table until
    /// run().
    CommandResult start(base::Instant now);
    /// Or: `table` becomes the active one.
    Gateway::LoadResult use(std::span<const std::uint8_t> table, base::Instant now);

    void poll();
    /// Of poll(): when it has something to do for the store.
    base::Instant next_poll(base::Instant now) { return slots_.next_poll(now); }

    base::Status begin_upload();
    /// The piece for `offset`. Error busy: no room yet, the same again later.
    base::Status upload(std::uint32_t offset, std::span<const std::uint8_t> piece) {
        return slots_.write(offset, piece);
    }
    base::Status commit(std::uint32_t length, std::uint32_t crc) { return slots_.finish(length, crc); }
    void abandon_upload();
    bool uploads() const;
    std::uint32_t upload_state() const;  ///< register UPLOAD_STATE
    std::uint32_t uploaded() const { return slots_.received(); }

    /// The stored table becomes the active one if the sequence is stopped and the motor stands still.
    void begin_activation(base::Instant now);
    Progress poll_activation(base::Instant now);
    base::Instant next_activation(base::Instant now) const { return standstill_.next_poll(now); }
    void drop_activation() { standstill_.drop(); }

    std::span<const std::uint8_t> active() const {
        return active_;
    }  ///< end term included, with the values of set-points in force; empty without one
    std::uint32_t active_crc() const { return active_crc_; }
    /// What followed the active table's end term when it was uploaded.
    std::span<const std::uint8_t> behind_active() const { return behind_; }
    /// Of the digest of its certificate; 0 without one.
    std::uint32_t proof_word(std::size_t index) const;
    store::Header stored() const { return slots_.current(); }
    std::uint32_t capacity() const;
    bool fell_back() const { return slots_.is_fallback(); }
    bool stored_is_active() const;

  private:
    /// Of what follows the end term the certificate's mark and digest; empty without one.
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
    std::span<const std::uint8_t> behind_;  ///< what follows the end term
    std::uint32_t active_crc_ = 0;
    Standstill standstill_;
    store::TableCheck check_{this};
    store::Slots slots_;
};

}  // namespace nplc::gateway
