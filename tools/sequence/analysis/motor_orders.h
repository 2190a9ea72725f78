#pragma once

#include <bitset>
#include <cstdint>
#include <span>

#include "table/orders.h"

/// What a motor is doing by what it was ordered.
namespace nplc::verify {

/// The state of the motor by its orders, as far as it decides whether the motor may move: `moving` in
/// properties. In velocity, gear and position modes V_SOLL = 0 ends a motion, which continues when V_SOLL is
/// not 0 any more; homing and the torque modes are independent of V_SOLL (001 §4.4). In position mode a new
/// target is a move.
enum class Motion : std::uint8_t {
    none,  ///< INIT
    to_place,
    endless,
    disturbed,  ///< to a place, and for how long is not known: an ERROR was seen, or V_SOLL or the target
                ///< changed
    in_place,   ///< in position mode, arrived
    stopped_in_place,  ///< and V_SOLL is 0
    halted,            ///< on its way to a place, V_SOLL is 0
    halted_run,        ///< in velocity mode, V_SOLL is 0
    homing,
    homing_disturbed,
    driven,  ///< in a torque or test mode
};
inline constexpr std::size_t kMotions = 11;
constexpr bool is_moving(Motion motion) {
    return motion == Motion::to_place || motion == Motion::endless || motion == Motion::disturbed ||
           motion == Motion::homing || motion == Motion::homing_disturbed || motion == Motion::driven;
}
/// `ASSUME moving ENDS WITHIN` speaks of it.
constexpr bool is_timed(Motion motion) {
    return motion == Motion::to_place || motion == Motion::homing;
}
/// What a scan saw of the motor.
struct Seen {
    bool in_pos = false;
    bool disturbs = false;  ///< ERROR, where it counts how long moves last
};
/// P_SOLL, P_IST and P_FNC as bits, where a command clears them: all three in one scan, with no other order
/// to the motion between, move nothing.
inline constexpr unsigned kAllCleared = 7;
unsigned cleared_by(table::OrderKind kind);

/// After one order, what clears all three left out.
Motion motion_after(Motion before, const sequencer::MotorOrder& order);
/// After a scan that saw this and gave these orders.
Motion motion_after(Motion before, const Seen& seen, std::span<const sequencer::MotorOrder> orders);

/// An order begins a motion, or ends one.
bool begins_motion(const sequencer::MotorOrder& order);
bool ends_motion(const sequencer::MotorOrder& order);

/// They begin a move to a position or a homing that no later order among them ends.
bool begins_move(std::span<const sequencer::MotorOrder> orders);

/// Registers that are 0 whenever they are used, or may be: V1..V8 and V_SOLL count.
using ZeroRegisters = std::bitset<128>;

/// The motor's state, as far as it decides whether INPOS can come.
struct MotorState {
    enum class Mode : std::uint8_t { unknown, init, velocity, position, silent };
    enum class Speed : std::uint8_t {
        some,
        stopped,  ///< V_SOLL is 0 from a STOP
        zero,     ///< V_SOLL was set to a value that is 0
    };
    Mode mode = Mode::unknown;
    Speed speed = Speed::some;
    bool error = false;

    void apply(const sequencer::MotorOrder& order, const ZeroRegisters& zeros);
    bool stands() const { return mode == Mode::position && speed != Speed::some; }
    bool in_pos_never_comes() const { return mode == Mode::init || mode == Mode::silent || stands(); }
    static constexpr std::size_t kPacked = 32;
    std::uint16_t packed() const {
        return static_cast<std::uint16_t>(static_cast<unsigned>(mode) | static_cast<unsigned>(speed) << 3U);
    }
    static MotorState unpacked(std::uint16_t bits) {
        return {static_cast<Mode>(bits & 7U), static_cast<Speed>(bits >> 3U & 3U), false};
    }
};

}  // namespace nplc::verify
