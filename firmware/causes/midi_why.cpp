#include "causes/midi_why.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "registers/gateway.h"
#include "registers/midi_scale.h"

namespace nplc::causes {
namespace {

namespace midi = registers::midi;
namespace gw = registers::gateway;
using registers::gateway::DriveFault;

constexpr std::int32_t kWarm = 85'000;  ///< thousandths of a degree; 10 below the trip
constexpr std::uint32_t kStoppedByEnd =
    midi::kAtUpperInput | midi::kAtLowerInput | midi::kAtUpperStop | midi::kAtLowerStop;

/// END_STOPS
enum Guard : std::uint32_t { kHardware = 1, kSoftware = 8 };

/// The questions of the rules about a drive.
class MidiFacts {
  public:
    MidiFacts(const MidiState& state, const std::optional<GatewayState>& gateway, const MidiTexts& texts)
        : drive(state), texts_(texts), has_gateway_(gateway.has_value()) {
        if (gateway) link_is_down_ = (gateway->status & gw::kLinkDelivers) == 0;
    }

    const MidiState& drive;

    bool link_is_down() const { return link_is_down_; }
    bool has_fault(DriveFault fault) const { return drive.driver && drive.driver->fault == fault; }
    bool has(std::uint32_t status_bit) const { return !link_is_down_ && (drive.status & status_bit) != 0; }
    bool turns() const { return !link_is_down_ && drive.turns; }
    bool is_held() const { return !link_is_down_ && !drive.turns && drive.is_stuck; }
    bool at_input(std::uint32_t input) const {
        return guarded(kHardware) && (drive.readings->terminals & input) != 0;
    }
    bool stops_are_crossed() const {
        return guarded(kSoftware) && drive.readings->lower_stop > drive.readings->upper_stop;
    }
    bool above() const { return guards_range() && drive.readings->position > drive.readings->upper_stop; }
    bool below() const { return guards_range() && drive.readings->position < drive.readings->lower_stop; }
    bool is_at_end() const {
        return at_input(midi::kUpperInput) || at_input(midi::kLowerInput) || above() || below();
    }
    bool has_no_torque() const { return !link_is_down_ && drive.torque == 0; }
    std::int64_t torque_percent() const {
        return drive.torque.value_or(0) * 100 / std::max<std::int64_t>(drive.most_torque, 1);
    }
    bool has_little_torque() const {
        return !link_is_down_ && drive.torque.value_or(0) != 0 && torque_percent() < 20;
    }
    bool is_slow() const {
        return !link_is_down_ &&
               drive.period.value_or(0) >
                   (drive.model ? midi::rpm_times_period(*drive.model) : std::int64_t{24'000});
    }
    bool is_warm() const {
        return drive.readings && drive.model &&
               midi::temperature_of(*drive.model, drive.readings->temperature) >= kWarm;
    }
    bool is_at_target() const { return !link_is_down_ && drive.driver && drive.driver->is_at_target; }
    bool has_no_speed() const { return !link_is_down_ && drive.driver && drive.driver->has_no_speed; }

    static std::string_view name_of(std::string_view parameter) { return parameter; }
    std::string word(std::string_view key) const;

  private:
    bool guarded(Guard kind) const { return drive.readings && (drive.readings->end_stops & kind) != 0; }
    bool guards_range() const { return guarded(kSoftware) && !stops_are_crossed(); }
    std::string speed() const;

    const MidiTexts& texts_;
    bool has_gateway_;
    bool link_is_down_ = false;
};

std::string MidiFacts::speed() const {
    const std::int64_t period = drive.period.value_or(0);
    if (!texts_.speed.empty() || period == 0) return texts_.speed;
    const double increments = static_cast<double>(midi::kTicksPerSecond) / static_cast<double>(period);
    return drive.model
               ? fmt::format("{:.3g} rpm", increments * 60 / midi::facts_of(*drive.model).increments_per_rev)
               : fmt::format("{:.3g} inc/s", increments);
}

std::string MidiFacts::word(std::string_view key) const {
    if (key == "speed") return speed();
    if (key == "percent") return std::to_string(torque_percent());
    if (key == "distance") return texts_.distance;
    if (key == "limitation") return std::string(midi::text_of(drive.driver->limitation));
    if (key == "mend it")
        return has_gateway_
                   ? "Mend it. A fault is kept until the sequence gives \"reset error\" (01h), or the module "
                     "is switched off and on."
                   : "Mend it, then `macreg midi reset`, or switch the module off and on: a fault is kept "
                     "until then.";
    if (key == "stop") return has_gateway_ ? "`nanoctl stop`" : "`macreg midi stop`";
    if (key == "acknowledge") return "then \"reset error\" (01h) of the sequence, or stop and run it";
    std::string stopped_by;
    for (const midi::Bit& bit : midi::status_bits()) {
        if ((bit.mask & drive.status & kStoppedByEnd) == 0) continue;
        stopped_by += (stopped_by.empty() ? "" : ", ") + std::string(bit.text);
    }
    return stopped_by;
}

using M = const MidiFacts&;
using enum Severity;

constexpr std::string_view kAway = "`macreg midi move --by` leads away from it.";
constexpr std::string_view kAwayOrWider =
    "`macreg midi move --by` leads away from it, or `macreg midi limits` widens the limits.";

// clang-format off
/// In the order of urgency. Those of the gateway itself stand before kDrive's others.
constexpr Rule<MidiFacts> kFirst[] = {
    {"moves", tells, [](M m) { return m.turns(); },
     "It moves{distance}.", "POSITION", "{stop} stops it."},
    {"same_address", stops, [](M m) { return m.has_fault(DriveFault::several); },
     "More than one drive answers to the address: what moves one moves both, so they were told to stop.", "",
     "Switch off all of them but one, give that one an address of its own, {acknowledge}."},
    {"drive_unreadable", stops, [](M m) { return m.has_fault(DriveFault::unreadable); },
     "Each answer of the drive comes damaged.", "",
     "Look for noise on the line, another speed, a second drive at its address; {acknowledge}."},
    {"drive_restarted", stops, [](M m) { return m.has_fault(DriveFault::restarted); },
     "The drive started anew by itself, so its orders were dropped.", "",
     "Look at its supply and its security input, {acknowledge}."},
    {"gateway_link_down", stops, [](M m) { return m.link_is_down(); },
     "The gateway's line to the drive does not work, so no order of the sequence arrives.", "",
     "Look at the drive's supply, the cable, its address and its speed; `nanoctl log` tells more."},
};

constexpr Rule<MidiFacts> kDrive[] = {
    {"drive_link_lost", stops, [](M m) { return m.has_fault(DriveFault::link_lost) && !m.link_is_down(); },
     "The line to the drive did not work for a moment, so its orders were dropped.", "",
     "Look at supply and cable, {acknowledge}."},
    {"amplifier_trip", stops, [](M m) { return m.has(midi::kAmplifierTrip); },
     "The amplifier switched itself off: heat, a short circuit of the motor, a leak to earth, or more than "
     "125 % of the highest supply voltage.", "STATUS",
     "Look at the motor cable and at the supply while it brakes (a ballast may be missing). {mend it}"},
    {"motor_hot", stops, [](M m) { return m.has(midi::kThermalTrip); },
     "The motor was hotter than 95 C and was switched off.", "STATUS",
     "Let it cool down; use less TORQUE, longer ramps, or STOP_TORQUE standby. {mend it}"},
    {"too_hot", stops, [](M m) { return m.has(midi::kThermalTrip23); },
     "The module was too hot, or its amplifier or encoder failed, and it switched itself off.", "STATUS",
     "Let it cool down; look at motor and encoder cables. {mend it}"},
    {"no_encoder", stops, [](M m) { return m.has(midi::kEncoderTrip); },
     "The encoder does not answer.", "STATUS", "Plug in its cable at both ends. {mend it}"},
    {"supply_interrupted", stops, [](M m) { return m.has(midi::kSupplyTrip); },
     "The supply fell below 19 V, if only for a moment.", "STATUS",
     "Look at supply, fuse and cross-section. {mend it}"},
    {"drive_end_stop", stops, [](M m) { return m.has_fault(DriveFault::end_stop); },
     "An end-stop ended its motion.", "STATUS",
     "Let it move the other way: {acknowledge}."},
    {"drive_not_arrived", stops, [](M m) { return m.has_fault(DriveFault::not_arrived); },
     "It stands, and not where it was sent.", "POSITION",
     "Look for another master, or for what ended its motion; {acknowledge}."},
    {"drive_refused", stops, [](M m) { return m.has_fault(DriveFault::refused); },
     "It refused a command that it should take.", "",
     "Look at its model and its software release; {acknowledge}."},
    {"drive_unclear", stops, [](M m) { return m.has_fault(DriveFault::unclear); },
     "It is unknown whether it took a command, so it was told to stop.", "",
     "Look at the line and the position; {acknowledge}."},
    {"drive_bad_value", stops, [](M m) { return m.has_fault(DriveFault::bad_value); },
     "The sequence gave an order that it cannot do: {limitation}.", "", "Change the program."},
    {"drive_jumped", stops, [](M m) { return m.has_fault(DriveFault::jumped); },
     "Its position jumped in mid-motion: a load that drags it, another master, or a hand.", "POSITION",
     "Let the sequence find the origin again; {acknowledge}."},
    {"under_voltage", hinders, [](M m) { return m.has(midi::kUnderVoltage); },
     "The supply voltage is too low.", "SUPPLY", "Raise it; below 19 V the module switches itself off."},
    {"over_voltage", hinders, [](M m) { return m.has(midi::kOverVoltage); },
     "The supply voltage is too high: the module does not brake above 115 % of its highest.", "SUPPLY",
     "Lower it; if it rises while the motor brakes, use longer ramps or a ballast."},
    {"over_voltage_kept", tells, [](M m) { return m.has(midi::kOverVoltageKept) && !m.has(midi::kOverVoltage); },
     "The supply voltage has been too high once, mostly by braking.", "SUPPLY",
     "Use longer ramps or a ballast. `macreg midi reset` clears the note."},
    {"at_upper_input", hinders, [](M m) { return m.at_input(midi::kUpperInput); },
     "The upper end-stop input is on: it moves in the negative direction only.", "POSITION TERMINALS", kAway},
    {"at_lower_input", hinders, [](M m) { return m.at_input(midi::kLowerInput); },
     "The lower end-stop input is on: it moves in the positive direction only.", "POSITION TERMINALS", kAway},
    {"stops_crossed", stops, [](M m) { return m.stops_are_crossed(); },
     "The lower software stop lies above the upper one.", "LOWER_STOP UPPER_STOP",
     "`macreg midi limits LOWER UPPER` sets both."},
    {"above_upper_stop", hinders, [](M m) { return m.above(); },
     "It is beyond the upper software stop: it moves in the negative direction only.", "POSITION UPPER_STOP",
     kAwayOrWider},
    {"below_lower_stop", hinders, [](M m) { return m.below(); },
     "It is beyond the lower software stop: it moves in the positive direction only.", "POSITION LOWER_STOP",
     kAwayOrWider},
    {"stopped_by_end_stop", tells,
     [](M m) { return m.has(kStoppedByEnd) && !m.is_at_end() && !m.has_fault(DriveFault::end_stop); },
     "Its last motion was {stopped by}.", "STATUS",
     "A motion in the other direction, or inside the limits, is taken."},
    {"torque_zero", stops, [](M m) { return m.has_no_torque(); },
     "The torque is limited to nothing.", "TORQUE", "`macreg midi set TORQUE 100%`"},
    {"velocity_zero", stops, [](M m) { return m.has_no_speed(); },
     "V_SOLL is 0, which holds every move back.", "SPEED", "Give the sequence another V_SOLL."},
    {"torque_small", hinders, [](M m) { return m.has_little_torque(); },
     "The torque is limited to {percent} %.", "TORQUE", "`macreg midi set TORQUE 100%` gives all of it."},
    {"does_not_follow", stops, [](M m) { return m.is_held(); },
     "It was ordered to move and does not: the shaft is held, or the load is more than the torque.",
     "TERMINALS TORQUE SPEED",
     "Free the shaft, raise TORQUE, or lower SPEED and lengthen RAMP; `macreg midi stop --emergency` ends the "
     "attempt."},
    {"at_target", stops, [](M m) { return m.is_at_target() && !m.turns(); },
     "It is where the sequence sent it.", "POSITION", "It waits for another target."},
    {"slow", hinders, [](M m) { return m.is_slow(); },
     "Moves are slow: {speed}.", "SPEED", "`macreg midi set SPEED 100rpm`, for one."},
    {"warm", hinders, [](M m) { return m.is_warm(); },
     "It is hot, and switches itself off at 95 C.", "TEMPERATURE",
     "Less TORQUE, longer ramps, pauses, STOP_TORQUE standby, or better cooling."},
};
// clang-format on

constexpr Rule<MidiFacts> kWaits{
    "waits",
    tells,
    nullptr,
    "Nothing keeps it from moving, as far as it tells: no fault, no end-stop, torque and supply are there. "
    "It "
    "waits for an order.",
    "STATUS POSITION",
    "`macreg midi move POSITION` moves it, and switches its power on. An order that it refuses is told with "
    "the reason."};

/// A line has one master.
void pass_gateway(Finding& finding) {
    constexpr std::string_view kOwnLine =
        " `macreg midi` needs the drive's own line: stop the gateway for it.";
    if (finding.remedy.find("`macreg midi") != std::string::npos) finding.remedy += kOwnLine;
}

void add(std::span<const Rule<MidiFacts>> rules, const MidiFacts& facts, std::vector<Finding>& all) {
    for (const Rule<MidiFacts>& rule : rules) {
        if (rule.holds(facts)) all.push_back(finding_of(rule, facts));
    }
}

/// Its sequence's state; findings about the line have their own texts for this drive.
void add_gateway(const GatewayState& gateway, std::vector<Finding>& all) {
    std::vector<Finding> found = why(gateway);
    std::erase_if(found, [](const Finding& one) { return one.code == "gateway_link_down"; });
    std::move(found.begin(), found.end(), std::back_inserter(all));
}

}  // namespace

std::vector<Finding> why(const MidiState& drive, const std::optional<GatewayState>& gateway,
                         const MidiTexts& texts) {
    const MidiFacts facts(drive, gateway, texts);
    std::vector<Finding> all;
    add(kFirst, facts, all);
    add(kDrive, facts, all);
    if (gateway) add_gateway(*gateway, all);
    if (!gateway && !facts.turns() && only_tell(all)) all.push_back(finding_of(kWaits, facts));
    std::stable_sort(all.begin() + (facts.turns() ? 1 : 0), all.end(),
                     [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
    if (gateway) std::for_each(all.begin(), all.end(), pass_gateway);
    return all;
}

}  // namespace nplc::causes
