#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/result.h"
#include "registers/settings.h"

/// The values of the gateway's settings, as they are stored.
namespace nplc::store {

using registers::gateway::is_setting;
using registers::gateway::kSettings;
using registers::gateway::Setting;

/// A value for every setting, waits_for_run included; always an allowed one.
class SettingValues {
  public:
    SettingValues();
    std::uint32_t get(Setting setting) const { return values_[index(setting)]; }
    bool is_on(Setting setting) const { return get(setting) != 0; }
    /// Error bad_setting: nothing has changed.
    base::Status set(Setting setting, std::uint32_t value);
    bool operator==(const SettingValues&) const = default;

  private:
    static std::size_t index(Setting setting) { return static_cast<std::size_t>(setting); }
    std::array<std::uint32_t, kSettings + 1> values_{};  ///< by number, waits_for_run first
};

/// Stored as records of the setting's number and its 4-byte value, little-endian.
inline constexpr std::size_t kSettingBytes = 5;
inline constexpr std::size_t kMaxSettingsBytes = (kSettings + 1) * kSettingBytes;
void encode(const SettingValues& values, std::span<std::uint8_t, kMaxSettingsBytes> bytes);
/// Settings without a record have their initial value; records of settings that this firmware does not know
/// are left out. Error: bad_setting (a value that is not allowed, or bytes that are no whole records).
base::Result<SettingValues> decode_settings(std::span<const std::uint8_t> bytes);

}  // namespace nplc::store
