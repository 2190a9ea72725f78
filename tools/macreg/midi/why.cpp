#include "macreg/midi/why.h"

#include <fmt/format.h>

#include <algorithm>

#include "registers/midi_scale.h"

namespace nplc::macreg::midi {
namespace {

constexpr std::uint32_t kHardware = 1;
constexpr std::uint32_t kSoftware = 8;
constexpr std::int32_t kWarm = 85'000;  ///< thousandths of a degree; 10 below the trip
constexpr const char* kReset =
    "Mend it, then `macreg midi reset`, or switch the module off and on: a fault is kept until then.";

struct Trip {
    std::uint32_t bit;
    const char* code;
    const char* sentence;
    const char* remedy;
};
constexpr Trip kTripped[] = {
    {reg::kAmplifierTrip, "amplifier_trip",
     "The amplifier switched itself off: heat, a short circuit of the motor, a leak to earth, or more than "
     "125 % of the highest supply voltage.",
     "Look at the motor cable and at the supply while it brakes (a ballast may be missing). "},
    {reg::kThermalTrip, "motor_hot", "The motor was hotter than 95 C and was switched off.",
     "Let it cool down; use less TORQUE, longer ramps, or STOP_TORQUE standby. "},
    {reg::kThermalTrip23, "too_hot",
     "The module was too hot, or its amplifier or encoder failed, and it switched itself off.",
     "Let it cool down; look at motor and encoder cables. "},
    {reg::kEncoderTrip, "no_encoder", "The encoder does not answer.", "Plug in its cable at both ends. "},
    {reg::kSupplyTrip, "supply_interrupted", "The supply fell below 19 V, if only for a moment.",
     "Look at supply, fuse and cross-section. "},
};

class Facts {
  public:
    explicit Facts(const Condition& condition) : condition_(condition) {}

    std::vector<Finding> judge() {
        faults();
        supply();
        end_stops();
        torque();
        following();
        hints();
        if (findings_.all.empty() || findings_.all.front().severity == Severity::tells) rest();
        std::stable_sort(findings_.all.begin(), findings_.all.end(),
                         [](const Finding& a, const Finding& b) { return a.severity < b.severity; });
        return std::move(findings_.all);
    }

  private:
    const Readings& now() const { return condition_.now; }
    bool has(std::uint32_t bit) const { return (now().status & bit) != 0; }
    bool turns() const { return condition_.before.position != now().position; }
    bool guarded(std::uint32_t kind) const {
        return (static_cast<std::uint32_t>(now().raw("END_STOPS")) & kind) != 0;
    }
    std::string at(std::int64_t position) const { return position_text(position, condition_.scale); }

    void faults() {
        for (const Trip& one : kTripped) {
            if (has(one.bit))
                findings_.stops(one.code, one.sentence, {"STATUS"}, std::string(one.remedy) + kReset);
        }
    }

    void supply() {
        if (has(reg::kUnderVoltage))
            findings_.hinders("under_voltage", "The supply voltage is too low.", {"SUPPLY"},
                              "Raise it; below 19 V the module switches itself off.");
        if (has(reg::kOverVoltage))
            findings_.hinders(
                "over_voltage",
                "The supply voltage is too high: the module does not brake above 115 % of its highest.",
                {"SUPPLY"}, "Lower it; if it rises while the motor brakes, use longer ramps or a ballast.");
        else if (has(reg::kOverVoltageKept))
            findings_.tells("over_voltage_kept",
                            "The supply voltage has been too high once, mostly by braking.", {"SUPPLY"},
                            "Use longer ramps or a ballast. `macreg midi reset` clears the note.");
    }

    void blocked(const char* code, bool positive, const std::string& what, std::string_view parameter,
                 const std::string& remedy) {
        findings_.hinders(
            code,
            fmt::format("{}: it moves in the {} direction only.", what, positive ? "negative" : "positive"),
            {"POSITION", parameter}, remedy);
    }

    void end_stops() {
        const std::string back = "`macreg midi move --by` leads away from it";
        if (guarded(kHardware)) {
            if ((now().measures & reg::kUpperInput) != 0)
                blocked("at_upper_input", true, "The upper end-stop input is on", "TERMINALS", back + ".");
            if ((now().measures & reg::kLowerInput) != 0)
                blocked("at_lower_input", false, "The lower end-stop input is on", "TERMINALS", back + ".");
        }
        if (guarded(kSoftware)) software_stops(back);
        stopped_by();
    }

