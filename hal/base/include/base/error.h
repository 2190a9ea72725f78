#pragma once

#include <cstdint>

namespace nplc::base {

/// Errors of the firmware. A partial message is a state of its decoder, never an error. 0 means no error, so
/// a Result needs no separate flag.
enum class Error : std::uint8_t {
    no_space = 1,      ///< the caller's storage or a queue is full
    table_no_end,      ///< sequence table without a term whose STATE is 3Fh
    table_ragged,      ///< sequence table cut inside a term
    bad_next_step,     ///< NEXT_STATE 3Fh
    bad_register,      ///< FlexMAC-format term for register 0
    not_for_motor,     ///< sequence table with an order that the motor does not support
    not_stopped,       ///< only possible while the sequence is stopped
    no_table,          ///< nothing loaded
    not_enabled,       ///< the enable input is off, the board was started for service, or the start is locked
    busy,              ///< an operation is in progress; retry
    bad_geometry,      ///< sizes or addresses that do not fit the storage
    bad_offset,        ///< a piece that neither follows the last one nor repeats it
    not_begun,         ///< no write has been begun
    wrong_check,       ///< length or check sum differs from the announced one
    storage_failed,    ///< written bytes do not read back, or the storage reported an error
    damaged,           ///< stored bytes have changed
    bad_setting,       ///< no such setting, or not an allowed value
    cannot_go_on,      ///< the motor's mode before the hold is unknown
    no_proof,          ///< the table has no certificate, and one is required
    bad_set_points,    ///< the set-point record behind the table does not fit it
    stop_unconfirmed,  ///< the motor has not confirmed the last stop and may be moving
};

}  // namespace nplc::base
