#pragma once

#include <cstdint>
#include <optional>

#include "base/error.h"
#include "gateway/vocabulary.h"
#include "protocol/mactalk.h"

namespace nplc::gateway {

/// Outcome of a command or a write, one word as in register RESULT.
class CommandResult {
  public:
    /// `detail`: for a table fault, the number of the term.
    constexpr CommandResult(Result result = Result::done,
                            std::uint16_t detail = 0)  // NOLINT: implicit by purpose
        : word_(static_cast<std::uint32_t>(result) | (std::uint32_t{detail} << 16)) {}
    /// Bits 15..8 are 0.
    constexpr std::uint32_t word() const { return word_; }

  private:
    std::uint32_t word_;
};

/// Outcome of a command that may take several polls; empty while it is in progress.
class PendingResult {
  public:
    constexpr PendingResult() = default;
    constexpr PendingResult(std::nullopt_t) {}                               // NOLINT: implicit by purpose
    constexpr PendingResult(CommandResult result) : word_(result.word()) {}  // NOLINT: implicit by purpose
    constexpr explicit operator bool() const { return word_ != kUnderWay; }
    constexpr std::uint32_t word() const { return word_; }
    constexpr bool is_done() const { return word_ == CommandResult(Result::done).word(); }

  private:
    static constexpr std::uint32_t kUnderWay = 0xFFFF'FFFF;
    std::uint32_t word_ = kUnderWay;
};

constexpr Result result_of(base::Error error) {
    switch (error) {
        case base::Error::no_space:
            return Result::no_space;
        case base::Error::table_no_end:
            return Result::table_no_end;
        case base::Error::table_ragged:
            return Result::table_ragged;
        case base::Error::bad_next_step:
            return Result::bad_next_step;
        case base::Error::bad_register:
            return Result::bad_register;
        case base::Error::not_for_motor:
            return Result::not_for_motor;
        case base::Error::not_stopped:
            return Result::not_stopped;
        case base::Error::no_table:
            return Result::no_table;
        case base::Error::not_enabled:
            return Result::not_enabled;
        case base::Error::busy:
            return Result::busy;
        case base::Error::bad_offset:
            return Result::bad_offset;
        case base::Error::not_begun:
            return Result::no_upload;
        case base::Error::wrong_check:
            return Result::wrong_check;
        case base::Error::bad_geometry:
        case base::Error::storage_failed:
            return Result::storage_failed;
        case base::Error::damaged:
            return Result::nothing_stored;
        case base::Error::cannot_go_on:
            return Result::cannot_go_on;
        case base::Error::no_proof:
            return Result::no_proof;
        case base::Error::bad_set_points:
            return Result::bad_set_points;
        case base::Error::stop_unconfirmed:
            return Result::stop_unconfirmed;
        case base::Error::bad_setting:
            return Result::bad_value;
    }
    return Result::bad_value;
}

}  // namespace nplc::gateway