    void software_stops(const std::string& back) {
        if (now().lower_stop > now().upper_stop) {
            findings_.stops("stops_crossed", "The lower software stop lies above the upper one.",
                            {"LOWER_STOP", "UPPER_STOP"}, "`macreg midi limits LOWER UPPER` sets both.");
            return;
        }
        const std::string wider = back + ", or `macreg midi limits` widens the limits.";
        if (now().position > now().upper_stop)
            blocked("above_upper_stop", true, "It is beyond the upper software stop", "UPPER_STOP", wider);
        if (now().position < now().lower_stop)
            blocked("below_lower_stop", false, "It is beyond the lower software stop", "LOWER_STOP", wider);
    }

    void stopped_by() {
        constexpr std::uint32_t kStopped =
            reg::kAtUpperInput | reg::kAtLowerInput | reg::kAtUpperStop | reg::kAtLowerStop;
        const bool told = std::any_of(findings_.all.begin(), findings_.all.end(), [](const Finding& one) {
            return one.code.ends_with("_input") || one.code.ends_with("_stop");
        });
        if (told || (now().status & kStopped) == 0) return;
        findings_.tells("stopped_by_end_stop",
                        fmt::format("Its last motion was {}.", status_words(now().status & kStopped)),
                        {"STATUS"}, "A motion in the other direction, or inside the limits, is taken.");
    }

    void torque() {
        const std::int64_t raw = now().raw("TORQUE");
        const std::int64_t percent = raw * 100 / std::max<std::int64_t>(condition_.scale.imax, 1);
        if (raw == 0)
            findings_.stops("torque_zero", "The torque is limited to nothing.", {"TORQUE"},
                            "`macreg midi set TORQUE 100%`");
        else if (percent < 20)
            findings_.hinders("torque_small", fmt::format("The torque is limited to {} %.", percent),
                              {"TORQUE"}, "`macreg midi set TORQUE 100%` gives all of it.");
    }

    void following() {
        if (turns()) {
            findings_.tells("moves",
                            fmt::format("It moves: {} in 200 ms.",
                                        at(std::int64_t{now().position} - condition_.before.position)),
                            {"POSITION"}, "`macreg midi stop` stops it.");
            return;
        }
        if (now().busy() && condition_.before.busy())
            findings_.stops(
                "does_not_follow",
                "It wants to move and does not: the shaft is held, or the load is more than the torque.",
                {"TERMINALS", "TORQUE", "SPEED"},
                "Free the shaft, raise TORQUE, or lower SPEED and lengthen RAMP; `macreg midi stop "
                "--emergency` ends the attempt.");
    }

    void hints() {
        const std::int64_t period = now().raw("SPEED");
        const std::int64_t slow =
            condition_.scale.model ? std::int64_t{reg::rpm_times_period(*condition_.scale.model)} : 24'000;
        if (period > slow)
            findings_.hinders("slow",
                              fmt::format("Moves are slow: {}.", speed_text(period, condition_.scale)),
                              {"SPEED"}, "`macreg midi set SPEED 100rpm`, for one.");
        if (!condition_.scale.model) return;
        const auto temperature =
            reg::temperature_of(*condition_.scale.model, static_cast<std::uint8_t>(now().raw("TEMPERATURE")));
        if (temperature >= kWarm)
            findings_.hinders("warm", "It is hot, and switches itself off at 95 C.", {"TEMPERATURE"},
                              "Less TORQUE, longer ramps, pauses, STOP_TORQUE standby, or better cooling.");
    }

    void rest() {
        if (turns()) return;
        findings_.tells("waits",
                        "Nothing keeps it from moving, as far as it tells: no fault, no end-stop, torque and "
                        "supply are there. It waits for an order.",
                        {"STATUS", "POSITION"},
                        "`macreg midi move POSITION` moves it, and switches its power on. An order that it "
                        "refuses is told with the reason.");
    }

    const Condition& condition_;
    BasicFindings<std::string_view> findings_;
};

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
    return Facts(condition).judge();
}

}  // namespace nplc::macreg::midi
