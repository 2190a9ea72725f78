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

/// How many scans there were and how long they took, end to end. What was slept is no scan time.
class ScanTimes {
  public:
    std::uint32_t scans() const { return scans_; }
    base::Microseconds last() const { return last_; }
    base::Microseconds worst() const { return worst_; }
    void clear_worst() { worst_ = {}; }

    /// The next scan has no time.
    void interrupt() { ended_.reset(); }
    void note_end(base::Instant now) {
        ++scans_;
        last_ = ended_ ? now - *ended_ : base::Microseconds{};
        if (worst_ < last_) worst_ = last_;
        ended_ = now;
    }
    void sleep_until(base::Instant next) { asleep_until_ = next; }
    /// `idle`: nothing could change while it slept.
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

/// The scans of a table on a motor (001 §6.1.9): HW_INP, orders, timer. A scan halts while the motor has no
/// room for an order, and one in which nothing can happen is finished at once.
class SequenceScan {
  public:
    enum class Result : std::uint8_t {
        waiting,  ///< for the motor, or for the pace
        skipped,  ///< nothing could happen
        finished,
    };

    explicit SequenceScan(motor::Motor& motor) : motor_(motor) {}
    SequenceScan(const SequenceScan&) = delete;
    SequenceScan& operator=(const SequenceScan&) = delete;

    /// Makes a table the current one, or none if it has a fault; not_for_motor: the motor does not have one
    /// of its orders.
    std::optional<sequencer::TableFault> load(std::span<const std::uint8_t> bytes);
    bool motor_takes(sequencer::TermView term) const;

    /// To step 0.
    void reset();
    /// The sequence runs from here on.
    void start(base::Instant now);
    /// The next scan is the first after having been held.
    void resume();
    /// Drops a scan under way.
    void abort();

    /// Takes the time that has passed off the timer.
    void count_timer(base::Instant now);
    bool is_under_way() const { return in_scan_; }
    Result poll(std::uint8_t inputs, base::Instant now);
    /// Step, counter, timer and outputs of a scan that is `finished`, to the observer.
    void report(base::Instant now) const;
    bool has_entered_step() const { return engine_.state().step != before_.step; }

    /// When poll() has something to do if nothing arrives.
    base::Instant next_poll(std::uint8_t inputs, base::Microseconds longest_wait, base::Instant now) const;
    /// The motor was given something to do.
    void note_progress(base::Instant now) { progress_ = now; }
    base::Instant patience(base::Microseconds longest_wait) const {
        return progress_ + longest_wait + base::Microseconds(1);
    }
    bool waits_too_long(base::Microseconds longest_wait, base::Instant now) const {
        return now - progress_ > longest_wait;
    }

    /// Least time between a scan that did something and the next one.
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
    /// Of the last scan: HW_INP, its step, and what its conditions saw.
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

    // Small members first: a Thumb instruction of two bytes reaches only an object's first 32 to 128.
    motor::Motor& motor_;
    Observer* observer_ = nullptr;
    ValueSource* values_ = nullptr;
    bool in_scan_ = false;
    bool resumes_ = false;
    bool idle_ = false;  ///< nothing could change at the last look
    MotorMode mode_;
    sequencer::InputImage image_ = 0;
    std::optional<sequencer::Key> unchanged_key_;  ///< a scan with this key would do nothing
    sequencer::State before_;                      ///< as the last scan found it
    std::optional<sequencer::MotorOrder> waiting_order_;
    sequencer::Engine engine_{table_};
    base::Instant progress_{};  ///< last time that a scan did not have to wait
    base::Instant ticked_{};    ///< the timer has been counted up to here
    base::Microseconds pace_{};
    base::Instant next_scan_{};
    ScanTimes times_;
    sequencer::Table table_;
};

}  // namespace nplc::gateway
