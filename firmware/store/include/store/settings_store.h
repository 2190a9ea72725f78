#pragma once

#include "store/settings.h"
#include "store/slots.h"

namespace nplc::store {

/// Stores the settings in two slots of their own, as a whole.
class SettingsStore {
  public:
    SettingsStore(ports::Storage& storage, const Area& area)
        : slots_(storage, area, Kind::settings, content_) {}

    /// For the start-up. Returns the initial settings if none are stored; `damaged` if some were stored and
    /// none is complete, or bad_setting if they are not this firmware's: the caller then continues with the
    /// initial ones and reports it. Other errors as Slots::mount.
    base::Result<SettingValues> mount();

    /// Begins to store; call poll() until phase() is `done` or `failed`.
    base::Status save(const SettingValues& values);
    void poll();
    base::Instant next_poll(base::Instant now);

    Phase phase() const { return slots_.phase(); }
    base::Error error() const { return slots_.error(); }
    const Slots& slots() const { return slots_; }

  private:
    AnyContent content_;
    Slots slots_;
    std::array<std::uint8_t, kMaxSettingsBytes> bytes_;
};

}  // namespace nplc::store
