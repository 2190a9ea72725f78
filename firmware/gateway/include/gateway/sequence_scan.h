#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/time.h"
#include "gateway/motor_mode.h"
#include "gateway/observer.h"
#include "gateway/value_source.h"
#include "motor/motor.h"
#include "sequencer/engine.h"

namespace nplc::gateway {

/// Number and duration of scans, end to end. Time slept is not scan time.
class ScanTimes {
  public:
    std::uint32_t scans() const { return scans_; }
    base::Microseconds last() const { return last_; }
    base::Microseconds worst() const { return worst_; }
    void clear_worst() { worst_ = {}; }

    /// The next scan is not timed.
    void interrupt() { ended_.reset(); }
    void note_end(base::Instant now) {
        ++scans_;
        last_ = ended_ ? now - *ended_ : base::Microseconds{};
        if (worst_ < last_) worst_ = last_;
        ended_ = now;
    }
    void sleep_until(base::Instant next) { asleep_until_ = next; }
    /// `idle`: nothing could change during the sleep.
    void wake(bool idle, base::Instant now) {
        if (idle && ended_ && asleep_until_) ended_ = now < *asleep_until_ ? now : *asleep_until_;
        asleep_until_.reset();
    }

  private:
    std::uint32_t scans_ = 0;
    base::Microseconds last_{};
    base::Microseconds worst_{};
    std::optional<base::Instant> ended_;
    std::optional<base::Instant> asleep_until_;
};

/// The scans of a table on a motor (001 §6.1.9): HW_INP, orders, timer. A scan waits while the motor has no
/// room for an order, and one that cannot change anything is skipped.
class SequenceScan {
  public:
    enum class Result : std::uint8_t {
        waiting,  ///< for the motor, or for the minimum scan interval
        skipped,  ///< nothing could change
        finished,
    };

    explicit SequenceScan(motor::Motor& motor) : motor_(motor) {}
    SequenceScan(const SequenceScan&) = delete;
    SequenceScan& operator=(const SequenceScan&) = delete;

    /// Makes a table the current one, or none if it has a fault; not_for_motor: the motor does not support
    /// one of its orders.
    std::optional<sequencer::TableFault> load(std::span<const std::uint8_t> bytes);
    bool motor_takes(sequencer::TermView term) const;

    /// Back to step 0.
    void reset();
    /// Starts the sequence at `now`.
    void start(base::Instant now);
    /// The next scan is the first one after a hold.
    void resume();
    /// Drops a scan in progress.
    void abort();

    /// Subtracts the elapsed time from the timer.
    void count_timer(base::Instant now);
    bool is_under_way() const { return in_scan_; }
    Result poll(std::uint8_t inputs, base::Instant now);
    /// Reports a `finished` scan to the observer: step, counter, timer and outputs.
    void report(base::Instant now) const;
    bool has_entered_step() const { return engine_.state().step != before_.step; }

    /// When poll() has work to do if nothing arrives.
    base::Instant next_poll(std::uint8_t inputs, base::Microseconds longest_wait, base::Instant now) const;
    /// The motor was given an order.
    void note_progress(base::Instant now) { progress_ = now; }
    base::Instant deadline(base::Microseconds longest_wait) const {
        return progress_ + longest_wait + base::Microseconds(1);
    }
    bool timed_out(base::Microseconds longest_wait, base::Instant now) const {
        return now - progress_ > longest_wait;
    }

    /// Minimum time from a scan that changed something to the next one.
    void pace(base::Microseconds least) { pace_ = least; }
    void observe(Observer* observer) { observer_ = observer; }
    void take_values_from(ValueSource& source) { values_ = &source; }

    MotorMode& mode() { return mode_; }
    const MotorMode& mode() const { return mode_; }
    ScanTimes& times() { return times_; }
    const ScanTimes& times() const { return times_; }
    void wake(base::Instant now) { times_.wake(idle_, now); }

    const sequencer::Table& table() const { return table_; }
    const sequencer::State& state() const { return engine_.state(); }
    /// Of the last scan: HW_INP, its step, and the key that its conditions were evaluated with.
    sequencer::InputImage image() const { return image_; }
    std::uint8_t scanned_step() const { return before_.step; }
    sequencer::Key scanned_key() const { return sequencer::key_of(image_, before_); }

  private:
    Result begin(std::uint8_t inputs, base::Instant now);
    bool send_orders(base::Instant now);
    bool may_take_values() const;
    bool take_values(base::Instant now);
    void finish(base::Instant now);
    sequencer::InputImage present_image(std::uint8_t inputs) const;

    // Small members first: see Gateway.
    motor::Motor& motor_;
    Observer* observer_ = nullptr;
    ValueSource* values_ = nullptr;
    bool in_scan_ = false;
    bool resumes_ = false;
    bool idle_ = false;  ///< nothing could change at the last scan
    MotorMode mode_;
    sequencer::InputImage image_ = 0;
    std::optional<sequencer::Key> unchanged_key_;  ///< a scan with this key would do nothing
    sequencer::State before_;                      ///< before the last scan
    std::optional<sequencer::MotorOrder> waiting_order_;
    sequencer::Engine engine_{table_};
    base::Instant progress_{};  ///< last time that a scan did not have to wait
    base::Instant ticked_{};    ///< the timer is counted up to this time
    base::Microseconds pace_{};
    base::Instant next_scan_{};
    ScanTimes times_;
    sequencer::Table table_;
};

}  // namespace nplc::gateway
