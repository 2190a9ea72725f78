#include "store/settings.h"

#include "base/bytes.h"

namespace nplc::store {

SettingValues::SettingValues() {
    for (std::size_t i = 0; i < values_.size(); ++i)
        values_[i] = registers::gateway::initial_value(static_cast<Setting>(i));
}

base::Status SettingValues::set(Setting setting, std::uint32_t value) {
    if (!registers::gateway::is_allowed(setting, value)) return base::Error::bad_setting;
    values_[index(setting)] = value;
    return {};
}

void encode(const SettingValues& values, std::span<std::uint8_t, kMaxSettingsBytes> bytes) {
    for (std::size_t i = 0; i <= kSettings; ++i) {
        const auto id = static_cast<std::uint8_t>(i);
        bytes[i * kSettingBytes] = id;
        base::store_u32(&bytes[i * kSettingBytes + 1], values.get(Setting{id}));
    }
}

base::Result<SettingValues> decode_settings(std::span<const std::uint8_t> bytes) {
    SettingValues values;
    for (; bytes.size() >= kSettingBytes; bytes = bytes.subspan(kSettingBytes)) {
        if (bytes[0] > kSettings) continue;
        const auto status = values.set(static_cast<Setting>(bytes[0]), base::load_u32(&bytes[1]));
        if (!status) return status.error();
    }
    if (!bytes.empty()) return base::Error::bad_setting;
    return values;
}

}  // namespace nplc::store
