#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/result.h"
#include "base/time.h"
#include "gateway/event_log.h"
#include "gateway/hold_control.h"
#include "gateway/poll_watch.h"
#include "gateway/safe_state.h"
#include "gateway/sequence_scan.h"
#include "gateway/signals.h"
#include "motor/motor.h"
#include "ports/digital_io.h"
#include "ports/watchdog.h"

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
        enable_input{};  ///< input 0..5 that must be 1 to start and to run; losing it is a safe state
    /// An input counts once it has been steady for this long; the loss of the enable input after 9 ms at the
    /// most.
    base::Microseconds debounce{3'000};
    base::Microseconds longest_wait{1'000'000};   ///< of a scan for the motor to take or finish its orders
    bool virtual_motor = false;                   ///< holding the sequence does not stop the motor
    base::Microseconds force_time{5'000'000};     ///< forced signals end when nobody renews them for so long
    std::optional<std::uint8_t> status_output{};  ///< output 0..3 that shows status_light()
    bool require_proof = false;                   ///< a table without a certificate does not start
    /// us; while the sequence is not stopped, a poll that comes so much later than due is an event.
    std::uint32_t poll_limit = 5'000;
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

    struct LoadResult {
        bool ok = false;
        sequencer::TableFault fault{};  ///< when not ok
    };

    Gateway(const Ports& ports, const Settings& settings, StartCause cause);
    Gateway(const Gateway&) = delete;
    Gateway& operator=(const Gateway&) = delete;

    /// Makes a table the current one; only while stopped, and only if the motor has all its orders (else
    /// not_for_motor). The bytes must stay where they are. On a fault the
    /// safe state is entered with bad_table, and nothing can run until a good table is loaded. `proven`: it
    /// came with a certificate.
    LoadResult load(std::span<const std::uint8_t> bytes, base::Instant now, bool proven = false);

    /// The start-up is over: no table starts by itself any more.
    void end_start_up() { permission_.end_start_up(); }
    /// In the start-up: nothing starts by itself, and `reason` is shown until run().
    void block_start(SafeReason reason);
    /// The same, for a store with which nobody has commanded run yet: until run() it waits_for_first_run().
    void wait_for_first_run();
    bool waits_for_first_run() const { return waits_for_first_run_; }
    /// The same, and until unlock() run() is refused with not_enabled and no other reason is shown.
    void lock(SafeReason reason);
    void unlock(SafeReason reason);

    /// The board cannot do without what it lost: the safe state, and not enabled until the next start.
    void withdraw(SafeReason reason, base::Instant now);

    /// Has the motor the order of this term, if it has one?
    bool motor_takes(sequencer::TermView term) const { return scan_.motor_takes(term); }

    /// From the beginning, or on from where it is held, the motor in the mode that it was stopped in; without
    /// hold if has_single(). Errors: no_table; not_stopped when it runs already; not_enabled: from the
    /// beginning only with the enable input on, so that closing a guard starts nothing, and not while locked;
    /// cannot_go_on; stop_unconfirmed.
    base::Status run();
    /// One scan, or scans until the step changes, from where it is held or from the beginning; then it is
    /// held. Errors as run().
    /// Until then has_single(); run() and hold() give it up.
    base::Status scan_once() { return run_until(HoldControl::After::scan); }
    base::Status step_once() { return run_until(HoldControl::After::step); }
    /// Holds it at the end of the scan: its orders are executed, for 500 ms at the most, and the motor is
    /// told to stop first, unless Settings::virtual_motor says otherwise. The timer stands meanwhile, the
    /// outputs stay. Error: no_table if it is stopped.
    base::Status hold();
    /// A scan_once() or step_once() is not done yet.
    bool has_single() const { return hold_.has_single(); }
    void stop(base::Instant now) { enter_safe_state(SafeReason::stop_command, now); }
    /// The motor was told to stop and has not confirmed it since: it may be moving. Nothing is to be
    /// confirmed of a virtual motor.
    bool stop_unconfirmed() const { return !settings_.virtual_motor && !motor_.stop_confirmed(); }
    std::uint32_t stop_asked() const { return stop_asked_; }  ///< uptime() then
    /// A stop that is not confirmed is not repeated any more, and run() is possible.
    void give_up_stop();
    /// Ends forces and breakpoints too.
    void make_safe(base::Instant now);

    /// Bit n: it is held when it enters step n, before the first scan there.
    void set_breakpoints(std::uint64_t steps) { hold_.set_breakpoints(steps); }
    std::uint64_t breakpoints() const { return hold_.breakpoints(); }
    bool at_breakpoint() const { return run_state_ == RunState::held && hold_.at_breakpoint(); }
    /// What the motor did before it was held can be taken up again: a move to P_SOLL, the speed V_SOLL, or
    /// nothing. Else run() and the like answer cannot_go_on.
    bool can_go_on() const { return settings_.virtual_motor || scan_.mode().is_known(); }
    /// Somebody else has told the motor something.
    void forget_mode() { scan_.mode().forget(); }

    void force_inputs(const Force& force, base::Instant now);
    void force_outputs(const Force& force, base::Instant now);
    void renew_forces(base::Instant now) { signals_.forces().renew(now); }
    void end_forces();
    const Forces& forces() const { return signals_.forces(); }

    /// Error: not_stopped.
    base::Status change(const Settings& settings);
    const Settings& settings() const { return settings_; }

    /// To be called at least once a millisecond, after the motor's own poll.
    void poll(base::Instant now);
    /// Or, instead: whenever something arrives (a byte from the motor, a change of an input) and at the
    /// latest then. Asked after each poll() and whatever was done since; `now` or earlier: at once. The
    /// watchdog may want it sooner. What it sleeps so is no scan time, and scans() counts only those that
    /// were looked at. `motors`: the driver's own next_poll().
    base::Instant next_poll(base::Instant now, base::Instant motors);
    /// Least time between a scan that did something and the next one; 0, as often as it is polled. For who
    /// goes by next_poll(): a table may do something in every scan.
    void pace(base::Microseconds least) { scan_.pace(least); }

    void observe(Observer* observer) { scan_.observe(observer); }
    /// Whose changes a scan takes before it begins.
    void take_values_from(ValueSource& source) { scan_.take_values_from(source); }

    RunState run_state() const { return run_state_; }
    SafeReason safe_reason() const { return safe_.reason(); }
    base::Instant safe_since() const { return safe_.since(); }  ///< when safe_reason() took hold
    const sequencer::State& state() const { return scan_.state(); }
    sequencer::InputImage image() const { return scan_.image(); }  ///< HW_INP of the last scan
    /// Finished, those skipped because nothing could change included.
    std::uint32_t scans() const { return scan_.times().scans(); }
    const sequencer::Table& table() const { return scan_.table(); }
    /// Of the last scan: its step, and what its conditions saw.
    std::uint8_t scanned_step() const { return scan_.scanned_step(); }
    sequencer::Key scanned_key() const { return scan_.scanned_key(); }
    base::Microseconds scan_time() const {
        return scan_.times().last();
    }  ///< between the last two scans' ends
    base::Microseconds worst_scan_time() const { return scan_.times().worst(); }  ///< since run()
    /// Of scans and of polls.
    void clear_worst() {
        scan_.times().clear_worst();
        polls_.clear_worst();
    }
    const PollWatch& polls() const { return polls_; }  ///< its worst() is since run(), too
    /// For a board that sleeps until another instant than next_poll() said.
    void expect_poll(base::Instant next, base::Instant now) { polls_.expect(next, now); }
    std::uint8_t terminals() const { return signals_.terminals(); }
    std::uint8_t inputs() const { return signals_.inputs(); }
    std::uint8_t outputs() const { return signals_.outputs(); }
    bool enabled() const;
    bool is_in_service() const { return permission_.is_in_service(); }  ///< until the next start
    /// Only while stopped: from now on nothing runs until the next start.
    void begin_service() { permission_.begin_service(); }
    const motor::Motor& motor() const { return motor_; }

    std::uint32_t uptime() const { return log_.uptime(); }
    std::uint32_t safe_since_uptime() const { return safe_.since_uptime(); }
    const EventLog& log() const { return log_; }
    void clear_log() { log_.clear(); }
    void note(Event event, std::uint16_t detail = 0);

  private:
    bool input_enables() const;
    void autostart(base::Instant now);
    base::Status run_until(HoldControl::After hold_after);
    void start_when_ready(base::Instant now);
    void watch_polls(base::Instant now);
    void serve_sequence(base::Instant now);
    void scan(base::Instant now);
    void stop_motor();
    void watch_stop();
    void leave_safe_state();
    void begin_hold(bool breakpoint, base::Instant now);
    void hold_if_due(bool entered_step, base::Instant now);
    void hold_when_settled(base::Instant now);
    base::Instant settling_ends() const;
    bool settles_too_long(base::Instant now) const { return now >= settling_ends(); }
    void watch_link(base::Instant now);
    void note_motor_fault();
    void expire_forces(base::Instant now);
    void block(SafeReason reason);
    bool needs_proof() const;
    void look_for_proof();
    void enter_safe_state(SafeReason reason, base::Instant now);
    void set_safe_reason(SafeReason reason, base::Instant now);
    void show_outputs();
    base::Instant next_work(base::Instant now) const;

    // Small members first: a Thumb instruction of two bytes reaches only an object's first 32 to 128.
    ports::Watchdog& watchdog_;
    motor::Motor& motor_;
    RunState run_state_ = RunState::stopped;
    bool is_proven_ = false;        ///< the table came with a certificate
    bool stop_ordered_ = false;     ///< on the way to running, or to being held
    bool stop_after_loss_ = false;  ///< the motor is to be stopped once the link delivers again
    bool stop_watched_ = false;     ///< its confirmation is to be noted in the log
    bool waits_for_first_run_ = false;
    std::uint8_t motor_fault_ = 0;  ///< as noted in the log
    StartPermission permission_;
    SafeState safe_;
    std::uint32_t stop_asked_ = 0;
    base::Instant hold_asked_{};
    HoldControl hold_;
    Signals signals_;
    Settings settings_;
    SequenceScan scan_;
    EventLog log_;
    PollWatch polls_;
};

}  // namespace nplc::gateway
