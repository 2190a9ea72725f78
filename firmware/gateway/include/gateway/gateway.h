#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/result.h"
#include "base/time.h"
#include "gateway/debouncer.h"
#include "gateway/observer.h"
#include "motor/motor.h"
#include "ports/digital_io.h"
#include "ports/watchdog.h"
#include "sequencer/engine.h"

namespace nplc::gateway {

enum class OnStart : std::uint8_t {
    stop,  ///< the motor is told to stop (INIT) before the first scan
    keep,  ///< the motor is left as it is found
};

struct Settings {
    std::uint8_t safe_outputs = 0;  ///< levels in the safe state and before the first scan
    OnStart on_start = OnStart::stop;
    bool autostart = true;  ///< run() is not needed after a power-up with a good table
    std::optional<std::uint8_t>
        enable_input{};  ///< input 0..5 that must be 1 to run; losing it is a safe state
    /// An input counts once it has been steady for this long. Over 9 ms the safe state takes more than 10 ms
    /// from the loss of the enable input.
    base::Microseconds debounce{3'000};
    base::Microseconds longest_wait{1'000'000};  ///< of a scan for the motor to take or finish its orders
};

enum class StartCause : std::uint8_t { power_up, watchdog };

enum class RunState : std::uint8_t {
    stopped,            ///< no table, not started, or in the safe state after a reason that needs run() again
    waiting_for_motor,  ///< started; the link is not up yet, or the motor has not yet taken the stop order
    running,
};

/// Why the outputs have their safe values (and, where the line works, the motor was told to stop).
enum class SafeReason : std::uint8_t {
    none,
    not_started,
    stop_command,
    link_down,    ///< ends when the link is up again and the sequence has sent "reset error"
    motor_stuck,  ///< a scan waited longer than Settings::longest_wait
    bad_table,
    watchdog,
    enable_lost,
};

/// The loop of the NanoPLC (001 §6.1.9) on ports: debounced inputs, scan, orders, outputs, timer. `poll`
/// never blocks; a scan that waits for the motor goes on at a later poll.
///
/// Outputs have their safe values from construction to the end of the first scan and whenever safe_reason()
/// is not `none`. Whatever stops the sequence other than link_down needs run() to start it again, from step
/// 0.
class Gateway {
  public:
    struct Ports {
        ports::DigitalInputs& inputs;
        ports::DigitalOutputs& outputs;
        ports::Watchdog& watchdog;
        motor::Motor& motor;
    };

    Gateway(const Ports& ports, const Settings& settings, StartCause cause);
    Gateway(const Gateway&) = delete;
    Gateway& operator=(const Gateway&) = delete;

    /// Makes a table the current one; only while stopped, and only if the motor has all its orders (else
    /// not_for_motor). The bytes must stay where they are. On a fault the
    /// safe state is entered with bad_table, and nothing can run until a good table is loaded.
    sequencer::Table::LoadResult load(std::span<const std::uint8_t> bytes, base::Instant now);

    /// Errors: no_table; not_stopped when it runs already.
    base::Status run();
    void stop(base::Instant now) { enter_safe_state(SafeReason::stop_command, now); }

    /// To be called at least once a millisecond.
    void poll(base::Instant now);

    void observe(Observer* observer) { observer_ = observer; }

    RunState run_state() const { return run_state_; }
    SafeReason safe_reason() const { return safe_reason_; }
    base::Instant safe_since() const { return safe_since_; }  ///< when safe_reason() took hold
    const sequencer::State& state() const { return engine_.state(); }
    sequencer::InputImage image() const { return image_; }  ///< HW_INP of the last scan
    std::uint32_t scans() const {
        return scans_;
    }  ///< finished, those skipped because nothing could change included

  private:
    void enter_safe_state(SafeReason reason, base::Instant now);
    void set_safe_reason(SafeReason reason, base::Instant now);
    sequencer::Table::LoadResult checked_for_motor(const sequencer::Table::LoadResult& loaded) const;
    void start_when_ready(base::Instant now);
    void watch_link(base::Instant now);
    bool enabled() const;
    void work(base::Instant now);
    bool begin_scan(base::Instant now);
    bool send_orders(base::Instant now);
    void finish_scan(base::Instant now);
    void count_timer(base::Instant now);
    void write_outputs(std::uint8_t levels);

    Ports ports_;
    Settings settings_;
    sequencer::Table table_;
    sequencer::Engine engine_{table_};
    Debouncer debouncer_;
    Observer* observer_ = nullptr;

    RunState run_state_ = RunState::stopped;
    SafeReason safe_reason_ = SafeReason::not_started;
    base::Instant safe_since_{};
    bool autostart_;
    bool stop_ordered_ = false;     ///< since run()
    bool stop_after_loss_ = false;  ///< the motor is to be stopped once the link delivers again

    bool in_scan_ = false;
    std::optional<sequencer::MotorOrder> held_;  ///< order that found no room
    sequencer::State before_;                    ///< as the scan under way found it
    base::Instant progress_{};                   ///< last time a scan did not have to wait
    base::Instant ticked_{};                     ///< the timer has been counted up to here
    sequencer::InputImage image_ = 0;
    std::optional<sequencer::Key> quiet_key_;  ///< a scan with this key would do nothing
    std::uint32_t scans_ = 0;
    std::optional<std::uint8_t> written_;
};

}  // namespace nplc::gateway
