#include "why_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "causes/commands.h"
#include "causes/texts.h"
#include "registers/details.h"

namespace nplc::causes {
namespace {

namespace gw = registers::gateway;

/// Counts between two reads that are more than encoder noise.
constexpr std::int64_t kMotion = 8;
/// Counts by which a motor at its target may be off: more than the regulator's residual error, less than is
/// visible.
constexpr std::int64_t kApart = 64;
/// Counts that a target keeps from a limit: a motor that ends on the limit itself may pass it by one.
constexpr std::int64_t kMargin = 8;
/// R: of outer samples; more than a motor lags at constant velocity.
constexpr std::int64_t kLagSamples = 3;
/// 001 §4.1.10: high above 5.4 V, low below 4.4 V. Between them it stays what it was; this is the middle.
constexpr std::int64_t kHighPercent = 49;
constexpr std::int64_t kPlausibleSupply = 223;  // 12 V, a step is 53.7 mV (001 §3.2.151)

struct Room {
    std::int64_t low, high;
    bool holds(std::int64_t place) const { return place >= low && place <= high; }
};

/// The range that the limits leave for targets.
Room room_of(const Facts& f) {
    const std::int64_t low = f.at("MIN_P_IST"), high = f.at("MAX_P_IST");
    const std::int64_t margin = std::min(kMargin, std::max<std::int64_t>(high - low, 0) / 4);
    return {low + margin, high - margin};
}

std::string service(const Facts& f, std::string_view command) {
    return fmt::format("`macreg {}{}`", command, f.is_passive() ? "" : " --stop");
}

/// "(it turns 4096 counts (1.00 rev) at once, to P_SOLL)"
std::string way_words(const Facts& f, std::int64_t p_soll) {
    const auto way = static_cast<std::int32_t>(16 * p_soll - f.at("P_FNC"));
    if (way == 0) return "(it is at P_SOLL and will stand)";
    const registers::Register& profile = *registers::find(f.model(), "P_FNC");
    return fmt::format("(it turns {} at once, to P_SOLL)", long_value_text(profile, f.model(), way));
}

/// With the limits off.
std::string err_stat_command(const Facts& f) {
    const registers::Register& reg = *registers::find(f.model(), "ERR_STAT");
    const std::int64_t settings = f.at("ERR_STAT") & setting_bits(f.model(), reg);
    return "ERR_STAT " + bits_word(reg, f.model(), settings | kDisPLim);
}

std::string wider_follow_limit(const Facts& f) {
    return fmt::format("FLWERRMAX {}", f.velocity_of_moves() / 2);
}

std::string clear_command(const Facts& f) {
    return clear_errors_command(f.model(), f.at("ERR_STAT"));
}

std::string clear_words(const Facts& f) {
    const auto errors = static_cast<std::uint32_t>(f.at("ERR_STAT")) & error_bits(f.model());
    return fmt::format(
        "{}: `{}`, and choose the mode again",
        std::popcount(errors) > 1 ? "mend what led to the other errors, and clear them all" : "clear it",
        clear_command(f));
}

/// The command to move back inside the position limits.
std::string way_back(const Facts& f) {
    const std::int64_t low = f.at("MIN_P_IST"), high = f.at("MAX_P_IST");
    const std::string clear = clear_words(f);
    if (f.limited() && low >= high)
        return fmt::format("Mend the limits, which leave no place, then {}.", clear);
    if (!f.limited() || (f.at("P_IST") >= low && f.at("P_IST") <= high))
        return fmt::format("The shaft is inside again: {}.", clear);
    std::string by_hand =
        fmt::format("Turn the shaft back by hand to between {} and {}, then {}.", low, high, clear);
    if (f.mode() == kSafe) return by_hand;
    return fmt::format(
        "{} Or let the motor do it, its way being free: `macreg set P_SOLL {} {} MODE_REG P_MODE` {}, the "
        "limits being off until DIS_P_LIM is taken back.",
        by_hand, f.target_here(), err_stat_command(f), way_words(f, f.target_here()));
}

/// What starts a passive motor without an error: P_MODE or V_MODE, to a place inside the position limits.
std::string start_words(const Facts& f) {
    if (!f.ends_inside()) {
        const std::int64_t target = f.other_target();
        return fmt::format(
            "`macreg set P_SOLL {} MODE_REG P_MODE` {}. As it is now ({}), the target is not inside the "
            "position limits.",
            target, way_words(f, target), f.text("P_SOLL"));
    }
    const std::string position = fmt::format("`macreg set MODE_REG P_MODE` {}", way_words(f, f.at("P_SOLL")));
    if (f.limited()) return position + ". Not V_MODE: it would turn on until it leaves the position limits.";
    return fmt::format("{}, or `macreg set MODE_REG V_MODE`, which turns it at once ({}).", position,
                       f.text("V_SOLL"));
}

/// How to restore parameters that a file or the flash may still have.
std::string restore_words(const Facts& f) {
    return fmt::format(
        "Bring the parameters back: those in the flash by {}, or a file of an earlier dump; as the last "
        "resort {}, which loses all that was set.",
        service(f, "flash reload"), service(f, "flash defaults"));
}

/// A supply that is present may be compared with a wrong limit.
std::string supply_words(const Facts& f) {
    std::string mend = "Switch the power supply on; check voltage, fuse and cross-section.";
    if (f.large() || f.at("U_SUPPLY") < kPlausibleSupply) return mend;
    return fmt::format(
        "If {} is what the supply is to give, the limit is wrong: `macreg set U_MIN_SUP {}V --force`. If "
        "not: {}",
        f.text("U_SUPPLY"), f.at("U_SUPPLY") * 537 / 10'000 * 3 / 4, mend);
}

/// What ends the gateway's safe state.
std::string safe_remedy(const Facts& f) {
    using enum registers::gateway::SafeReason;
    switch (static_cast<registers::gateway::SafeReason>(f.gateway()->safe_reason)) {
        case link_down:
            return "Mend the line to the motor, or switch it on; the sequence goes on once it has sent "
                   "RESET_ERROR.";
        case enable_lost:
            return "Switch the enable input on, then `nanoctl run`.";
        case bad_table:
            return "`nanoctl upload` the table again, or `nanoctl run` for the one in use.";
        case no_proof:
            return "`nanoctl upload` the table with its certificate: `seqc verify --proof` makes one.";
        case bad_settings:
            return "Look at `nanoctl settings list` and keep them with `nanoctl settings set NAME=VALUE "
                   "--keep`.";
        case bad_run_mark:
            return "`nanoctl run` starts it; where that is refused the service must be restarted.";
        case no_lines:
        case no_store:
        case no_port:
            return "The gateway's journal names what its board lacks, and the gateway tries to have it "
                   "again.";
        case bad_set_points:
            return "Set the set-points anew with `nanoctl set-points`, or `nanoctl run` with those in use.";
        case motor_stuck:
            return "Look at the motor's line and supply, then `nanoctl run`.";
        default:
            return "`nanoctl run` starts it.";
    }
}

const char* level(bool high) {
    return high ? "high" : "low";
}

struct Word {
    std::string_view key;
    std::string (*text)(const Facts&);
};

constexpr Word kWords[] = {
    {"another P_SOLL",
     [](const Facts& f) { return fmt::format("`macreg set P_SOLL {}`", f.other_target()); }},
    {"another P2", [](const Facts& f) { return fmt::format("`macreg set P2 {}`", f.other_target()); }},
    {"clear", clear_words},
    {"clear command", clear_command},
    {"free pins",
     [](const Facts& f) { return control_command(f.model(), f.at("CNTRL_BITS"), 0, kUserInterface); }},
    {"least supply",
     [](const Facts& f) { return f.knows("U_MIN_SUP") ? fmt::format(" ({})", f.text("U_MIN_SUP")) : ""; }},
    {"mend supply", supply_words},
    {"pin owner",
     [](const Facts& f) -> std::string { return f.counts_pulses() ? "the pulse input" : "FastMAC"; }},
    {"restore", restore_words},
    {"resynchronise",
     [](const Facts& f) { return resynchronise_command(f.model(), f.at("CNTRL_BITS"), f.at("P_IST")); }},
    {"safe reason",
     [](const Facts& f) {
         using namespace registers::gateway;
         return std::string(name_of(static_cast<SafeReason>(f.gateway()->safe_reason)));
     }},
    {"safe remedy", safe_remedy},
    {"set load factor",
     [](const Facts& f) -> std::string {
         return f.is_passive() ? "`macreg set KVOUT 1`, more with inertia at the shaft."
                               : "`macreg set MODE_REG INIT_MODE KVOUT 1`, more with inertia at the shaft; "
                                 "then choose the mode again.";
     }},
    {"start", start_words},
    {"switch now",
     [](const Facts& f) -> std::string {
         return level(f.at("ANINP") * 100 > f.full_voltage() * kHighPercent);
     }},
    {"switch on", [](const Facts& f) -> std::string { return level(f.at("T_HOME") >= 0); }},
    {"way back", way_back},
    {"wider follow limit", wider_follow_limit},
};

std::string first(const std::string& command, std::string_view why) {
    return fmt::format("First `macreg set {}`: {}. Then: ", command, why);
}

std::string stay_inside(const Facts& f) {
    if (!f.limited()) return {};
    if (f.gears())
        return "First stop the master: its pulses would turn the motor out of its position limits. Then: ";
    if (f.homes()) return first(err_stat_command(f), "the position limits act while it homes (PLIM_ERR)");
    if (f.mode() == kAnalogueTorque)
        return first("MODE_REG INIT_MODE",
                     "torque alone would turn it out of its position limits (PLIM_ERR)");
    if (f.positions() ? f.ends_inside() : !f.has_velocity_limit()) return {};
    return first(fmt::format("P_SOLL {} MODE_REG P_MODE", f.target_here()),
                 "as it is now, it would turn until it leaves the position limits (PLIM_ERR)");
}

}  // namespace

std::uint8_t Facts::number(std::string_view name) const {
    if (name == "SPEED") name = homes() ? "V_HOME" : "V_SOLL";
    if (name == "TORQUE") name = mode() == kHome1 ? "T_HOME" : "T_SOLL";
    if (name == "SUPPLY") name = large() ? "U_BUS" : "U_SUPPLY";
    const registers::Register* reg = registers::find(model(), name);
    return reg != nullptr ? reg->number : std::uint8_t{0};
}

std::string_view Facts::name_of(std::string_view name) const {
    const registers::Register* reg = registers::find(model(), number(name));
    return reg != nullptr ? reg->name : std::string_view();
}

bool Facts::all_zero(std::string_view names) const {
    const auto all = words_of(names);
    return std::all_of(all.begin(), all.end(), [this](std::string_view name) { return at(name) == 0; });
}

std::string Facts::text(std::string_view name) const {
    const registers::Register* reg = registers::find(model(), number(name));
    if (reg == nullptr) return {};
    return fmt::format("{} {}", reg->name, long_value_text(*reg, model(), at(name)));
}

std::string Facts::word(std::string_view key) const {
    const auto found =
        std::find_if(std::begin(kWords), std::end(kWords), [&](const Word& one) { return one.key == key; });
    if (found != std::end(kWords)) return found->text(*this);
    if (key.starts_with('=')) return std::string(name_of(key.substr(1)));
    if (key.starts_with('#')) return std::to_string(at(key.substr(1)));
    return knows(key) ? text(key) : service(*this, key);
}

bool Facts::has_error(std::string_view bit) const {
    const registers::Field* field = registers::field_of(model(), registers::ERR_STAT, bit);
    return field != nullptr && (static_cast<std::uint32_t>(at("ERR_STAT")) & registers::mask_of(*field)) != 0;
}

bool Facts::has_any_error() const {
    return (static_cast<std::uint32_t>(at("ERR_STAT")) & error_bits(model())) != 0;
}

bool Facts::gears() const {
    return mode() == kGearPosition || mode() == kAnalogueGear || mode() == kCoil || mode() == kGearFollow;
}

bool Facts::positions() const {
    return mode() == kPosition || mode() == kAnalogue2Position || mode() == kAnaloguePosition;
}

bool Facts::has_velocity_limit() const {
    return positions() || gears() || mode() == kVelocity || mode() == kAnalogueVelocity ||
           mode() == kAnalogueVelocityGear || mode() == kAnalogueVelocityZero ||
           mode() == kVelocityAnalogueTorque;
}

bool Facts::is_driven() const {
    return has_velocity_limit() || homes() || mode() == kStop;
}

bool Facts::has_demands() const {
    return (is_driven() && mode() != kStop) || (mode() == kInit && !gateway());
}

bool Facts::demands_velocity() const {
    return has_demands() && (has_velocity_limit() || mode() == kInit);
}

bool Facts::moves() const {
    return std::abs(at("P_IST") - before("P_IST")) >= kMotion && (at("V_IST") != 0 || before("V_IST") != 0);
}

bool Facts::runs_away() const {
    // The pulse input is another source of velocity there (001 §3.2.5).
    if (!moves() || !is_driven() || mode() == kAnalogueVelocityGear || mode() == kGearFollow ||
        mode() == kCoil)
        return false;
    const std::int64_t now = 16 * std::abs(at("V_IST"));
    const std::int64_t before_that = 16 * std::abs(before("V_IST"));
    constexpr std::int64_t kNoise = 32;
    if (now < before_that - std::max(kNoise, before_that / 32)) return false;  // it brakes
    const std::int64_t asked = mode() == kStop ? 0 : std::abs(at("SPEED"));
    // The profile may still be decelerating: P_FNC's rate is the present demand.
    const std::int64_t pace = std::abs(static_cast<std::int32_t>(at("P_FNC") - before("P_FNC")));
    const std::int64_t way =
        std::int64_t{16} * std::abs(static_cast<std::int32_t>(at("P_IST") - before("P_IST")));
    const bool follows = mode() != kStop && way <= pace + pace / 4;
    const std::int64_t margin = large() ? 831 : 629;  // 300 rpm: 2.77056 and 2.09715 a rpm
    return !follows && now > 2 * asked + margin;
}

bool Facts::has_arrived() const {
    // P_FNC, not P_IST, is the profile's position: they differ by FLWERR (001 §4.4.3).
    return positions() && !moves() && static_cast<std::int32_t>(16 * at("P_SOLL") - at("P_FNC")) == 0;
}

bool Facts::is_apart() const {
    return std::abs(static_cast<std::int32_t>(at("P_SOLL") - at("FLWERR") - at("P_IST"))) > kApart;
}

bool Facts::lags() const {
    return std::abs(at("FLWERR")) > kApart;
}

bool Facts::pushes() const {
    const std::int64_t limit = torque_limit();
    if (limit <= 0 || std::abs(at("VF_OUT")) < limit - limit / 32 || moves()) return false;
    const auto grows = [&](std::string_view name) { return std::abs(at(name)) > std::abs(before(name)); };
    // In gear modes it is G_FNC, which may stand still.
    return grows("FLWERR") || grows("FNCERR") || (gears() && at("FNCERR") != 0);
}

bool Facts::has_limits() const {
    return at("MIN_P_IST") != 0 || at("MAX_P_IST") != 0;
}

bool Facts::limited() const {
    return has_limits() && (at("ERR_STAT") & kDisPLim) == 0;
}

bool Facts::allows(std::int64_t p_soll) const {
    return !limited() || room_of(*this).holds(p_soll + apart());
}

bool Facts::voltage_leads_out() const {
    const std::int64_t p1 = at("P1"), p2 = at("P2");
    const std::int64_t reach = full_voltage() * p2 / 16;
    if (mode() == kAnaloguePosition) return !allows(p1 - reach) || !allows(p1 + reach);
    return mode() == kAnalogue2Position && (!allows(p1) || !allows(p2));
}

bool Facts::follow_limit_is_small() const {
    return at("FLWERRMAX") > 0 && at("FLWERRMAX") * 16 < kLagSamples * velocity_of_moves();
}

bool Facts::is_near(std::string_view value, std::string_view limit) const {
    return at(limit) > 0 && at(value) * 10 >= at(limit) * 8 && at(value) <= at(limit);
}

bool Facts::undervoltage_is_over() const {
    return has_error("UV_DETECT") && !large() && at("U_SUPPLY") > 0 &&
           at("U_SUPPLY") >= at("U_MIN_SUP") * 5 / 4;
}

bool Facts::undervoltage_stops() const {
    return has_error("UV_DETECT") && !undervoltage_is_over();
}

bool Facts::coil_is_set_up() const {
    const std::int64_t p1 = at("P1"), p2 = at("P2"), p3 = at("P3"), p4 = at("P4");
    return p1 <= p2 && p2 <= p3 && p3 <= p4 && p1 != p4;
}

bool Facts::has_no_pulses() const {
    const std::int64_t pulses = at("V_EXT") + (mode() == kCoil ? at("V8") : 0);
    const bool by_voltage = mode() == kAnalogueVelocityGear && at("ANINP") * 100 / full_voltage() != 0;
    return pulses == 0 && before("V_EXT") == 0 && !by_voltage;
}

bool Facts::pulse_pins_are_taken() const {
    return !large() && ((at("CNTRL_BITS") & kUserInterface) != 0 || speaks_fastmac());
}

bool Facts::counts_pulses() const {
    // Other modes leave V_EXT unchanged (001 §3.2.120).
    if (mode() != kInit && !gears() && mode() != kAnalogueVelocityGear) return false;
    return mode() != kCoil && (at("V_EXT") != 0 || before("V_EXT") != 0);
}

bool Facts::user_interface_waits() const {
    const bool asked_for = (at("CNTRL_BITS") & kUserInterface) == kUserInterface;
    return !large() && (asked_for ? counts_pulses() : speaks_fastmac());
}

bool Facts::speaks_fastmac() const {
    return !large() && gateway_has(gw::kLinkDelivers);
}

bool Facts::gateway_has(gw::StatusBit bit) const {
    return gateway() && (gateway()->status & bit) != 0;
}

bool Facts::gateway_is(gw::RunState state) const {
    return gateway() && gw::run_state_of(gateway()->status) == state;
}

std::int64_t Facts::torque_limit() const {
    if (!is_driven()) return 0;
    if (mode() == kStop) return 1023;
    if (mode() == kHome1) return std::min<std::int64_t>(std::abs(at("T_HOME")) * 5 / 4, 1023);
    if (mode() != kVelocityAnalogueTorque) return std::abs(at("T_SOLL"));
    return std::abs(at("ANINP") * at("T_SOLL")) / (full_voltage() + 1);
}

std::int64_t Facts::velocity_of_moves() const {
    const std::int64_t set = std::abs(at("SPEED"));
    return set >= tiny_velocity() ? set : large() ? 1385 : 1049;  // 500 rpm
}

std::int64_t Facts::apart() const {
    return at("P_IST") + at("FLWERR") - at("P_FNC") / 16;
}

/// P_SOLL for this position of P_IST, as near as the register's range allows.
std::int64_t Facts::p_soll_of(std::int64_t place) const {
    const registers::Register& reg = *registers::find(model(), "P_SOLL");
    return std::clamp<std::int64_t>(place - apart(), reg.min, reg.max);
}

std::int64_t Facts::other_target() const {
    const std::int64_t here = at("P_IST");
    const std::int64_t turn = registers::scale_of(model()).counts_per_rev;
    std::int64_t place = here + turn;
    if (p_soll_of(place) != place - apart()) place = here - turn;
    if (limited()) {
        const Room room = room_of(*this);
        if (!room.holds(place)) place = here - turn;
        if (!room.holds(place)) place = here - room.low > room.high - here ? room.low : room.high;
    }
    return p_soll_of(place);
}

std::int64_t Facts::target_here() const {
    const Room room = room_of(*this);
    return p_soll_of(std::clamp(at("P_IST"), room.low, std::max(room.low, room.high)));
}

std::string Facts::before_it_turns() const {
    if (!follow_limit_is_small()) return stay_inside(*this);
    return first(wider_follow_limit(*this), "a motor that is well may pass it (FLW_ERR)") +
           stay_inside(*this);
}

}  // namespace nplc::causes
