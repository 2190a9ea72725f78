#pragma once

#include "gateway/command_result.h"
#include "gateway/gateway.h"
#include "motor/driver.h"
#include "store/settings_store.h"

namespace nplc::gateway {

/// A gateway's settings among those that are stored, and back.
Settings settings_of(const store::SettingValues& values);
store::SettingValues values_of(const Settings& settings);
/// Those of the drive and the line to it, which take hold at a reset.
motor::DriverSettings driver_settings_of(const store::SettingValues& values);

/// The settings in force and the stored ones.
class SettingsManager {
  public:
    SettingsManager(ports::Storage& storage, const store::Area& area) : store_(storage, area) {}

    /// For the start-up, before there is a Gateway: the stored settings, or `initial` if there are none.
    void start(const store::SettingValues& initial);
    /// After it: a setting that the board's wiring decides, whatever is stored. Needs an allowed value.
    void impose(store::Setting setting, std::uint32_t value);
    /// Whom settings written from now on are for; it has the present ones already.
    void attach(Gateway& gateway);

    const store::SettingValues& values() const { return values_; }
    std::uint32_t get(store::Setting setting) const { return values_.get(setting); }
    /// As it was at the start: for addresses and the lines' settings, which take hold at a reset.
    std::uint32_t at_start(store::Setting setting) const { return at_start_.get(setting); }
    /// All below need attach(). Only while stopped; not 255 or the motor's address for the gateway.
    Result set(std::uint8_t id, std::uint32_t value);

    /// Of the same values that are being stored it is the same saving: who did not wait for its end asks
    /// again.
    void begin_save();
    /// Without a result until the storage has taken or refused them, however slow it is.
    Progress poll_save() const;
    void poll();
    base::Instant next_poll(base::Instant now) { return store_.next_poll(now); }
    bool differ() const { return values_ != stored_; }
    bool were_damaged() const { return damaged_; }

  private:
    Gateway* gateway_ = nullptr;
    base::Status begun_;
    bool is_saving_ = false;
    bool damaged_ = false;
    store::SettingValues values_;
    store::SettingValues at_start_;
    store::SettingValues stored_;
    store::SettingValues saving_;
    store::SettingsStore store_;
};

}  // namespace nplc::gateway
