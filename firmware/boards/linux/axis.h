#pragma once

#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "config.h"
#include "gateway/controller.h"
#include "hal_linux/background_storage.h"
#include "hal_linux/event_loop.h"
#include "hal_linux/file_storage.h"
#include "hal_linux/gpio.h"
#include "hal_linux/run_marker.h"
#include "journal.h"
#include "lines.h"
#include "motor_part.h"
#include "no_ports.h"
#include "stored.h"
#include "user_server.h"

namespace nplc::boards {

/// What is known of the board's own start.
struct BoardStart {
    bool by_watchdog = false;      ///< one of its watchdogs says that it has reset the board
    bool power_cut_waits = false;  ///< a run that a restart of the board has cut off waits for a person
};

/// One sequencer of this process: its pins, its motor's line, its user's port, its store, and the firmware
/// that they make a gateway of.
class Axis {
  public:
    Axis(const AxisConfig& config, Journal& journal, ports::Watchdog& watchdog)
        : config_(config), journal_(journal), watchdog_(watchdog) {}
    ~Axis();
    Axis(const Axis&) = delete;
    Axis& operator=(const Axis&) = delete;

    /// Has what it can, outputs first. What it cannot do without and cannot have is told, keeps it in its
    /// safe state, is shown at its port, and is tried again; what it then has makes a start as after a
    /// power-up.
    void open(const std::string& state_directory, const BoardStart& board, base::Instant now);
    /// kMarks marks, `mark` the first of them.
    void watch(hal_linux::EventLoop& loop, std::uint32_t mark);
    static constexpr std::uint32_t kMarks = 8;  ///< serial lines, the user's server, six of input lines
    /// What is watched with `mark` has something to be read.
    void note_readable(std::uint32_t mark);

    void serve(base::Instant now);
    /// When serve() is wanted at the latest if nothing of what is watched is readable.
    base::Instant next(base::Instant now);

    /// The orderly end: outputs safe, motor told to stop; then serve() until it has taken that.
    void begin_end(base::Instant now);
    bool has_stopped() const;
    bool motor_answers() const { return motor_.has_driver() && motor::delivers(motor_.driver().link()); }
    /// From now on an end that is not orderly is a crash; a start that failed before is none. What cannot be
    /// marked does not run.
    void note_running(base::Instant now);
    /// The end was orderly: the next start is none after a crash.
    void note_orderly_end();

    /// From a signal's handler, when all is lost.
    void write_safe_outputs();

    const std::string& name() const { return config_.name; }
    std::string state_in_words() const;

  private:
    /// What it cannot do without, and why it has it not; empty: it has.
    struct Lacks {
        std::string store{};
        std::string lines{};
        std::string port{};
    };
    bool is_complete() const { return lacks_.store.empty() && lacks_.lines.empty() && lacks_.port.empty(); }
    gateway::SafeReason worst_lack() const;
    void lack(std::string& what, const std::string& why);

    // axis_start.cpp
    void begin(base::Instant now);
    void try_again(base::Instant now);
    ports::Storage& storage();
    void get_store(base::Instant now);
    bool look_at_marker(const std::string& path);
    std::string replace_lost_store(const std::string& path);
    void get_lines();
    void open_motor();
    void get_users_port();
    void get_user_uart();
    std::string open_user_uart();
    void load_table(base::Instant now);
    bool is_after_crash();
    void start(base::Instant now);

    // axis.cpp
    void tell(LogLevel level, const std::string& text);
    void tell_news(base::Instant now);
    void tell_stored_settings();
    void watch_all();
    void watch_ports();
    void look_at_inputs();
    bool is_edge_alone(base::Instant now) const;
    void look_at_user(base::Instant now);
    void poll_controller(base::Instant now);
    void watch_or_wait(base::Instant now);
    bool stores() { return storage().state() == ports::StorageState::busy; }
    void reset(base::Instant now);
    void note_lost_pins();
    void watch_pins(base::Instant now);
    std::uint32_t setting(store::Setting which) const { return settings_->at_start(which); }

    const AxisConfig& config_;
    Journal& journal_;
    ports::Watchdog& watchdog_;
    std::string folder_;
    Lacks lacks_;
    std::set<std::string> told_lacks_;
    base::Instant try_at_ = base::kNever;
    std::optional<gateway::StartCause> cause_;  ///< of the next start; nothing: not known without the store
    bool is_running_ = false;                   ///< note_running()
    BoardStart board_{};
    std::optional<hal_linux::RunMarker> marker_;
    bool marker_is_bad_ = false;  ///< as the start found it
    bool is_marked_ = true;

    std::unique_ptr<hal_linux::FileStorage> file_;
    std::optional<hal_linux::BackgroundStorage> storage_;
    NoStorage no_storage_{kMemory};
    hal_linux::GpioBits input_bits_;
    hal_linux::GpioBits output_bits_;
    bool has_inputs_ = false;
    bool has_outputs_ = false;
    std::optional<hal_linux::GpioInputs> inputs_;
    std::optional<hal_linux::GpioOutputs> outputs_;
    MotorPart motor_;
    std::optional<ReopenedUart> mactalk_port_;
    std::optional<ReopenedUart> user_uart_;
    std::optional<TimelyPort> user_line_;  ///< on user_uart_
    std::optional<UserServer> user_server_;

    std::array<std::uint8_t, gateway::kTableMemory> table_memory_{};
    std::optional<gateway::SettingsKeeper> settings_;
    std::optional<gateway::Controller> controller_;

    hal_linux::EventLoop* loop_ = nullptr;
    std::uint32_t mark_ = 0;
    bool user_readable_ = true;
    bool line_readable_ = false;
    std::uint32_t edges_ = 0;  ///< descriptors of inputs at which some wait, bit 0 is the first
    /// The motor's line is looked at then; it does not wake us.
    base::Instant unwatched_until_ = base::kNever;
    base::Instant tell_silence_at_ = base::kNever;
    std::uint32_t told_events_ = 0;
    motor::Link told_link_ = motor::Link::down;
    bool told_pins_lost_ = false;
};

}  // namespace nplc::boards
