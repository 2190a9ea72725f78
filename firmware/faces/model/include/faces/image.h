#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "base/time.h"
#include "causes/midi_why.h"
#include "faces/tally.h"
#include "registers/gateway.h"
#include "registers/mac.h"
#include "seat/seat.h"

namespace nplc::faces {

enum class Quality : std::uint8_t {
    good,
    old,      ///< stale: no newer value within its time
    unknown,  ///< not read since the start or the last reset
};

/// Values read from every motor. The register depends on the motor: register_of().
enum class MotorItem : std::uint8_t {
    position,      ///< P_IST
    velocity,      ///< V_IST
    error_word,    ///< ERR_STAT
    mode,          ///< MODE_REG
    torque,        ///< VF_OUT: output of the regulator
    load,          ///< I2T
    load_limit,    ///< I2TLIM
    follow_error,  ///< FLWERR
    target,        ///< P_SOLL
    speed_limit,   ///< V_SOLL
    torque_limit,  ///< T_SOLL
    temperature,   ///< DEGC, MAC800 only
};
inline constexpr std::size_t kMotorItems = 12;
/// These two are read often, the others in turns.
constexpr bool is_frequent(MotorItem item) {
    return item == MotorItem::position || item == MotorItem::velocity;
}

/// A motor register as last read; raw value with the register's sign.
struct MotorValue {
    bool is_known = false;
    std::int32_t value = 0;
    base::Instant taken{};
    bool is_old = false;  ///< the link to the motor was lost since

    Quality quality(base::Instant now, base::Microseconds limit) const {
        if (!is_known) return Quality::unknown;
        return is_old || now - taken > limit ? Quality::old : Quality::good;
    }
};

/// The axis between two scans: the gateway's registers (firmware/gateway/REGISTERS.md), all of the same
/// instant, and the last values read from the motor. A plain value.
///
/// Contains registers 1..9, 16..42, 48..60, 62..70, 80..88, 128..191 and 200..231. Not FIRED (96..127):
/// FIRED_STEP and FIRED_KEY with the table's bytes (AxisTable) tell which terms were true. FIRED_* are those
/// of the image's own scan. RESULT is that of the user port.
struct AxisImage {
    std::uint64_t number = 0;    ///< increases with every image; 0: none yet
    base::Instant taken{};       ///< by the faces' clock
    std::uint64_t restarts = 0;  ///< of the gateway, since the process began; the registers are reset then
    std::array<std::uint32_t, 256> own{};
    std::array<MotorValue, kMotorItems> motor{};
    bool moves = false;                       ///< its position changed between the last two reads
    base::Instant moving_since{};             ///< the read of the position that showed it first
    std::optional<causes::MidiState> midi{};  ///< for a MIDI drive
    std::uint16_t why =
        0;  ///< AxisModel::image_with_why(): the cause's number (causes/codes.h); 0: not known
    base::Instant motor_contact{};       ///< last time when the link delivered
    bool had_contact = false;            ///< the link has delivered since the process began
    std::uint64_t holder = 0;            ///< Sitter::number of the seat's holder; 0: free
    Side holder_side = Side::person;     ///< the holder's side
    std::array<char, 40> holder_name{};  ///< ended by 0
    Control control = Control::any;      ///< side from which the axis may be operated
    /// Number of stops of the sequence since the process began: stop, safe or hold by anyone, loss of enable,
    /// restart of the gateway.
    std::uint32_t stops = 0;
    std::uint32_t commands_done = 0;     ///< from faces, since the process began
    std::uint32_t commands_refused = 0;  ///< the same
    Tally tally{};

    std::uint32_t operator[](registers::gateway::Number reg) const { return own[reg]; }
    std::uint32_t setting(registers::gateway::Setting setting) const {
        return own[registers::gateway::register_of(setting)];
    }
    const MotorValue& of_motor(MotorItem item) const { return motor[static_cast<std::size_t>(item)]; }
    bool is_set(registers::gateway::StatusBit bit) const {
        return (own[registers::gateway::STATUS] & bit) != 0;
    }
    registers::gateway::RunState run_state() const {
        return registers::gateway::run_state_of(own[registers::gateway::STATUS]);
    }
};

/// The register model of the axis's motor; for a drive of another family that of the registers kept by its
/// driver.
registers::Model model_of(const AxisImage& image);
/// Null: the motor does not have it.
const registers::Register* register_of(MotorItem item, registers::Model model);

}  // namespace nplc::faces
