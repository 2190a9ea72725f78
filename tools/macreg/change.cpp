#include "macreg/change.h"

#include <fmt/format.h>

#include "macreg/values.h"
#include "registers/gateway.h"

namespace nplc::macreg {

using mactalk_client::LineError;
using registers::Access;
using registers::Model;
using registers::Register;

namespace {

constexpr std::int64_t kStopMode = 11;
constexpr std::int64_t kSafeMode = 15;
constexpr std::int64_t kLastMode = 24;
constexpr std::int64_t kDefaults = 256;

/// Bits that the motor clears when it has done what they ask for, or sets by itself (001 §3.2.36, 004).
std::int64_t passing_bits(Model model, const Register& reg) {
    if (reg.number == registers::ERR_STAT) return 1 << 4 | 1 << 5 | 1 << 6;
    if (reg.number != registers::CNTRL_BITS) return 0;
    return model == Model::mac800 ? 0b100'0011 : 0b1110'0100'1100'0000;
}

/// 001 §3.2.36: looked at after a reset only.
constexpr std::int64_t kAtResetOnly = 0b1'1111;

bool is_pointer(const Register& reg) {
    return reg.number >= registers::P_REG_P && reg.number <= registers::Z_REG_P;
}

/// What moves by itself may be another value a moment later.
bool runs_on(const Register& reg) {
    return reg.number == registers::P_IST || reg.number == registers::P_FNC ||
           reg.number == registers::FLWERR || reg.name == "REC_CNT";
}

std::string why_mode(Motor& motor, std::int64_t wanted, std::int64_t now) {
    if (now == kSafeMode && wanted != kSafeMode)
        return "the motor is in SAFE_MODE and leaves it by `macreg safe exit` only (001 §4.4.16)";
    if (wanted == kSafeMode) return "SAFE_MODE is entered by `macreg safe enter` only (001 §4.4.16)";
    const std::string errors = errors_text(motor.model(), motor.read(registers::ERR_STAT));
    if (!errors.empty())
        return fmt::format(
            "{}: the motor stays passive until the error is cleared; mend its cause (`macreg why`), then "
            "`macreg set ERR_STAT none`",
            errors);
    if (now == kStopMode)
        return "the motor brakes in STOP_MODE first; the new mode follows when it is slower than 300 rpm";
    return "the motor has no such mode, or left it again by itself; `macreg why` tells more";
}

std::string why_not(Motor& motor, const Register& reg, std::int64_t wanted, std::int64_t now) {
    if (reg.number == registers::MODE_REG) return why_mode(motor, wanted, now);
    if (reg.access == Access::read_only) return "it is read only: the motor overwrites it all the time";
    if (reg.number == registers::V_SOLL && now == 0 &&
        motor.read(registers::ERR_STAT) >> (motor.model() == Model::mac800 ? 10 : 13) & 1)
        return "the supply is too low and UV_HANDLE lets undervoltage set V_SOLL to 0; mend the supply";
    if (is_pointer(reg)) return "there is no register of that number to select";
    if (reg.number == registers::ERR_STAT)
        return "what causes the error is still there, so the motor sets it again; `macreg why` tells more";
    if (reg.access == Access::motor_writes)
        return "the motor writes it too; whoever speaks FastMAC to it (a gateway's sequence, a PLC) may have "
               "set it";
    return "somebody else may have written it, or the motor has no such register";
}

Outcome refused_or_lost(Motor& motor, std::int64_t before, const LineError& error) {
    Outcome outcome{.before = before, .after = before, .taken = false};
    outcome.why = error.kind() == LineError::Kind::no_answer ? gateway_refusal(motor) : "";
    if (outcome.why.empty()) throw LineError(error.kind(), error.what());
    return outcome;
}

void add_remark(Outcome& outcome, const Motor& motor, const Register& reg, std::int64_t raw) {
    if (reg.number == registers::CNTRL_BITS && motor.model() != Model::mac800 &&
        ((outcome.before ^ raw) & kAtResetOnly) != 0)
        outcome.remark =
            "the inputs' bits act after the next reset only, and are lost by it unless kept: `macreg flash "
            "save`";
}

}  // namespace

std::string no_mode(Model model, const Register& reg, std::int64_t raw) {
    const bool is_mode =
        reg.number == registers::MODE_REG || (reg.name == "STARTMODE" && model != Model::mac800);
    if (!is_mode || (raw >= 0 && raw <= kLastMode)) return {};
    if (reg.number == registers::MODE_REG && raw >= kDefaults)
        return "MODE_REG: 256 to 258 rewrite flash and registers; `macreg flash save`, `macreg flash "
               "defaults` and "
               "`macreg flash reload` do that, and ask first";
    return fmt::format("{}: {} is no mode; modes are 0 to {} (`macreg list {}`)", reg.name, raw, kLastMode,
                       reg.name);
}

std::uint32_t error_bits(Model model) {
    return model == Model::mac800 ? 0x2BB8F : 0x108F;
}

std::string errors_text(Model model, std::int64_t err_stat) {
    const std::uint32_t errors = static_cast<std::uint32_t>(err_stat) & error_bits(model);
    if (errors == 0) return {};
    const Register& reg = *registers::find(model, registers::ERR_STAT);
    return "ERR_STAT has " + names_text(reg, model, errors);
}

std::string gateway_refusal(Motor& motor) {
    namespace gw = registers::gateway;
    if (!motor.is_behind_gateway()) return {};
    const std::uint32_t status = motor.master().read(gw::kDefaultAddress, gw::STATUS);
    if ((status & gw::kLinkDelivers) == 0)
        return "the gateway's link to the motor does not work; `nanoctl status` tells more";
    if (static_cast<gw::RunState>(status & gw::kRunState) != gw::RunState::stopped)
        return "the gateway refuses it while its sequence runs; `nanoctl stop`, or allow it with `nanoctl "
               "settings set "
               "motor_writes=1` (writes) or 2 (safe mode, flash, reset too)";
    return "the gateway does not let it through: safe mode, flash, reset and recording need the motor's own "
           "MacTalk "
           "line, wired to the board's second serial port or to this computer";
}

Outcome change(Motor& motor, const Register& reg, std::int64_t raw) {
    Outcome outcome{.before = motor.read(reg)};
    if (std::string none = no_mode(motor.model(), reg, raw); !none.empty())
        return {.before = outcome.before, .after = outcome.before, .taken = false, .why = std::move(none)};
    try {
        motor.write(reg, raw);
    } catch (const LineError& error) {
        if (reg.name != "MYADDR" && reg.name != "MY_ADDR")
            return refused_or_lost(motor, outcome.before, error);
    } catch (const Doubtful&) {
        outcome.why = gateway_refusal(motor);
        if (outcome.why.empty()) throw;
        return {.before = outcome.before, .after = outcome.before, .taken = false, .why = outcome.why};
    }
    if (reg.name == "MYADDR" || reg.name == "MY_ADDR") {
        Motor moved(motor.master(), static_cast<std::uint8_t>(raw), motor.model());
        outcome.after = moved.read(reg);
        outcome.remark =
            fmt::format("the motor answers to --address {} from now on; `macreg flash save` keeps it", raw);
        return outcome;
    }
    outcome.after = motor.read(reg);
    const std::int64_t passing = passing_bits(motor.model(), reg);
    outcome.taken = is_pointer(reg) ? outcome.after == 0 : (outcome.after & ~passing) == (raw & ~passing);
    if (!outcome.taken && runs_on(reg) && outcome.after != outcome.before) {
        outcome.taken = true;
        outcome.remark = "the motor goes on changing it";
    }
    if (!outcome.taken) outcome.why = why_not(motor, reg, raw, outcome.after);
    add_remark(outcome, motor, reg, raw);
    return outcome;
}

}  // namespace nplc::macreg
