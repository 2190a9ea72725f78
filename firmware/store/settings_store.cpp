#include "store/settings_store.h"

#include "base/crc32.h"

namespace nplc::store {

base::Result<SettingValues> SettingsStore::mount() {
    if (const auto status = slots_.mount(); !status) return status.error();
    if (!slots_.has_current()) {
        if (slots_.is_fallback()) return base::Error::damaged;
        return SettingValues{};
    }
    // May have been stored by a firmware with more settings.
    std::array<std::uint8_t, 2 * kMaxSettingsBytes> bytes{};
    const auto length = slots_.load(bytes);
    if (!length) return length.error();
    return decode_settings(std::span(bytes).first(length.value()));
}

base::Status SettingsStore::save(const SettingValues& values) {
    encode(values, bytes_);
    return slots_.begin();
}

base::Instant SettingsStore::next_poll(base::Instant now) {
    return slots_.phase() == Phase::receiving ? now : slots_.next_poll(now);
}

void SettingsStore::poll() {
    slots_.poll();
    if (slots_.phase() != Phase::receiving) return;
    if (slots_.received() == 0) {
        static_cast<void>(slots_.write(0, bytes_));
    } else {
        static_cast<void>(slots_.finish(static_cast<std::uint32_t>(bytes_.size()), base::crc32(bytes_)));
    }
}

}  // namespace nplc::store
