#pragma once

#include "gateway/command_result.h"
#include "gateway/gateway.h"
#include "motor/driver.h"
#include "store/settings_store.h"

namespace nplc::gateway {

/// A gateway's settings, taken from the stored settings, and back.
Settings settings_of(const store::SettingValues& values);
store::SettingValues values_of(const Settings& settings);
/// The settings of the drive and its line, which take effect at a reset.
motor::DriverSettings driver_settings_of(const store::SettingValues& values);

/// The settings in force and the stored ones.
class SettingsManager {
  public:
    SettingsManager(ports::Storage& storage, const store::Area& area) : store_(storage, area) {}

    /// For the start-up, before the Gateway exists: takes the stored settings, or `initial` if there are
    /// none.
    void start(const store::SettingValues& initial);
    /// After start(): sets a setting that the board's wiring determines, whatever is stored. Needs an allowed
    /// value.
    void impose(store::Setting setting, std::uint32_t value);
    /// The gateway that later changes are applied to; it already has the present settings.
    void attach(Gateway& gateway);

    const store::SettingValues& values() const { return values_; }
    std::uint32_t get(store::Setting setting) const { return values_.get(setting); }
    /// The value at the start: for addresses and line settings, which take effect at a reset.
    std::uint32_t at_start(store::Setting setting) const { return at_start_.get(setting); }
    /// All functions below need attach(). Only while stopped; the gateway's address must not be 255 or the
    /// motor's.
    Result set(std::uint8_t id, std::uint32_t value);

    /// Does nothing if the same values are already being saved, so a client that stopped waiting may repeat
    /// it.
    void begin_save();
    /// Empty until the storage has accepted or refused the values, however slow it is.
    PendingResult poll_save() const;
    void poll();
    base::Instant next_poll(base::Instant now) { return store_.next_poll(now); }
    /// For boards that store the mark of a run with the settings; after attach(), before a table is loaded.
    /// Without the mark the gateway waits for run(); after a crash the mark is cleared, in the store too.
    void keep_mark(bool is_after_crash);
    /// On such a board: run was commanded. Stores the mark, but no settings that were not saved.
    void begin_mark();

    bool differ() const { return values_ != stored_; }
    bool were_damaged() const { return damaged_; }

  private:
    void begin_saving();
    void store_wait(SafeReason reason);
    SafeReason stored_wait() const {
        return static_cast<SafeReason>(stored_.get(store::Setting::waits_for_run));
    }

    Gateway* gateway_ = nullptr;
    base::Status begun_;
    bool is_saving_ = false;
    bool keeps_mark_ = false;
    bool damaged_ = false;
    store::SettingValues values_;
    store::SettingValues at_start_;
    store::SettingValues stored_;
    store::SettingValues saving_;
    store::SettingsStore store_;
};

}  // namespace nplc::gateway
