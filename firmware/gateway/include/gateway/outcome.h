#pragma once

#include <cstdint>
#include <optional>

#include "base/error.h"
#include "protocol/mactalk.h"
#include "registers/gateway.h"

namespace nplc::gateway {

using registers::gateway::Result;

/// Of a deed that may take several polls: nothing while it is under way.
struct Outcome {
    Result result = Result::done;
    std::uint16_t detail = 0;  ///< of a table's fault: the term
};
using Progress = std::optional<Outcome>;

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
        case base::Error::bad_setting:
            return Result::bad_value;
    }
    return Result::bad_value;
}

}  // namespace nplc::gateway
