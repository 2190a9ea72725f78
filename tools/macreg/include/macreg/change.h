#pragma once

#include <cstdint>
#include <string>

#include "macreg/motor.h"

/// One register's change, read back, and why it was not taken if it was not.
namespace nplc::macreg {

struct Outcome {
    std::int64_t before = 0;
    std::int64_t after = 0;
    bool taken = true;
    std::string why{};     ///< a sentence with the remedy, if it was not taken
    std::string remark{};  ///< what the owner should know all the same
};

/// Writes `raw` with the register's exact width and reads it back. A new address (MYADDR) is read back under
/// itself. A write that a gateway does not let through is an outcome too; a motor that does not answer is a
/// LineError.
Outcome change(Motor& motor, const registers::Register& reg, std::int64_t raw);

/// Why this value is no mode that `change` may give MODE_REG or STARTMODE, with what to do instead; empty: it
/// is one. 256 to 258 would act on a motor in SAFE_MODE, on its flash (001 §4.4.16).
std::string no_mode(registers::Model model, const registers::Register& reg, std::int64_t raw);

/// "ERR_STAT has FLW_ERR"; empty if none of the errors that keep the motor in INIT_MODE is set.
std::string errors_text(registers::Model model, std::int64_t err_stat);

/// ERR_STAT's bits that keep the motor in INIT_MODE (001 §3.2.35, §4.4.1; R: 004's by their kind).
std::uint32_t error_bits(registers::Model model);

/// What a gateway between us and the motor says of a message that it did not let through; empty if there is
/// none.
std::string gateway_refusal(Motor& motor);

}  // namespace nplc::macreg
