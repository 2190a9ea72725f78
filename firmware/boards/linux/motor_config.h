#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "hal_linux/uart.h"
#include "placed.h"
#include "registers/midi.h"
#include "store/settings.h"

namespace nplc::boards {

/// The motor of an axis and its line: a JVL MAC motor on a serial port, or a MIDI Ingenierie drive on a
/// serial port (V24) or a CAN bus.
struct MotorConfig {
    std::optional<registers::midi::Model> midi{};  ///< nothing: a JVL motor
    Placed port;                                   ///< empty: on CAN
    std::optional<hal_linux::Rs485> rs485{};       ///< JVL
    Placed mactalk_port{};                         ///< JVL: to the motor's own MacTalk port
    std::uint32_t v24_baud = registers::midi::kFactoryBaud;
    Placed can{};                            ///< the interface
    std::optional<std::uint32_t> bitrate{};  ///< what the interface must be set to
    Placed address{};                        ///< of a MIDI drive, as a text and where it stands
    std::uint8_t midi_address = 0;

    bool is_on_can() const { return midi.has_value() && can.is_there(); }
    /// "/dev/ttyUSB0", or "address 3 on can0".
    std::string line_in_words() const;
};

/// The table `motor` of an axis; `axis_line` is to blame if there is none.
MotorConfig read_motor(Section& axis, int axis_line, Findings& findings);

/// Has a meaning with JVL motors only.
bool is_for_jvl_only(store::Setting setting);

/// Settings that here are keys of table `motor`.
inline constexpr std::array kOfTheMotor{store::Setting::motor_kind, store::Setting::midi_address};

}  // namespace nplc::boards
