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
    old,      ///< was good; nothing newer has come within its time
    unknown,  ///< was never read since the start or the last reset
};

/// What is read of every motor. Which register that is depends on the motor: register_of().
enum class MotorItem : std::uint8_t {
    position,      ///< P_IST
    velocity,      ///< V_IST
    error_word,    ///< ERR_STAT
    mode,          ///< MODE_REG
    torque,        ///< VF_OUT: what the regulator asks for
    load,          ///< I2T
    load_limit,    ///< I2TLIM
    follow_error,  ///< FLWERR
    target,        ///< P_SOLL
    speed_limit,   ///< V_SOLL
    torque_limit,  ///< T_SOLL
    temperature,   ///< DEGC, of a MAC800 only
};
inline constexpr std::size_t kMotorItems = 12;
/// These two come often, the others by turns.
constexpr bool is_frequent(MotorItem item) {
    return item == MotorItem::position || item == MotorItem::velocity;
}

/// A register of the motor as it was last read; its raw value, signed as the register is.
struct MotorValue {
    bool is_known = false;
    std::int32_t value = 0;
    base::Instant taken{};

    Quality quality(base::Instant now, base::Microseconds limit) const {
        if (!is_known) return Quality::unknown;
        return now - taken > limit ? Quality::old : Quality::good;
    }
};

/// The axis between two scans: the gateway's registers (firmware/gateway/REGISTERS.md), all of the same
/// instant, and what was last read of the motor. A plain value.
///
/// Registers 1..9, 16..42, 48..60, 62..70, 80..88, 128..191 and 200..231 are in it. FIRED (96..127) is not:
/// with the table's bytes (AxisTable) FIRED_STEP and FIRED_KEY tell which terms were true. FIRED_* are those
/// of the image's own scan. RESULT is the user's port's.
struct AxisImage {
    std::uint64_t number = 0;    ///< rises with every image; 0: none has been taken
    base::Instant taken{};       ///< by the clock that faces read
    std::uint64_t restarts = 0;  ///< of the gateway, since the process began; registers start anew then
    std::array<std::uint32_t, 256> own{};
    std::array<MotorValue, kMotorItems> motor{};
    bool moves = false;                       ///< its position changed between the last two reads
    std::optional<causes::MidiState> midi{};  ///< of a MIDI drive
    std::uint16_t why =
        0;  ///< AxisModel::image_with_why(): the cause's number (causes/codes.h); 0: not known
    base::Instant motor_contact{};       ///< when the link was last seen to deliver
    bool had_contact = false;            ///< it has delivered since the process began
    std::uint64_t holder = 0;            ///< Sitter::number of who has the seat; 0: it is free
    Side holder_side = Side::person;     ///< where that one stands
    std::array<char, 40> holder_name{};  ///< ended by 0
    Control control = Control::any;      ///< from where the axis may be operated
    /// How often the sequence was to stand still since the process began: stop, safe or hold of whomever, no
    /// longer enabled, the gateway started anew.
    std::uint32_t stops = 0;
    std::uint32_t commands_done = 0;     ///< of faces, since the process began
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

/// Whose registers the axis's motor has; of a drive of another family those that its driver keeps for it.
registers::Model model_of(const AxisImage& image);
/// Null: this motor has none.
const registers::Register* register_of(MotorItem item, registers::Model model);

}  // namespace nplc::faces
