#include "macreg/change.h"

#include <fmt/format.h>

#include <cstdlib>

#include "macreg/parameters.h"
#include "macreg/values.h"
#include "registers/details.h"
#include "registers/gateway.h"

namespace nplc::macreg {

namespace gw = registers::gateway;

using mactalk_client::LineError;
using registers::Access;
using registers::Model;
using registers::Register;
using enum registers::Number;

namespace {

/// Bits that the motor clears when it has done what they request, or sets by itself (001 §3.2.36, 004).
std::int64_t passing_bits(Model model, const Register& reg) {
    if (reg.number == registers::ERR_STAT) return 1 << 4 | 1 << 5 | 1 << 6;
    if (reg.number != registers::CNTRL_BITS) return 0;
    return model == Model::mac800 ? 0b100'0011 : 0b1110'0100'1100'0000;
}

/// Counts between two reads of a position that are not a change.
constexpr std::int64_t kNoise = 8;

/// 001 §3.2.36: read by the motor after a reset only.
constexpr std::int64_t kAtResetOnly = 0b1'1111;

constexpr const char* kUpset = "a wrong value may damage the motor or upset its control";

std::int64_t last_mode(Model model) {
    return model == Model::mac800 ? kAnaloguePosition : kGearFollow;
}

bool is_mode(Model model, const Register& reg) {
    // R: a MAC800's START_MODE may carry more than the mode.
    return reg.number == registers::MODE_REG || (reg.name == "STARTMODE" && model != Model::mac800);
}

bool is_pointer(const Register& reg) {
    return reg.number >= registers::P_REG_P && reg.number <= registers::Z_REG_P;
}

/// Registers that the motor updates itself: a moment later they may differ from what was written.
bool runs_on(const Register& reg) {
    return reg.number == registers::P_IST || reg.number == registers::P_FNC ||
           reg.number == registers::FLWERR || reg.name == "REC_CNT";
}

bool holds_by_supply(Motor& motor) {
    const Model model = motor.model();
    const std::int64_t handle = motor.read("UV_HANDLE");
    const std::uint8_t number = motor.find("UV_HANDLE")->number;
    return (motor.read(registers::ERR_STAT) & mask(model, registers::ERR_STAT, "UV_DETECT")) != 0 &&
           (handle & mask(model, number, "UV_GO_PASSIVE")) != 0;
}

/// What prevents the requested mode; empty: no known cause.
std::string hindrance(Motor& motor, std::int64_t wanted, std::int64_t now) {
    if (now == kSafe && wanted != kSafe)
        return "the motor is in SAFE_MODE and leaves it by `macreg safe exit` only (001 §4.4.16)";
    if (wanted == kSafe) return "SAFE_MODE is entered by `macreg safe enter` only (001 §4.4.16)";
    const std::int64_t status = motor.read(registers::ERR_STAT);
    const std::string errors = errors_text(motor.model(), status);
    if (!errors.empty())
        return fmt::format(
            "{}: the motor stays passive until the error is cleared; mend its cause (`macreg why`), then "
            "`{}`",
            errors, clear_errors_command(motor.model(), status));
    if (now == kInit && holds_by_supply(motor)) {
        const Register& supply = *motor.find(motor.model() == Model::mac800 ? "U_BUS" : "U_SUPPLY");
        return fmt::format(
            "the motor stays passive while its supply is too low (it is {}), since UV_GO_PASSIVE is set in "
            "UV_HANDLE; mend the supply (`macreg why`)",
            value_text(supply, motor.model(), motor.read(supply)));
    }
    return {};
}

/// Modes that the motor leaves by itself, perhaps before they could be read back (001 §4.4.9, §4.4.10,
/// §4.4.11, §4.4.12, §4.4.23). Empty: it was not one of them.
std::string ended_by_itself(std::int64_t wanted, std::int64_t now) {
    if (wanted == kStop && now == kInit)
        return "the motor stands: it is in INIT_MODE, which follows STOP_MODE";
    const bool test = wanted == kTestU || wanted == kTestA || wanted == kBreak || wanted == kTestKi;
    const bool braking = wanted == kTestA && now == kBreak;
    if (!test || !(now == kInit || braking)) return {};
    return braking ? "the test has run, the motor brakes (BREAK_MODE) and ends in INIT_MODE"
                   : "the test has run and ended, the motor is in INIT_MODE again";
}

std::string why_mode(Motor& motor, std::int64_t wanted, std::int64_t now) {
    if (std::string known = hindrance(motor, wanted, now); !known.empty()) return known;
    if (now == kStop)
        return "the motor brakes in STOP_MODE first; the new mode follows when it is slower than 300 rpm";
    return "the motor left it again by itself, or does not take it now; `macreg why` tells more";
}

std::string why_not(Motor& motor, const Register& reg, std::int64_t wanted, std::int64_t now) {
    if (reg.number == registers::MODE_REG) return why_mode(motor, wanted, now);
    if (reg.access == Access::read_only) return "it is read only: the motor overwrites it all the time";
    if (reg.number == registers::V_SOLL && now == 0 &&
        motor.read(registers::ERR_STAT) >> (motor.model() == Model::mac800 ? 10 : 13) & 1)
        return "the supply is too low and UV_HANDLE lets undervoltage set V_SOLL to 0; mend the supply";
    if (is_pointer(reg)) return "there is no register of that number to select";
    if (reg.number == registers::ERR_STAT) {
        const std::int64_t stays = now & ~wanted & ~passing_bits(motor.model(), reg);
        return stays != 0
                   ? "what causes the error is still there, so the motor sets it again; `macreg why` tells "
                     "more"
                   : "the motor keeps these bits by its own state: what it does not find is cleared at once";
    }
    if (reg.access == Access::motor_writes)
        return "the motor writes it too; whoever speaks FastMAC to it (a gateway's sequence, a PLC) may have "
               "set it";
    return "somebody else may have written it, or the motor has no such register";
}

ChangeResult refused_or_lost(Motor& motor, std::optional<std::int64_t> before, const LineError& error) {
    ChangeResult outcome{.before = before, .after = before.value_or(0), .taken = false};
    outcome.why = error.kind() == LineError::Kind::no_answer ? gateway_refusal(motor, Asked::write) : "";
    if (outcome.why.empty()) throw LineError(error.kind(), error.what());
    return outcome;
}

/// Results that only the gateway's port gives, and of this client's own messages.
std::string port_refusal(Motor& motor) {
    using enum gw::Result;
    const auto result = static_cast<gw::Result>(motor.master().read(gw::kDefaultAddress, gw::RESULT) & 0xFF);
    const bool is_ports = result == no_password || result == seat_taken;
    return is_ports ? std::string(gw::describe(result)) : std::string();
}

/// 001 §3.2.163: P_IST alone is the shaft's place under another name; where P_MODE goes is P_SOLL - P_FNC.
std::string apart_remark(Motor& motor) {
    const Model model = motor.model();
    const std::int64_t place = motor.read(registers::P_IST);
    const std::int64_t profile = motor.read(registers::P_FNC);
    const std::int64_t apart =
        static_cast<std::int32_t>(profile - 16 * (place + motor.read(registers::FLWERR)));
    const std::int64_t way = static_cast<std::int32_t>(16 * motor.read(registers::P_SOLL) - profile);
    if (std::abs(apart) < 16 * kNoise) return {};
    const Register& counts_16 = *motor.find(registers::P_FNC);
    const std::int64_t control = motor.read(registers::CNTRL_BITS);
    const bool large = model == Model::mac800;
    return fmt::format(
        "{} is another place, {}: P_MODE would turn {} from here to P_SOLL. To give P_SOLL, P_IST and {} one "
        "value: `{}`; {} in CNTRL_BITS takes {} from P_IST whenever the motor is passive",
        counts_16.name, long_value_text(counts_16, model, profile), long_value_text(counts_16, model, way),
        counts_16.name, resynchronise_command(model, control, place), large ? "SYNCPOSAUTO" : "AUTO_RESYNC",
        counts_16.name);
}

void add_remark(ChangeResult& outcome, Motor& motor, const Register& reg, std::int64_t raw) {
    const Model model = motor.model();
    if (reg.number == registers::P_IST) {
        const std::string apart = apart_remark(motor);
        if (!apart.empty()) outcome.remark += (outcome.remark.empty() ? "" : "; ") + apart;
    }
    if (reg.number == registers::ERR_STAT) {
        const auto settings = static_cast<std::int64_t>(setting_bits(model, reg));
        if (const std::int64_t lost = outcome.before.value_or(0) & ~raw & settings; lost != 0)
            outcome.remark = fmt::format(
                "{} was a setting and is off now; clearing errors alone leaves it: `{}`",
                bits_word(reg, model, lost), clear_errors_command(model, outcome.before.value_or(0)));
    }
    if (reg.number == registers::CNTRL_BITS && motor.model() != Model::mac800 &&
        ((outcome.before.value_or(raw) ^ raw) & kAtResetOnly) != 0)
        outcome.remark =
            "the inputs' bits act after the next reset only, and are lost by it unless kept: `macreg flash "
            "save`";
}

struct Limits {
    std::int64_t low, high, place;
    bool off;

