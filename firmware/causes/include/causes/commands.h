#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "registers/mac.h"

/// Commands of macreg that remedies name, and the bits that they do not change.
namespace nplc::causes {

/// The bits of it that are settings; all ones for most.
std::uint32_t setting_bits(registers::Model model, const registers::Register& reg);

/// The command that clears the errors and leaves ERR_STAT's settings (RELPOSPFNC, DIS_P_LIM ...) as they are.
std::string clear_errors_command(registers::Model model, std::int64_t err_stat);
/// The command that sets (`set`) and clears (`clear`) these settings of CNTRL_BITS and keeps the others.
std::string control_command(registers::Model model, std::int64_t now, std::int64_t set, std::int64_t clear);
/// The commands that give P_SOLL, P_IST and P_FNC one value (001 §3.2.163); the motor does not move.
std::string resynchronise_command(registers::Model model, std::int64_t control_bits, std::int64_t p_ist);

/// ERR_STAT's bits that keep the motor in INIT_MODE (001 §3.2.35, §4.4.1; R: 004's by their kind).
std::uint32_t error_bits(registers::Model model);
/// The mask of a register's bit by its name; 0: there is none.
std::int64_t mask(registers::Model model, std::uint8_t number, std::string_view bit);

}  // namespace nplc::causes
