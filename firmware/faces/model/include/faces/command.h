#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "base/time.h"
#include "registers/vocabulary.h"

namespace nplc::faces {

using registers::gateway::Result;

/// What a face asks of the axis's loop. A plain value.
struct Command {
    enum class Kind : std::uint8_t {
        write_own,    ///< a register of the gateway (REGISTERS.md), by the user's port's rules
        write_motor,  ///< a register of the motor, likewise
        read_motor,
        reset_error,  ///< clears the error bits of ERR_STAT, and leaves its settings; of a MIDI drive as 01h
                      ///< does
        take_seat,
        take_over_seat,  ///< whoever has it
        leave_seat,
    };
    Kind kind = Kind::write_own;
    std::uint8_t reg = 0;
    bool longword = true;  ///< of a motor's register: 4 bytes, else 2
    std::uint32_t value = 0;
    /// When it was given, by the clock that faces read. What waited longer than kLongestWait is too_late.
    base::Instant origin{};
    std::uint8_t size = 0;  ///< of data: a piece for TABLE_DATA, 4 to 128 bytes, or a request of set-points;
                            ///< 0: `value` is written
    std::array<std::uint8_t, 128> data{};
    /// AxisImage::stops that it is given for: it is too_late if the sequence was to stand still since.
    std::optional<std::uint32_t> stops{};
    registers::gateway::Origin from = registers::gateway::Origin::user_port;  ///< for the log of set-points

    static constexpr base::Milliseconds kLongestWait{1'000};

    static Command of(registers::gateway::Command command, base::Instant origin);
    static Command own(std::uint8_t reg, std::uint32_t value, base::Instant origin);
    static Command table_piece(std::span<const std::uint8_t> piece, base::Instant origin);
    /// A request for SET_POINT_WRITE (set_points/request.h), 12 to 108 bytes. It operates.
    static Command set_points(std::span<const std::uint8_t> request, registers::gateway::Origin from,
                              base::Instant origin);
    static Command motor_write(std::uint8_t reg, bool longword, std::uint32_t value, base::Instant origin);
    static Command reset_error(base::Instant origin);
    static Command motor_read(std::uint8_t reg, bool longword, base::Instant origin);

    /// Stop, safe or hold: goes before everything and needs no seat.
    bool is_stop() const;
    /// It may start or move something, so it needs the seat: all but reads, stops, and what only prepares
    /// (UPLOAD_BYTES, TABLE_POINTER).
    bool operates() const;
};

/// How a command ended.
struct Completion {
    std::uint32_t id = 0;  ///< as submit() answered
    Result result = Result::done;
    std::uint16_t detail = 0;  ///< as in RESULT: the term of a table's fault; of seat_taken see REGISTERS.md
    std::uint32_t value = 0;   ///< of a motor's register that was read
};

}  // namespace nplc::faces
