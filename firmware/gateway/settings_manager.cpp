#include "gateway/settings_manager.h"

namespace nplc::gateway {

using store::Setting;

namespace {

std::optional<std::uint8_t> pin(const store::SettingValues& values, Setting setting) {
    const std::uint32_t value = values.get(setting);
    if (value == registers::gateway::kNone) return std::nullopt;
    return static_cast<std::uint8_t>(value);
}

std::uint32_t number(std::optional<std::uint8_t> pin) {
    return pin ? *pin : registers::gateway::kNone;
}

base::Milliseconds milliseconds(const store::SettingValues& values, Setting setting) {
    return base::Milliseconds(values.get(setting));
}

std::uint32_t in_milliseconds(base::Microseconds time) {
    return static_cast<std::uint32_t>(time.count()) / 1000U;
}

}  // namespace

Settings settings_of(const store::SettingValues& values) {
    return {.safe_outputs = static_cast<std::uint8_t>(values.get(Setting::safe_outputs)),
            .on_start = values.is_on(Setting::on_start) ? OnStart::keep : OnStart::stop,
            .autostart = values.is_on(Setting::autostart),
            .enable_input = pin(values, Setting::enable_input),
            .debounce = base::Microseconds(values.get(Setting::debounce)),
            .longest_wait = milliseconds(values, Setting::longest_wait),
            .virtual_motor = values.is_on(Setting::virtual_motor),
            .force_time = milliseconds(values, Setting::force_timeout),
            .status_output = pin(values, Setting::status_output),
            .require_proof = values.is_on(Setting::require_proof),
            .poll_limit = values.get(Setting::poll_limit)};
}

store::SettingValues values_of(const Settings& settings) {
    store::SettingValues values;
    const auto set = [&values](Setting setting, std::uint32_t value) {
        static_cast<void>(values.set(setting, value));
    };
    set(Setting::safe_outputs, settings.safe_outputs);
    set(Setting::on_start, settings.on_start == OnStart::keep ? 1 : 0);
    set(Setting::autostart, settings.autostart ? 1 : 0);
    set(Setting::enable_input, number(settings.enable_input));
    set(Setting::debounce, static_cast<std::uint32_t>(settings.debounce.count()));
    set(Setting::longest_wait, in_milliseconds(settings.longest_wait));
    set(Setting::virtual_motor, settings.virtual_motor ? 1 : 0);
    set(Setting::force_timeout, in_milliseconds(settings.force_time));
    set(Setting::status_output, number(settings.status_output));
    set(Setting::require_proof, settings.require_proof ? 1 : 0);
    set(Setting::poll_limit, settings.poll_limit);
    return values;
}

motor::DriverSettings driver_settings_of(const store::SettingValues& values) {
    return {.baud = values.get(Setting::motor_baud),
            .silence = milliseconds(values, Setting::motor_silence),
            .motor_kind = static_cast<std::uint8_t>(values.get(Setting::motor_kind)),
            .address = static_cast<std::uint8_t>(values.get(Setting::midi_address)),
            .is_mac800 = values.is_on(Setting::motor_is_mac800),
            .safe_communication = values.is_on(Setting::safe_communication),
            .old_register_codes = values.is_on(Setting::old_register_codes)};
}

void SettingsManager::start(const store::SettingValues& initial) {
    values_ = initial;
    const auto mounted = store_.mount();
    damaged_ = !mounted || store_.slots().is_fallback();
    if (mounted && store_.slots().has_current()) values_ = mounted.value();
    stored_ = at_start_ = values_;
}

void SettingsManager::impose(Setting setting, std::uint32_t value) {
    for (store::SettingValues* values : {&values_, &at_start_, &stored_})
        static_cast<void>(values->set(setting, value));
}

void SettingsManager::attach(Gateway& gateway) {
    gateway_ = &gateway;
    if (!damaged_) return;
    gateway.note(Event::store_damaged);
    gateway.lock(SafeReason::bad_settings);
}

Result SettingsManager::set(std::uint8_t id, std::uint32_t value) {
    if (!registers::gateway::is_setting(id)) return Result::no_register;
    if (gateway_->run_state() != RunState::stopped) return Result::not_stopped;
    const std::uint32_t before = values_.get(Setting{id});
    if (!values_.set(Setting{id}, value)) return Result::bad_value;
    if (values_.get(Setting::gateway_address) == values_.get(Setting::motor_address)) {
        static_cast<void>(values_.set(Setting{id}, before));
        return Result::bad_value;
    }
    static_cast<void>(gateway_->change(settings_of(values_)));
    return Result::done;
}

void SettingsManager::begin_save() {
    if (is_saving_ && saving_ == values_) return;
    saving_ = values_;
    begin_saving();
}

void SettingsManager::begin_saving() {
    begun_ = store_.save(saving_);
    is_saving_ = begun_.ok();
}

/// Changes that are already being stored are stored with it. Damaged settings are replaced only when the user
/// saves.
void SettingsManager::store_wait(SafeReason reason) {
    if (damaged_) return;
    if (!is_saving_) saving_ = stored_;
    for (store::SettingValues* values : {&saving_, &values_})
        static_cast<void>(values->set(Setting::waits_for_run, static_cast<std::uint32_t>(reason)));
    begin_saving();
}

void SettingsManager::keep_mark(bool is_after_crash) {
    keeps_mark_ = true;
    const SafeReason reason = is_after_crash ? SafeReason::watchdog : stored_wait();
    if (reason == SafeReason::none) return;
    gateway_->wait_for_mark(reason);
    if (reason != stored_wait()) store_wait(reason);
}

void SettingsManager::begin_mark() {
    if (keeps_mark_) store_wait(SafeReason::none);
}

PendingResult SettingsManager::poll_save() const {
    if (!begun_) return CommandResult{result_of(begun_.error())};
    if (is_saving_) return std::nullopt;
    if (store_.phase() == store::Phase::failed) return CommandResult{result_of(store_.error())};
    return CommandResult{};
}

void SettingsManager::poll() {
    store_.poll();
    if (!is_saving_ || store_.phase() < store::Phase::done) return;
    is_saving_ = false;
    if (store_.phase() == store::Phase::failed) return gateway_->refuse_run_mark();
    stored_ = saving_;
    damaged_ = false;
    if (stored_wait() == SafeReason::none) gateway_->mark_run();
    gateway_->unlock(SafeReason::bad_settings);
    gateway_->note(Event::settings_kept);
}

}  // namespace nplc::gateway
