#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/result.h"
#include "base/time.h"
#include "gateway/event_log.h"
#include "gateway/hold_control.h"
#include "gateway/io_image.h"
#include "gateway/poll_watch.h"
#include "gateway/safe_state.h"
#include "gateway/sequence_scan.h"
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
    base::Microseconds longest_wait{1'000'000};   ///< limit of a scan's wait for the motor
    bool virtual_motor = false;                   ///< holding the sequence does not stop the motor
    base::Microseconds force_time{5'000'000};     ///< forced signals end unless renewed within this time
    std::optional<std::uint8_t> status_output{};  ///< output 0..3 that shows status_light()
    bool require_proof = false;                   ///< a table without a certificate does not start
    /// us; a later poll is logged as an event unless the sequence is stopped.
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

    /// Makes a table the current one; only while stopped, and only if the motor supports all its orders (else
    /// not_for_motor). The bytes must stay valid. On a fault the safe state is entered with bad_table, and
    /// nothing can run until a good table is loaded. `proven`: the table came with a certificate.
    LoadResult load(std::span<const std::uint8_t> bytes, base::Instant now, bool proven = false);

    /// The start-up is over: no table starts by itself any more.
    void end_start_up() { permission_.end_start_up(); }
    /// For the start-up: disables automatic start and shows `reason` until run().
    void block_start(SafeReason reason);
    /// The same, and a run must be marked in the store first: after run() wants_mark() is set until
    /// mark_run(), or until refuse_run_mark(), with which the run has failed. not_started: run was never
    /// commanded with this store.
    void wait_for_mark(SafeReason reason);
    bool needs_mark() const { return waits_because_ != SafeReason::none; }
    bool waits_for_first_run() const { return waits_because_ == SafeReason::not_started; }
    bool wants_mark() const { return needs_mark() && run_state_ == RunState::waiting_for_motor; }
    void mark_run() { waits_because_ = SafeReason::none; }
    bool is_mark_refused() const { return is_mark_refused_; }  ///< of the last run()
    void refuse_run_mark() { is_mark_refused_ = needs_mark(); }
    /// The same, and until unlock() run() is refused with not_enabled and no other reason is shown.
    void lock(SafeReason reason);
    void unlock(SafeReason reason);

    /// A required resource of the board is lost: enters the safe state; start is not enabled until the next
    /// start-up.
    void lock_and_enter_safe_state(SafeReason reason, base::Instant now);

    /// Whether the motor supports the order of this term; true if the term has none.
    bool motor_takes(sequencer::TermView term) const { return scan_.motor_takes(term); }

    /// Starts from step 0, or continues from a hold with the motor put back into its mode from before the
    /// hold; cancels the hold after a single scan or step if has_single(). Errors: no_table; not_stopped when
    /// it already runs; not_enabled: the enable input is off, so that closing a guard
    /// starts nothing, or locked; no_proof; cannot_go_on; stop_unconfirmed.
    base::Status run();
    /// Runs one scan, or scans until the step changes, from the hold or from step 0, then holds. Until then
    /// has_single(); run() and hold() cancel it. Errors as run().
    base::Status scan_once() { return run_until(HoldControl::After::scan); }
    base::Status step_once() { return run_until(HoldControl::After::step); }
    /// Holds the sequence at the end of the scan, once the scan's orders have been executed (500 ms at the
    /// most) and the motor was told to stop, unless Settings::virtual_motor. During the hold the timer is
    /// paused and the outputs keep their values. Error: no_table if stopped.
    base::Status hold();
    /// A scan_once() or step_once() is still in progress.
    bool has_single() const { return hold_.has_single(); }
    void stop(base::Instant now) { enter_safe_state(SafeReason::stop_command, now); }
    /// The motor was told to stop and has not confirmed it yet: it may be moving. Always false with a virtual
    /// motor.
    bool stop_unconfirmed() const { return !settings_.virtual_motor && !motor_.stop_confirmed(); }
    std::uint32_t stop_asked() const { return stop_asked_; }  ///< uptime() of that stop
    /// Ends the repetition of an unconfirmed stop and makes run() possible.
    void give_up_stop();
    /// Enters the safe state, ends all forces and clears the breakpoints.
    void enter_safe_state_by_command(base::Instant now);

    /// Bit n: the sequence is held when it enters step n, before the first scan there.
    void set_breakpoints(std::uint64_t steps) { hold_.set_breakpoints(steps); }
    std::uint64_t breakpoints() const { return hold_.breakpoints(); }
    bool at_breakpoint() const { return run_state_ == RunState::held && hold_.at_breakpoint(); }
    /// The motor's mode before the hold is known, so that its motion can be resumed: a move to P_SOLL, the
    /// speed V_SOLL, or none. Else run(), scan_once() and step_once() return cannot_go_on.
    bool can_go_on() const { return settings_.virtual_motor || scan_.mode().is_known(); }
    /// Motor mode is unknown after a direct user write.
    void forget_mode() { scan_.mode().forget(); }

    void force_inputs(const Force& force, base::Instant now);
    void force_outputs(const Force& force, base::Instant now);
    void renew_forces(base::Instant now) { io_image_.forces().renew(now); }
    void end_forces();
    const ForcedIo& forces() const { return io_image_.forces(); }

    /// Error: not_stopped.
    base::Status change(const Settings& settings);
    const Settings& settings() const { return settings_; }

    /// To be called at least once a millisecond, after the motor's own poll.
    void poll(base::Instant now);
    /// Alternative to polling every millisecond: poll whenever something arrives (a byte from the motor, a
    /// change of an input) and at this time at the latest. To be asked after each poll() and each call that
    /// changes something; `now` or earlier: poll at once. The watchdog may need an earlier poll. Time slept
    /// is not scan time, and scans() counts only the scans that were polled. `motors`: the driver's own
    /// next_poll().
    base::Instant next_poll(base::Instant now, base::Instant motors);
    /// Minimum time from a scan that changed something to the next one; 0: at every poll. For boards that go
    /// by next_poll(): a table may change something in every scan.
    void pace(base::Microseconds least) { scan_.pace(least); }

    void observe(Observer* observer) { scan_.observe(observer); }
    /// The source of the value changes that a scan takes before it begins.
    void take_values_from(ValueSource& source) { scan_.take_values_from(source); }

    RunState run_state() const { return run_state_; }
    SafeReason safe_reason() const { return safe_.reason(); }
    base::Instant safe_since() const { return safe_.since(); }  ///< when safe_reason() was set
    const sequencer::State& state() const { return scan_.state(); }
    sequencer::InputImage image() const { return scan_.image(); }  ///< HW_INP of the last scan
    /// Finished scans, with those skipped because nothing could change.
    std::uint32_t scans() const { return scan_.times().scans(); }
    const sequencer::Table& table() const { return scan_.table(); }
    /// Of the last scan: its step, and the key that its conditions were evaluated with.
    std::uint8_t scanned_step() const { return scan_.scanned_step(); }
    sequencer::Key scanned_key() const { return scan_.scanned_key(); }
    base::Microseconds scan_time() const {
        return scan_.times().last();
    }  ///< between the last two scans' ends
    base::Microseconds worst_scan_time() const { return scan_.times().worst(); }  ///< since run()
    /// Clears the worst scan time and the worst poll delay.
    void clear_worst() {
        scan_.times().clear_worst();
        polls_.clear_worst();
    }
    const PollWatch& polls() const { return polls_; }  ///< its worst() is since run(), too
    /// For a board that sleeps until another instant than next_poll() said.
    void expect_poll(base::Instant next, base::Instant now) { polls_.expect(next, now); }
    std::uint8_t terminals() const { return io_image_.terminals(); }
    std::uint8_t inputs() const { return io_image_.inputs(); }
    std::uint8_t outputs() const { return io_image_.outputs(); }
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
    void note_late_line();
    void expire_forces(base::Instant now);
    void block(SafeReason reason);
    bool needs_proof() const;
    void look_for_proof();
    void enter_safe_state(SafeReason reason, base::Instant now);
    void set_safe_reason(SafeReason reason, base::Instant now);
    void show_outputs();
    base::Instant next_work(base::Instant now) const;

    // Small members first: a 16-bit Thumb load or store reaches only the first 32 to 128 bytes of an object.
    ports::Watchdog& watchdog_;
    motor::Motor& motor_;
    RunState run_state_ = RunState::stopped;
    bool is_proven_ = false;        ///< the table came with a certificate
    bool stop_ordered_ = false;     ///< since the start, or the hold, began
    bool stop_after_loss_ = false;  ///< the motor is to be stopped again once the link delivers
    bool stop_watched_ = false;     ///< its confirmation is to be noted in the log
    bool is_mark_refused_ = false;  ///< of the last run()
    SafeReason waits_because_ = SafeReason::none;  ///< until a run is marked in the store
    std::uint8_t motor_fault_ = 0;                 ///< as noted in the log
    bool line_is_late_ = false;                    ///< likewise
    StartPermission permission_;
    SafeState safe_;
    std::uint32_t stop_asked_ = 0;
    base::Instant hold_asked_{};
    HoldControl hold_;
    IoImage io_image_;
    Settings settings_;
    SequenceScan scan_;
    EventLog log_;
    PollWatch polls_;
};

}  // namespace nplc::gateway
