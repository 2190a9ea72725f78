#pragma once

#include <cstdint>
#include <span>

#include "sequencer/state.h"

/// What an order of a table means to a motor (001 §5.2.1.4).
namespace nplc::verify {

enum class OrderKind : std::uint8_t {
    nothing,      ///< neither mode nor motion
    init,         ///< INIT mode, whatever it selects
    velocity,     ///< runs from now on
    place,        ///< moves to a place
    holds_place,  ///< position mode, the target stays
    home,
    stop,    ///< V_SOLL = 0
    speed,   ///< V_SOLL is something again, the mode stays
    set,     ///< USE_SET
    silent,  ///< a mode that never sets IN_POS
    reset_error,
};

OrderKind kind_of(const sequencer::MotorOrder& order);
/// Selects a velocity, so V_SOLL is no longer 0 from a STOP.
bool selects_velocity(const sequencer::MotorOrder& order);
/// The register that a command selects, 1..127; 0 for others.
std::uint8_t selected_register(const sequencer::MotorOrder& order);
bool begins_motion(OrderKind kind);
bool ends_motion(OrderKind kind);

/// Whether the motor was ordered to move and is not known to have ended: `moving` in properties.
enum class Motion : std::uint8_t { none, to_place, endless };
/// After a scan that saw `in_pos` and gave these orders.
Motion motion_after(Motion before, bool in_pos, std::span<const sequencer::MotorOrder> orders);

/// As far as it decides whether INPOS can come.
struct MotorState {
    enum class Mode : std::uint8_t { unknown, init, velocity, position, silent };
    Mode mode = Mode::unknown;
    bool stopped = false;  ///< V_SOLL is 0 from a STOP
    bool error = false;

    void apply(const sequencer::MotorOrder& order);
    bool in_pos_never_comes() const {
        return mode == Mode::init || mode == Mode::silent || (mode == Mode::position && stopped);
    }
    std::uint16_t packed() const {
        return static_cast<std::uint16_t>(static_cast<unsigned>(mode) | (stopped ? 8U : 0U));
    }
    static MotorState unpacked(std::uint16_t bits) {
        return {static_cast<Mode>(bits & 7U), (bits & 8U) != 0, false};
    }
};

}  // namespace nplc::verify
