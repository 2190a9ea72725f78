#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>

#include "axis_pins.h"
#include "axis_reporter.h"
#include "axis_store.h"
#include "config.h"
#include "faces_part.h"
#include "gateway/controller.h"
#include "hal_linux/event_loop.h"
#include "journal.h"
#include "lines.h"
#include "mactalk_part.h"
#include "motor_part.h"
#include "user_connection.h"

namespace nplc::boards {

/// One sequencer of this process: its pins, its motor's line, its user port, its store, and the firmware that
/// runs on them.
class Axis {
  public:
    Axis(const AxisConfig& config, Journal& journal, ports::Watchdog& watchdog,
         CommissionedAxes& commissioned)
        : config_(config),
          journal_(journal, config.name),
          watchdog_(watchdog),
          store_(journal_, config_.name, commissioned),
          faces_(config.name, config.scaling, config.faces) {}
    ~Axis();
    Axis(const Axis&) = delete;
    Axis& operator=(const Axis&) = delete;

    /// Opens all resources, outputs first. A missing required resource is reported, keeps the axis in its
    /// safe state, is shown at its port and is retried; when it becomes available the axis starts as after a
    /// power-up.
    void open(const std::string& state_directory, const BoardStart& board, base::Instant now);
    /// Registers kMarks marks from `mark` on.
    void watch(hal_linux::EventLoop& loop, std::uint32_t mark);
    static constexpr std::uint32_t kMarks = 9;  ///< serial lines, user's server, faces, six of input lines
    /// The descriptor with `mark` is readable.
    void note_readable(std::uint32_t mark);

    void serve(base::Instant now);
    /// Latest time of the next serve() if no watched descriptor becomes readable.
    base::Instant next(base::Instant now);

    /// Orderly shutdown: outputs safe, motor told to stop; then call serve() until has_stopped().
    void begin_shutdown(base::Instant now);
    bool has_stopped() const;
    /// From now on a disorderly end counts as a crash; a start that failed before does not. An axis that
    /// cannot be marked does not run.
    void note_running(base::Instant now);
    /// The end was orderly: the next start is not one after a crash.
    void mark_clean_shutdown();
    /// The motor has not confirmed the stop, which is logged: the next start is one after a crash, in
    /// whichever boot.
    void note_unstopped_end();

    /// Async-signal-safe; called from the fatal-signal handler.
    void write_safe_outputs();

    /// For the other interfaces (firmware/faces), while the axis exists.
    faces::AxisModel& model() { return faces_.model(); }
    std::string state_in_words() const;

  private:
    /// The missing required resources with the reasons; empty: available.
    struct Missing {
        std::string store{};
        std::string lines{};
        std::string port{};
    };
    bool is_complete() const {
        return missing_.store.empty() && missing_.lines.empty() && missing_.port.empty();
    }
    gateway::SafeReason missing_reason() const;
    void note_missing(std::string& what, gateway::SafeReason cause, const std::string& why);

    void begin(base::Instant now);
    void try_again(base::Instant now);
    void open_store(base::Instant now);
    void open_pins();
    void open_motor();
    void open_user_port();
    void start(base::Instant now);
    void block_start();
    void load_table(base::Instant now);
    void give_permission(base::Instant now);
    void tell_stored_settings();
    void reset(base::Instant now);

    void watch_all();
    void watch_ports();
    void watch_or_wait(base::Instant now);
    void watch_pins(base::Instant now);
    bool is_edge_alone(base::Instant now) const;
    void look_at_user(base::Instant now);
    void poll_controller(base::Instant now);
    std::uint32_t setting(store::Setting which) const { return settings_->at_start(which); }

    const AxisConfig& config_;
    AxisJournal journal_;
    ports::Watchdog& watchdog_;
    std::string folder_;
    BoardStart board_{};
    Missing missing_;
    std::set<std::string> reported_missing_;
    base::Instant try_at_ = base::kNever;
    std::optional<gateway::StartCause> cause_;  ///< of the next start; nothing: not known without the store
    bool is_running_ = false;                   ///< note_running()
    bool is_giving_ = false;                    ///< give_permission() is under way
    bool is_unstopped_ = false;                 ///< the motor had not confirmed its stop at the last reset

    AxisStore store_;
    AxisPins pins_;
    MotorPart motor_;
    MactalkPart mactalk_;
    UserConnection user_{journal_};
    AxisReporter reporter_{journal_};
    std::array<std::uint8_t, gateway::kTableMemory> table_memory_{};
    std::optional<gateway::SettingsManager> settings_;
    std::optional<gateway::Controller> controller_;
    FacesPart faces_;

    hal_linux::EventLoop* loop_ = nullptr;
    std::uint32_t mark_ = 0;
    bool line_readable_ = false;
    /// While set, the motor's line is read at this time and does not wake the event loop.
    base::Instant unwatched_until_ = base::kNever;
};

}  // namespace nplc::boards
