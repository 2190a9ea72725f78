#pragma once

#include <cstdint>

#include "meaning/model.h"

namespace nplc::seqc {

/// The modes that selecting commands reach, and all others as one.
enum ModeBit : std::uint8_t { kInit = 1, kVelocity = 2, kPosition = 4, kOther = 8, kAnyMode = 15 };

/// What may be true of the motor, with the places that made it so (length 0 where there is none).
struct MotorState {
    std::uint8_t modes = 0;  ///< in which modes it may be; 0: nothing is known to lead here
    Span init;               ///< what took it to INIT
    bool stopped = false;    ///< V_SOLL may be 0 from a STOP
    Span stop;
    bool homing = false;  ///< it may be homing, or in STARTMODE after it (001 §4.4.13 - §4.4.15)
    Span home;
    bool ends_in_position = false;  ///< STARTMODE is surely one in which IN_POS is set
    Span start_mode;                ///< what set STARTMODE to another one

    /// Takes in what may hold on another way to the same place; true if that was news.
    bool join(const MotorState& other);
    /// What holds once this was sent.
    void apply(const Send& send);
};

/// Whether a mode sets IN_POS at all: velocity, position and gear modes (001 §4.4).
bool sets_in_position(std::uint32_t mode);

bool is_home_mode(std::uint32_t mode);

}  // namespace nplc::seqc
