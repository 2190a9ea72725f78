#include "bare_metal/run.h"

#include <cstring>
#include <new>
#include <utility>

#include "bare_metal/fault_reset.h"
#include "gateway/controller.h"
#include "hal_mcu/cortex_m/core.h"
#include "motor/any_driver.h"

namespace nplc::bare_metal {
namespace {

namespace core = hal_mcu::cortex_m;
using hal_mcu::EndCause;

constexpr base::Milliseconds kBeyondLongestWait{500};  ///< watchdog timeout beyond a scan's longest wait
/// Reading two slots of the store and loading one takes 0.7 s at most over a serial memory's line.
constexpr base::Milliseconds kStartUp{3'000};

/// If the previous run was not ended by the firmware, the cause was the watchdog's second timeout or a reset
/// that looks the same.
gateway::StartCause start_cause(bool for_service) {
    const bool bitten = take_watchdog_reset() || run_marker().is_set();
    if (bitten && !crash_record().valid()) crash_record().set(EndCause::unrecorded, 0);
    run_marker().set();
    if (for_service) return gateway::StartCause::service;
    return crash_record().valid() ? gateway::StartCause::watchdog : gateway::StartCause::power_up;
}

void note_crash(gateway::Gateway& sequence, gateway::SettingsManager& settings) {
    const bool has_crashed = crash_record().valid();
    const auto cause = static_cast<std::uint16_t>(crash_record().cause());
    const auto address = static_cast<std::uint16_t>(crash_record().code_address());
    settings.keep_mark(has_crashed);
    if (!has_crashed) return;
    sequence.note(gateway::Event::crashed, cause);
    sequence.note(gateway::Event::crashed_at, address);
    crash_record().clear();
}

/// Longer than a scan's longest wait for the motor, which is a setting.
base::Milliseconds watchdog_time(const gateway::SettingsManager& settings) {
    return base::Milliseconds(settings.get(store::Setting::longest_wait)) + kBeyondLongestWait;
}

/// Sleeps until an interrupt; a millisecond at the most.
void rest() {
    core::forbid_interrupts();
    if (!has_received()) core::sleep();
    core::allow_interrupts();
}

/// Waits until the answer to the reset command has been sent, with a timeout.
[[noreturn]] void restart(const Parts& parts) {
    constexpr base::Milliseconds kLongestAnswer{20};
    const base::Instant asked = parts.clock.now();
    while (!parts.user_line->transmitter_idle() && parts.clock.now() - asked < kLongestAnswer) rest();
    run_marker().clear();
    core::reset();
}

/// Memory of an object that is constructed at the start and never destroyed. Cleared before construction, so
/// that members initialized with 0 need no code.
template <class T>
union StartedObject {
    constexpr StartedObject() {}
    ~StartedObject() {}  // NOLINT: never called: the firmware does not end
    template <class... Arguments>
    T& make(Arguments&&... arguments) {
        std::memset(static_cast<void*>(this), 0, sizeof(*this));
        return *::new (&object) T(std::forward<Arguments>(arguments)...);
    }
    T object;
};

StartedObject<gateway::SettingsManager> settings_memory;
StartedObject<gateway::Controller> controller_memory;
StartedObject<motor::AnyDriver> driver_memory;

// Not inlined, so that their stack is not part of the main loop.

[[gnu::noinline]] gateway::SettingsManager& read_settings(const Parts& parts) {
    gateway::SettingsManager& settings = settings_memory.make(parts.storage, parts.settings_area);
    settings.start({});
    return settings;
}

[[gnu::noinline]] gateway::Controller& start(const Parts& parts, gateway::SettingsManager& settings) {
    motor::Motor& drive = driver_memory.make().start({.serial = &parts.motor_line},
                                                     gateway::driver_settings_of(settings.values()));
    const gateway::Controller::Ports ports{
        .inputs = parts.inputs,
        .outputs = parts.outputs,
        .watchdog = parts.watchdog,
        .motor = drive,
        .storage = parts.storage,
        .user_line = parts.user_line,
        .motor_mactalk_line = parts.motor_mactalk_line,
        .shown_lines = {parts.user_line, &parts.motor_line, parts.motor_mactalk_line},
        .set_points = parts.set_point_area};
    gateway::Controller& controller = controller_memory.make(ports, parts.table_area, parts.table, settings,
                                                             start_cause(parts.for_service));
    if constexpr (gateway::FirmwarePart::kIsThere)
        controller.registers().firmware().attach(firmware_receiver());
    note_crash(controller.sequence(), settings);
    controller.tables().start(parts.clock.now());
    return controller;
}

}  // namespace

void run(const Parts& parts) {
    gateway::SettingsManager& settings = read_settings(parts);
    begin_lines(settings.get(store::Setting::user_baud), settings.get(store::Setting::motor_baud));
    base::Milliseconds bites_after = kStartUp;
    begin_watchdog(bites_after);
    gateway::Controller& controller = start(parts, settings);

    for (;;) {
        controller.poll(parts.clock.now());
        keep_safe_outputs(controller.sequence().settings().safe_outputs);
        if (watchdog_time(settings) != bites_after) set_watchdog_time(bites_after = watchdog_time(settings));
        if (controller.reset_asked()) restart(parts);
        rest();
    }
}

}  // namespace nplc::bare_metal
