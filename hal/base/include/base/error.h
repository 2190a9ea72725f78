#pragma once

#include <cstdint>

namespace nplc::base {

/// What can go wrong in the firmware. A partial message is a state of its decoder, never an error. 0 is none:
/// a Result needs no other mark.
enum class Error : std::uint8_t {
    no_space = 1,      ///< the caller's storage or a queue is full
    table_no_end,      ///< sequence table without a term whose STATE is 3Fh
    table_ragged,      ///< sequence table cut inside a term
    bad_next_step,     ///< NEXT_STATE 3Fh
    bad_register,      ///< FlexMAC-format term for register 0
    not_for_motor,     ///< sequence table with an order that the motor does not have
    not_stopped,       ///< only possible while the sequence is stopped
    no_table,          ///< nothing loaded
    not_enabled,       ///< the enable input is off, it is started for service, or locked
    busy,              ///< not now: an operation is under way; ask again
    bad_geometry,      ///< sizes or addresses that do not fit the storage
    bad_offset,        ///< a piece that neither follows what came nor repeats it
    not_begun,         ///< needs a writing that was begun
    wrong_check,       ///< length or check sum is not what was announced
    storage_failed,    ///< what was written does not read back, or the storage said no
    damaged,           ///< stored bytes have changed
    bad_setting,       ///< no such setting, or not one of its values
    cannot_go_on,      ///< nobody knows what the motor did before it was held
    no_proof,          ///< the table has no certificate, and one is required
    bad_set_points,    ///< what follows the table as its set-points does not fit it
    stop_unconfirmed,  ///< the motor has not confirmed the last stop and may be moving
};

}  // namespace nplc::base
