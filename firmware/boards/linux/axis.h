#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "config.h"
#include "gateway/gateway.h"
#include "gateway/own_registers.h"
#include "gateway/user_port.h"
#include "hal_linux/background_storage.h"
#include "hal_linux/event_loop.h"
#include "hal_linux/file_storage.h"
#include "hal_linux/gpio.h"
#include "journal.h"
#include "kept_uart.h"
#include "motor_part.h"
#include "user_server.h"

namespace nplc::boards {

/// One sequencer of this process: its pins, its motor's line, its user's port, its store, and the firmware
/// that they make a gateway of.
class Axis {
  public:
    Axis(const AxisConfig& config, Journal& journal, ports::Watchdog& watchdog)
        : config_(config), journal_(journal), watchdog_(watchdog) {}
    ~Axis();
    Axis(const Axis&) = delete;
    Axis& operator=(const Axis&) = delete;

    /// Outputs first, at their safe levels. Empty, or one line; then nothing is held.
    std::string open(const std::string& state_directory, base::Instant now);
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
    /// From now on an end that is not orderly is a crash; a start that failed before is none.
    void note_running();
    /// The end was orderly: the next start is none after a crash.
    void note_orderly_end();

    /// From a signal's handler, when all is lost.
    void write_safe_outputs();

    const std::string& name() const { return config_.name; }
    std::string state_in_words() const;

  private:
    std::string open_store(const std::string& folder);
    void start_settings();
    std::string open_lines();
    std::string open_ports();
    std::string load_table(base::Instant now);
    gateway::StartCause cause_of_start() const;
    std::string start(gateway::StartCause cause, base::Instant now);
    void tell(LogLevel level, const std::string& text);
    void tell_news(base::Instant now);
    void tell_stored_settings();
    void watch_ports();
    void look_at_inputs();
    bool is_edge_alone(base::Instant now) const;
    void run_sequence(base::Instant now);
    void rest_or_watch(base::Instant now);
    bool stores() { return storage_->state() == ports::StorageState::busy; }
    void reset(base::Instant now);
    void note_lost_pins();
    void watch_pins(base::Instant now);
    std::uint32_t setting(store::Setting which) const { return settings_->at_start(which); }
    hal_linux::UartSettings uart_settings(const std::string& path, std::uint32_t baud) const;

    const AxisConfig& config_;
    Journal& journal_;
    ports::Watchdog& watchdog_;
    std::string folder_;

    std::unique_ptr<hal_linux::FileStorage> file_;
    std::optional<hal_linux::BackgroundStorage> storage_;
    hal_linux::GpioBits input_bits_;
    hal_linux::GpioBits output_bits_;
    std::optional<hal_linux::GpioInputs> inputs_;
    std::optional<hal_linux::GpioOutputs> outputs_;
    MotorPart motor_;
    std::optional<KeptUart> mactalk_port_;
    std::optional<KeptUart> user_uart_;
    std::optional<UserServer> user_server_;

    std::optional<gateway::SettingsKeeper> settings_;
    std::optional<gateway::Gateway> gateway_;
    std::array<std::uint8_t, (sequencer::kMaxTerms + 1) * sequencer::kTermBytes> table_memory_{};
    std::optional<gateway::TableKeeper> tables_;
    std::optional<gateway::OwnRegisters> own_registers_;
    std::optional<gateway::UserPort> user_port_;
    /// The user's line where there is none.
    struct NoLine final : ports::SerialPort {
        std::size_t write(std::span<const std::uint8_t> bytes) override { return bytes.size(); }
        std::size_t read(std::span<ports::ReceivedByte>) override { return 0; }
        bool transmitter_idle() override { return true; }
    } no_line_;

    hal_linux::EventLoop* loop_ = nullptr;
    std::uint32_t mark_ = 0;
    bool user_readable_ = true;
    bool line_readable_ = false;
    std::uint32_t edges_ = 0;  ///< descriptors of inputs at which some wait, bit 0 is the first
    /// The motor's line is looked at then; it does not wake us.
    base::Instant rests_until_ = base::kNever;
    base::Instant tell_silence_at_ = base::kNever;
    std::uint32_t told_events_ = 0;
    motor::Link told_link_ = motor::Link::down;
    bool told_pins_lost_ = false;
    bool failed_ = false;  ///< a port could not be had again after a reset: nothing works any more
};

}  // namespace nplc::boards
