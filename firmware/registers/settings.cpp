#include "registers/settings.h"

#include "registers/vocabulary.h"

namespace nplc::registers::gateway {
namespace {

// R: not in the manuals; the ranges are the firmware's limits.
constexpr std::array<SettingInfo, kSettings> kAll{{
    {Setting::gateway_address, "gateway_address", "", 128, 1, 253, false, true,
     "address on the user's port from the next reset on, if kept"},
    {Setting::user_baud, "user_baud", "Bd", 19'200, 1'200, 921'600, false, true,
     "speed of the user's port, a standard one, from the next reset on if kept"},
    {Setting::motor_baud, "motor_baud", "Bd", 19'200, 1'200, 921'600, false, true,
     "speed of the line to the motor, a standard one, from the next reset on if kept"},
    {Setting::autostart, "autostart", "", 1, 0, 1, false, false,
     "1: the table runs from power-up, 0: it waits for a command"},
    {Setting::on_start, "on_start", "", 0, 0, 1, false, false,
     "0: the motor is stopped before the first scan, 1: left as it is"},
    {Setting::safe_outputs, "safe_outputs", "", 0, 0, 15, false, false,
     "outputs in the safe state, bit 0 = OUT0"},
    {Setting::debounce, "debounce", "us", 3'000, 0, 1'000'000, false, false,
     "an input counts once it is steady so long"},
    {Setting::longest_wait, "longest_wait", "ms", 1'000, 1, 60'000, false, false,
     "of a scan for the motor, then the safe state"},
    {Setting::enable_input, "enable_input", "", kNone, 0, 5, true, false,
     "input that must be on to run; 255: none"},
    {Setting::motor_writes, "motor_writes", "", 0, 0, 2, false, false,
     "while the sequence runs the user may 1: write motor registers, 2: send 54h to 57h too"},
    {Setting::virtual_motor, "virtual_motor", "", 0, 0, 1, false, false,
     "1: the motor is virtual; holding does not stop it"},
    {Setting::force_timeout, "force_timeout", "ms", 5'000, 100, 60'000, false, false,
     "forcing ends after so long a silence"},
    {Setting::status_output, "status_output", "", kNone, 0, 3, true, false,
     "output that shows the gateway's state; 255: none"},
    {Setting::motor_address, "motor_address", "", 254, 1, 254, false, true,
     "the motor's address on the user's port, beside 255, from the next reset on if kept"},
    {Setting::motor_is_mac800, "motor_is_mac800", "", 0, 0, 1, false, true,
     "1: the motor is a MAC800, whose registers have 32 bits; from the next reset on if kept"},
    {Setting::safe_communication, "safe_communication", "", 1, 0, 1, false, true,
     "1: the line to the motor uses safe communication; from the next reset on if kept"},
    {Setting::old_register_codes, "old_register_codes", "", 0, 0, 1, false, true,
     "1: the motor has the older FlexMAC register codes; from the next reset on if kept"},
    {Setting::read_pause, "read_pause", "ms", 20, 0, 1'000, false, false,
     "least time between two reads of the motor for the user while the sequence runs"},
    {Setting::motor_silence, "motor_silence", "ms", 20, 20, 200, false, true,
     "silence of the motor that is a lost link; from the next reset on if kept"},
    {Setting::motor_kind, "motor_kind", "", 0, 0, 3, false, true,
     "0: a JVL motor, 1: MIDI's MAC23, 2: MAC34-1, 3: MAC34-2; from the next reset on if kept"},
    {Setting::midi_address, "midi_address", "", 0, 0, 127, false, true,
     "a MIDI drive's address on its V24 line; from the next reset on if kept"},
    {Setting::require_proof, "require_proof", "", 0, 0, 1, false, false,
     "1: a table starts only if it was uploaded with a certificate of seqc verify"},
    {Setting::poll_limit, "poll_limit", "us", 5'000, 1'000, 1'000'000, false, false,
     "a poll so much later than due, while the sequence is not stopped, is an event"},
}};

/// What the firmware needs of a setting, in six bytes: a board that shows no names has none in its memory.
struct Rule {
    static constexpr std::uint16_t kInSixteens = 0x8000;  ///< in `low`: so is `high`

    std::uint16_t high;
    std::uint16_t low;
    std::uint16_t initial;
    constexpr std::uint32_t highest() const {
        return (low & kInSixteens) != 0 ? std::uint32_t{high} * 16 : high;
    }
    constexpr std::uint32_t lowest() const { return low & (kInSixteens - 1U); }
    /// Those that can be none are so initially.
    constexpr bool allows(std::uint32_t value) const {
        return (value >= lowest() && value <= highest()) || value == initial;
    }
};

/// By number; of waits_for_run first.
constexpr std::array<Rule, kSettings + 1> kRules = [] {
    std::array<Rule, kSettings + 1> rules{};
    rules[0].high = static_cast<std::uint16_t>(SafeReason::watchdog);
    rules[0].initial = static_cast<std::uint16_t>(SafeReason::not_started);
    for (std::size_t i = 0; i < kAll.size(); ++i) {
        const bool in_sixteens = kAll[i].highest > UINT16_MAX;
        rules[i + 1] = {static_cast<std::uint16_t>(kAll[i].highest / (in_sixteens ? 16 : 1)),
                        static_cast<std::uint16_t>(kAll[i].lowest | (in_sixteens ? Rule::kInSixteens : 0U)),
                        static_cast<std::uint16_t>(kAll[i].initial)};
    }
    return rules;
}();

constexpr bool rules_say_all() {
    for (std::size_t i = 0; i < kAll.size(); ++i) {
        const Rule& rule = kRules[i + 1];
        if (rule.lowest() != kAll[i].lowest || rule.highest() != kAll[i].highest ||
            rule.initial != kAll[i].initial)
            return false;
        if (kAll[i].has_none != (rule.initial == kNone) ||
            (!kAll[i].has_none && rule.initial < rule.lowest()))
            return false;
    }
    return true;
}
static_assert(rules_say_all());

constexpr bool is_rate(Setting setting) {
    return setting == Setting::user_baud || setting == Setting::motor_baud;
}

}  // namespace

const std::array<SettingInfo, kSettings>& all_settings() {
    return kAll;
}

const SettingInfo* find_setting(std::uint8_t id) {
    return is_setting(id) ? &kAll[id - 1U] : nullptr;
}

bool is_standard_rate(std::uint32_t baud) {
    std::uint32_t rate = 1'200;
    while (rate < baud && rate < 921'600) rate = rate == 38'400 ? 57'600 : 2 * rate;
    return rate == baud;
}

bool is_setting(std::uint8_t id) {
    return id >= 1 && id <= kSettings;
}

bool is_allowed(Setting setting, std::uint32_t value) {
    const auto id = static_cast<std::uint8_t>(setting);
    if (id > kSettings || (is_rate(setting) && !is_standard_rate(value))) return false;
    return kRules[id].allows(value);
}

std::uint32_t initial_value(Setting setting) {
    return kRules[static_cast<std::size_t>(setting)].initial;
}

}  // namespace nplc::registers::gateway
