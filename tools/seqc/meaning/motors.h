#pragma once

#include <optional>
#include <string_view>

#include "registers/mac.h"
#include "registers/midi.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// What MOTOR chooses. A program for a MIDI drive has the registers of MAC50-141, which the gateway
/// translates.
struct MotorChoice {
    registers::Model map = registers::Model::mac140;
    std::optional<registers::midi::Model> midi{};
};

/// MAC50 .. MAC800, MAC23, MAC34 (also MAC34_1 and MAC34_2: for a table they are the same). Case counts not.
std::optional<MotorChoice> motor_named(std::string_view name);
inline constexpr std::string_view kMotorNames =
    "the motors are MAC50, MAC95, MAC140, MAC141 and MAC800, and MIDI's MAC23 and MAC34";

/// MAC23 or MAC34.
std::string_view name_of(registers::midi::Model model);
std::string_view motor_name(const Symbols& symbols);

}  // namespace nplc::seqc
