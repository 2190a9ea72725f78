#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

/// The numbers of the gateway's settings, for storing and for access over the user port.
namespace nplc::registers::gateway {

/// The numbers are stored and must not change.
enum class Setting : std::uint8_t {
    /// Not a setting of the user, and in no list: the SafeReason that prevents an automatic start until run
    /// is commanded; then `none`, initially `not_started`.
    waits_for_run = 0,
    gateway_address = 1,
    user_baud = 2,
    motor_baud = 3,
    autostart = 4,
    on_start = 5,
    safe_outputs = 6,
    debounce = 7,
    longest_wait = 8,
    enable_input = 9,
    motor_writes = 10,
    virtual_motor = 11,
    force_timeout = 12,
    status_output = 13,
    motor_address = 14,
    motor_is_mac800 = 15,
    safe_communication = 16,
    old_register_codes = 17,
    read_pause = 18,
    motor_silence = 19,
    motor_kind = 20,
    midi_address = 21,
    require_proof = 22,
    poll_limit = 23,
};

/// `none` in enable_input and status_output.
inline constexpr std::uint32_t kNone = 255;

struct SettingInfo {
    Setting id;
    std::string_view name;
    std::string_view unit;  ///< empty: a number, or a choice described in `help`
    std::uint32_t initial;
    std::uint32_t lowest;
    std::uint32_t highest;
    bool has_none;  ///< kNone is allowed too
    bool at_reset;  ///< takes effect at the next reset, if kept
    std::string_view help;
};

inline constexpr std::size_t kSettings = 23;
const std::array<SettingInfo, kSettings>& all_settings();
/// nullptr if there is none.
const SettingInfo* find_setting(std::uint8_t id);
/// Standard baud rates: 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200, 230400, 460800 and 921600.
bool is_standard_rate(std::uint32_t baud);
/// Of the user's.
bool is_setting(std::uint8_t id);
std::uint32_t initial_value(Setting setting);
/// Also false for an unknown setting.
bool is_allowed(Setting setting, std::uint32_t value);

}  // namespace nplc::registers::gateway
