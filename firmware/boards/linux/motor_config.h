#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "hal_linux/uart.h"
#include "registers/family.h"
#include "section.h"
#include "store/settings.h"

namespace nplc::boards {

/// The motor of an axis and its line: a serial port or a CAN bus.
struct MotorConfig {
    /// The first model for a family that setting motor_kind does not divide further.
    const registers::DriveModel* model = &registers::families().front()->models().front();
    LocatedText port;                         ///< empty: on CAN
    std::optional<hal_linux::Rs485> rs485{};  ///< of the serial port
    LocatedText mactalk_port{};               ///< to the motor's own MacTalk port
    std::optional<std::uint32_t> baud{};      ///< of the serial port; unset: setting motor_baud
    LocatedText can{};                        ///< the interface
    std::optional<std::uint32_t> bitrate{};   ///< what the interface must be set to
    LocatedText address{};  ///< of the drive, as written; empty: the line has no other drive
    std::uint8_t drive_address = 0;

    bool is_on_can() const { return can.is_there(); }
    /// "/dev/ttyUSB0", or "address 3 on can0".
    std::string line_in_words() const;
};

/// Table `motor` of an axis; `axis_line` is the line to report if there is none.
MotorConfig read_motor(Section& axis, int axis_line, Findings& findings);

/// Settings that are keys of the table `motor` on this board.
inline constexpr std::array kOfTheMotor{store::Setting::motor_kind, store::Setting::midi_address};

/// Keys rs485, rs485_before_ms and rs485_after_ms of a port's table.
std::optional<hal_linux::Rs485> read_rs485(Section& section);

}  // namespace nplc::boards
