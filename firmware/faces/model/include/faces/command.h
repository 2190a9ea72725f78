#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "base/time.h"
#include "registers/vocabulary.h"

namespace nplc::faces {

using registers::gateway::Result;

/// A face's command to the axis's loop. A plain value.
struct Command {
    enum class Kind : std::uint8_t {
        write_own,    ///< a register of the gateway (REGISTERS.md), by the user port's rules
        write_motor,  ///< a register of the motor, likewise
        read_motor,
        reset_error,  ///< clears the error bits of ERR_STAT and keeps its settings; on a MIDI drive as 01h
                      ///< does
        take_seat,
        take_over_seat,  ///< from any holder
        leave_seat,
    };
    Kind kind = Kind::write_own;
    std::uint8_t reg = 0;
    bool longword = true;  ///< for a motor register: 4 bytes, else 2
    std::uint32_t value = 0;
    /// Time of the command, by the faces' clock. If it waited longer than kLongestWait it ends as too_late.
    base::Instant origin{};
    std::uint8_t size = 0;  ///< of data: a piece for TABLE_DATA, 4 to 128 bytes, or a request of set-points;
                            ///< 0: `value` is written
    std::array<std::uint8_t, 128> data{};
    /// AxisImage::stops when it was given: too_late if the sequence was stopped since.
    std::optional<std::uint32_t> stops{};
    registers::gateway::Origin from = registers::gateway::Origin::user_port;  ///< for the log of set-points

    static constexpr base::Milliseconds kLongestWait{1'000};

    static Command of(registers::gateway::Command command, base::Instant origin);
    static Command own(std::uint8_t reg, std::uint32_t value, base::Instant origin);
    static Command table_piece(std::span<const std::uint8_t> piece, base::Instant origin);
    /// A request for SET_POINT_WRITE (set_points/request.h), 12 to 108 bytes. An operating command.
    static Command set_points(std::span<const std::uint8_t> request, registers::gateway::Origin from,
                              base::Instant origin);
    static Command motor_write(std::uint8_t reg, bool longword, std::uint32_t value, base::Instant origin);
    static Command reset_error(base::Instant origin);
    static Command motor_read(std::uint8_t reg, bool longword, base::Instant origin);

    /// Stop, safe or hold: takes precedence and needs no seat.
    bool is_stop() const;
    /// It may start or move something, so it needs the seat: everything except reads, stops, and preparations
    /// (UPLOAD_BYTES, TABLE_POINTER).
    bool operates() const;
};

/// The outcome of a command.
struct Completion {
    std::uint32_t id = 0;  ///< as returned by submit()
    Result result = Result::done;
    std::uint16_t detail = 0;  ///< as in RESULT: the term of a table's fault; of seat_taken see REGISTERS.md
    std::uint32_t value = 0;   ///< the motor register that was read
    /// Of a stop with stop_unconfirmed: the axis's loop has not reported its outcome. It is still carried
    /// out.
    bool is_axis_silent = false;
};

/// The result in words; of a stop that was not confirmed they say that the motor may be moving.
std::string describe(const Completion& completion);

}  // namespace nplc::faces
