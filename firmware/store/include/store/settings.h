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

/// A value for every setting, always an allowed one.
class SettingValues {
  public:
    SettingValues();
    std::uint32_t get(Setting setting) const { return values_[index(setting)]; }
    bool is_on(Setting setting) const { return get(setting) != 0; }
    /// Error bad_setting: nothing has changed.
    base::Status set(Setting setting, std::uint32_t value);
    bool operator==(const SettingValues&) const = default;

  private:
    static std::size_t index(Setting setting) { return static_cast<std::size_t>(setting) - 1; }
    std::array<std::uint32_t, kSettings> values_{};
};

/// Stored as records of the setting's number and its 4-byte value, little-endian.
inline constexpr std::size_t kSettingBytes = 5;
inline constexpr std::size_t kMaxSettingsBytes = kSettings * kSettingBytes;
std::array<std::uint8_t, kMaxSettingsBytes> encode(const SettingValues& values);
/// Settings without a record get their initial value; records of unknown settings are ignored. Error:
/// bad_setting (a value that is not allowed, or incomplete records).
base::Result<SettingValues> decode_settings(std::span<const std::uint8_t> bytes);

}  // namespace nplc::store