    bool act() const { return !off && (low != 0 || high != 0); }
    bool leave_none() const { return low >= high && (low != 0 || high != 0); }
    bool shut_out() const { return act() && (place < low || place > high); }
};

Limits limits_of(const RawValues& now, const RawValues& wanted) {
    const auto at = [&](std::uint8_t number) {
        const auto found = wanted.find(number);
        return found != wanted.end() ? found->second : now.at(number);
    };
    return {at(MIN_P_IST), at(MAX_P_IST), at(P_IST), (at(ERR_STAT) & kDisPLim) != 0};
}

RawValues only(const RawValues& values, std::uint8_t number) {
    return {{number, values.at(number)}};
}

ChangeResult write_and_look(Motor& motor, const Register& reg, std::int64_t raw,
                            std::optional<std::int64_t> before) {
    const bool is_address = reg.number == address_register(motor.model()).number;
    ChangeResult outcome{.before = before};
    if (std::string none = no_mode(motor.model(), reg, raw); !none.empty())
        return {.before = before, .after = before.value_or(0), .taken = false, .why = std::move(none)};
    try {
        motor.write(reg, raw);
    } catch (const LineError& error) {
        if (!is_address) return refused_or_lost(motor, outcome.before, error);
    } catch (const Unconfirmed&) {
        outcome.why = gateway_refusal(motor, Asked::write);
        if (outcome.why.empty()) throw;
        return {.before = before, .after = before.value_or(0), .taken = false, .why = outcome.why};
    }
    if (is_address) {
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
    if (const std::string ended =
            reg.number == registers::MODE_REG ? ended_by_itself(raw, outcome.after) : "";
        !outcome.taken && !ended.empty() && hindrance(motor, raw, outcome.after).empty()) {
        outcome.taken = true;
        outcome.remark = ended;
    }
    if (!outcome.taken) outcome.why = why_not(motor, reg, raw, outcome.after);
    add_remark(outcome, motor, reg, raw);
    return outcome;
}

}  // namespace

std::string no_mode(Model model, const Register& reg, std::int64_t raw) {
    if (!is_mode(model, reg) || (raw >= 0 && raw <= last_mode(model))) return {};
    if (reg.number == registers::MODE_REG && raw >= kDefaultsToFlash)
        return "MODE_REG: 256 to 258 rewrite flash and registers; `macreg flash save`, `macreg flash "
               "defaults` and `macreg flash reload` do that, and ask first";
    return fmt::format("{}: {} is no mode; modes are 0 to {} (`macreg list {}`)", reg.name, raw,
                       last_mode(model), reg.name);
}

std::string danger(Model model, const Register& reg, std::int64_t raw) {
    if (reg.dangerous) return kUpset;
    const bool starts = reg.number == registers::STARTMODE;
    if (reg.number != registers::MODE_REG && !starts) return {};
    if (!is_test(raw)) return {};
    const std::string name = value_text(*registers::find(model, registers::MODE_REG), model, raw);
    return fmt::format("{} is for the maker's tests{}: the shaft may turn, without limit of velocity{}", name,
                       model == Model::mac800 ? ", and what it does is not described" : "",
                       starts ? ", after every reset" : "");
}

std::string errors_text(Model model, std::int64_t err_stat) {
    const std::uint32_t errors = static_cast<std::uint32_t>(err_stat) & error_bits(model);
    if (errors == 0) return {};
    const Register& reg = *registers::find(model, registers::ERR_STAT);
    return "ERR_STAT has " + names_text(reg, model, errors);
}

std::string gateway_refusal(Motor& motor, Asked asked) {
    constexpr const char* kOwnLine =
        "the gateway does not carry SAFE_MODE, flash and reset itself: they need the motor's own MacTalk "
        "line, wired to the board's second serial port or to this computer";
    if (!motor.is_behind_gateway()) return {};
    if (std::string refusal = port_refusal(motor); !refusal.empty()) return refusal;
    const std::uint32_t status = motor.master().read(gw::kDefaultAddress, gw::STATUS);
    if ((status & gw::kLinkDelivers) == 0)
        return "the gateway's link to the motor does not work; `nanoctl status` tells more";
    const bool service = asked == Asked::service;
    const unsigned needed = service ? 2 : 1;
    const bool runs = gw::run_state_of(status) != gw::RunState::stopped;
    if (runs && motor.master().read(gw::kDefaultAddress, gw::register_of(gw::Setting::motor_writes)) < needed)
        return fmt::format(
            "the gateway refuses it while its sequence runs or is held: `nanoctl stop` first, then this "
            "again. To allow it while it runs, after the stop `nanoctl settings set motor_writes={}`, then "
            "`nanoctl run`{}{}",
            needed, service ? "; besides, " : "", service ? kOwnLine : "");
    if (service) return kOwnLine;
    return "the motor did not accept it from the gateway; `nanoctl status` tells more of the link, `macreg "
           "why` of the motor";
}

bool is_stop(Model model, const Register& reg, std::int64_t raw) {
    if (reg.number != registers::MODE_REG) return false;
    return raw == kInit || (raw == kStop && model != Model::mac800);
}

bool stop_unasked(mactalk_client::Master& master, std::uint8_t address, std::optional<Model> model,
                  std::int64_t raw, unsigned attempts) {
    using mactalk_client::Width;
    const Width width = model == Model::mac800 ? Width::longword : Width::word;
    for (unsigned i = 0; i < attempts; ++i) {
        if (master.try_write(address, registers::MODE_REG, static_cast<std::uint32_t>(raw), width))
            return true;
    }
    return false;
}

ChangeResult change(Motor& motor, const Register& reg, std::int64_t raw) {
    if (!is_stop(motor.model(), reg, raw)) return write_and_look(motor, reg, raw, motor.read(reg));
    try {
        return write_and_look(motor, reg, raw, std::nullopt);
    } catch (const LineError& error) {
        throw LineError(error.kind(), fmt::format("{}; {}", kMayMove, error.what()));
    }
}
RawValues read_limits(Motor& motor, const RawValues& wanted) {
    constexpr std::uint8_t kAll[] = {MIN_P_IST, MAX_P_IST, P_IST, ERR_STAT};
    RawValues now;
    const auto touched = [&](std::uint8_t number) { return wanted.count(number) != 0; };
    if (std::none_of(std::begin(kAll), std::end(kAll), touched)) return now;
    for (const std::uint8_t number : kAll) now[number] = motor.read(number);
    return now;
}

std::string limits_danger(const RawValues& now, const RawValues& wanted) {
    if (now.empty()) return {};
    const Limits before = limits_of(now, {}), after = limits_of(now, wanted);
    const bool one_alone = wanted.count(MIN_P_IST) != wanted.count(MAX_P_IST);
    const char* both =
        one_alone ? "; both can be set at once: `macreg set MIN_P_IST LOW MAX_P_IST HIGH`" : "";
    if (after.leave_none() &&
        !(before.leave_none() && wanted.count(MIN_P_IST) + wanted.count(MAX_P_IST) == 0))
        return fmt::format(
            "MIN_P_IST ({}) is then not below MAX_P_IST ({}): every position is outside, and the motor makes "
            "itself passive at once (PLIM_ERR){}",
            after.low, after.high, both);
    if (after.shut_out() && !before.shut_out())
        return fmt::format(
            "P_IST ({}) is then outside of {} to {}: the motor makes itself passive at once (PLIM_ERR){}",
            after.place, after.low, after.high, both);
    return {};
}

bool maximum_first(const RawValues& now, const RawValues& wanted) {
    return limits_of(now, only(wanted, MIN_P_IST)).shut_out() &&
           !limits_of(now, only(wanted, MAX_P_IST)).shut_out();
}

}  // namespace nplc::macreg
