#include "macreg/midi/why.h"

#include <fmt/format.h>

#include <algorithm>

#include "registers/midi_scale.h"

namespace nplc::macreg::midi {
namespace {

constexpr std::int32_t kWarm = 85'000;  ///< thousandths of a degree; 10 below the trip
constexpr std::uint32_t kStoppedByEnd =
    reg::kAtUpperInput | reg::kAtLowerInput | reg::kAtUpperStop | reg::kAtLowerStop;

/// END_STOPS
enum Guard : std::uint32_t { kHardware = 1, kSoftware = 8 };

/// What the rules ask of a condition.
class Facts {
  public:
    explicit Facts(const Condition& condition) : now(condition.now), condition_(condition) {}

    const Readings& now;

    bool has(std::uint32_t status_bit) const { return (now.status() & status_bit) != 0; }
    bool turns() const { return condition_.before.position() != now.position(); }
    bool is_held() const { return !turns() && now.busy() && condition_.before.busy(); }
    bool guarded(Guard kind) const { return (static_cast<std::uint32_t>(now.raw("END_STOPS")) & kind) != 0; }
    bool at_input(std::uint32_t input) const { return guarded(kHardware) && (now.measures() & input) != 0; }
    bool stops_are_crossed() const {
        return guarded(kSoftware) && now.raw("LOWER_STOP") > now.raw("UPPER_STOP");
    }
    bool above() const { return guards_range() && now.position() > now.raw("UPPER_STOP"); }
    bool below() const { return guards_range() && now.position() < now.raw("LOWER_STOP"); }
    bool is_at_end() const {
        return at_input(reg::kUpperInput) || at_input(reg::kLowerInput) || above() || below();
    }
    std::int64_t torque_percent() const {
        return now.raw("TORQUE") * 100 / std::max<std::int64_t>(condition_.scale.imax, 1);
    }
    bool is_slow() const {
        const auto& model = condition_.scale.model;
        return now.raw("SPEED") > (model ? std::int64_t{reg::rpm_times_period(*model)} : 24'000);
    }
    bool is_warm() const {
        const auto& model = condition_.scale.model;
        const auto raw = static_cast<std::uint8_t>(now.raw("TEMPERATURE"));
        return model && reg::temperature_of(*model, raw) >= kWarm;
    }

    static std::string_view name_of(std::string_view parameter) { return parameter; }
    std::string word(std::string_view key) const {
        if (key == "speed") return speed_text(now.raw("SPEED"), condition_.scale);
        if (key == "percent") return std::to_string(torque_percent());
        if (key == "stopped by") return status_words(now.status() & kStoppedByEnd);
        return position_text(std::int64_t{now.position()} - condition_.before.position(), condition_.scale);
    }

  private:
    bool guards_range() const { return guarded(kSoftware) && !stops_are_crossed(); }

    const Condition& condition_;
};

using F = const Facts&;
using enum Severity;

constexpr std::string_view kAway = "`macreg midi move --by` leads away from it.";
constexpr std::string_view kAwayOrWider =
    "`macreg midi move --by` leads away from it, or `macreg midi limits` widens the limits.";

// clang-format off
constexpr Rule<Facts> kRules[] = {
    {"amplifier_trip", stops, [](F f) { return f.has(reg::kAmplifierTrip); },
     "The amplifier switched itself off: heat, a short circuit of the motor, a leak to earth, or more than "
     "125 % of the highest supply voltage.", "STATUS",
     "Look at the motor cable and at the supply while it brakes (a ballast may be missing). "
     "Mend it, then `macreg midi reset`, or switch the module off and on: a fault is kept until then."},
    {"motor_hot", stops, [](F f) { return f.has(reg::kThermalTrip); },
     "The motor was hotter than 95 C and was switched off.", "STATUS",
     "Let it cool down; use less TORQUE, longer ramps, or STOP_TORQUE standby. "
     "Mend it, then `macreg midi reset`, or switch the module off and on: a fault is kept until then."},
    {"too_hot", stops, [](F f) { return f.has(reg::kThermalTrip23); },
     "The module was too hot, or its amplifier or encoder failed, and it switched itself off.", "STATUS",
     "Let it cool down; look at motor and encoder cables. "
     "Mend it, then `macreg midi reset`, or switch the module off and on: a fault is kept until then."},
    {"no_encoder", stops, [](F f) { return f.has(reg::kEncoderTrip); },
     "The encoder does not answer.", "STATUS",
     "Plug in its cable at both ends. "
     "Mend it, then `macreg midi reset`, or switch the module off and on: a fault is kept until then."},
    {"supply_interrupted", stops, [](F f) { return f.has(reg::kSupplyTrip); },
     "The supply fell below 19 V, if only for a moment.", "STATUS",
     "Look at supply, fuse and cross-section. "
     "Mend it, then `macreg midi reset`, or switch the module off and on: a fault is kept until then."},
    {"under_voltage", hinders, [](F f) { return f.has(reg::kUnderVoltage); },
     "The supply voltage is too low.", "SUPPLY", "Raise it; below 19 V the module switches itself off."},
    {"over_voltage", hinders, [](F f) { return f.has(reg::kOverVoltage); },
     "The supply voltage is too high: the module does not brake above 115 % of its highest.", "SUPPLY",
     "Lower it; if it rises while the motor brakes, use longer ramps or a ballast."},
    {"over_voltage_kept", tells, [](F f) { return f.has(reg::kOverVoltageKept) && !f.has(reg::kOverVoltage); },
     "The supply voltage has been too high once, mostly by braking.", "SUPPLY",
     "Use longer ramps or a ballast. `macreg midi reset` clears the note."},
    {"at_upper_input", hinders, [](F f) { return f.at_input(reg::kUpperInput); },
     "The upper end-stop input is on: it moves in the negative direction only.", "POSITION TERMINALS", kAway},
    {"at_lower_input", hinders, [](F f) { return f.at_input(reg::kLowerInput); },
     "The lower end-stop input is on: it moves in the positive direction only.", "POSITION TERMINALS", kAway},
    {"stops_crossed", stops, [](F f) { return f.stops_are_crossed(); },
     "The lower software stop lies above the upper one.", "LOWER_STOP UPPER_STOP",
     "`macreg midi limits LOWER UPPER` sets both."},
    {"above_upper_stop", hinders, [](F f) { return f.above(); },
     "It is beyond the upper software stop: it moves in the negative direction only.", "POSITION UPPER_STOP",
     kAwayOrWider},
    {"below_lower_stop", hinders, [](F f) { return f.below(); },
     "It is beyond the lower software stop: it moves in the positive direction only.", "POSITION LOWER_STOP",
     kAwayOrWider},
    {"stopped_by_end_stop", tells, [](F f) { return f.has(kStoppedByEnd) && !f.is_at_end(); },
     "Its last motion was {stopped by}.", "STATUS",
     "A motion in the other direction, or inside the limits, is taken."},
    {"torque_zero", stops, [](F f) { return f.now.raw("TORQUE") == 0; },
     "The torque is limited to nothing.", "TORQUE", "`macreg midi set TORQUE 100%`"},
    {"torque_small", hinders, [](F f) { return f.now.raw("TORQUE") != 0 && f.torque_percent() < 20; },
     "The torque is limited to {percent} %.", "TORQUE", "`macreg midi set TORQUE 100%` gives all of it."},
    {"moves", tells, [](F f) { return f.turns(); },
     "It moves: {distance} in 200 ms.", "POSITION", "`macreg midi stop` stops it."},
    {"does_not_follow", stops, [](F f) { return f.is_held(); },
     "It wants to move and does not: the shaft is held, or the load is more than the torque.",
     "TERMINALS TORQUE SPEED",
     "Free the shaft, raise TORQUE, or lower SPEED and lengthen RAMP; `macreg midi stop --emergency` ends the "
     "attempt."},
    {"slow", hinders, [](F f) { return f.is_slow(); },
     "Moves are slow: {speed}.", "SPEED", "`macreg midi set SPEED 100rpm`, for one."},
    {"warm", hinders, [](F f) { return f.is_warm(); },
     "It is hot, and switches itself off at 95 C.", "TEMPERATURE",
     "Less TORQUE, longer ramps, pauses, STOP_TORQUE standby, or better cooling."},
};
// clang-format on

constexpr Rule<Facts> kWaits{
    "waits",
    tells,
    nullptr,
    "Nothing keeps it from moving, as far as it tells: no fault, no end-stop, torque and supply are there. "
    "It "
    "waits for an order.",
    "STATUS POSITION",
    "`macreg midi move POSITION` moves it, and switches its power on. An order that it refuses is told with "
    "the reason."};

}  // namespace

Condition read_condition(Module& module) {
    Condition condition{.scale = module.scale()};
    condition.before = module.read_all();
    module.master().link().pause(base::Milliseconds{200});
    condition.now = module.read_all();
    return condition;
}

Finding same_address(std::uint8_t address, bool is_can) {
    return {"same_address",
            Severity::stops,
            fmt::format("More than one module answers to address {}: what moves one moves both, so that "
                        "commands that move are refused.",
                        address),
            {},
            fmt::format("Switch off all of them but one; `macreg midi {}address set NEW` gives that one an "
                        "address of its own; then switch on the others.",
                        is_can ? "" : fmt::format("--address {} ", address))};
}

std::vector<Finding> why(const Condition& condition) {
    const Facts facts(condition);
    std::vector<Finding> all;
    for (const Rule<Facts>& rule : kRules) {
        if (rule.holds(facts)) all.push_back(finding_of(rule, facts));
    }
    if (!facts.turns() && only_tell(all)) all.push_back(finding_of(kWaits, facts));
    std::stable_sort(all.begin(), all.end(),
                     [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
    return all;
}

}  // namespace nplc::macreg::midi
