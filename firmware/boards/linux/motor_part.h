#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal_linux/event_loop.h"
#include "journal.h"
#include "lines.h"
#include "log_messages.h"
#include "motor/any_driver.h"
#include "motor_config.h"

namespace nplc::boards {

/// An axis's motor of any kind: its line and its driver.
class MotorPart {
  public:
    /// Opens the line; a serial line has `set_baud` unless the configuration gives a speed. A line that
    /// cannot be opened is silent until look() finds it.
    void open(const MotorConfig& config, std::uint32_t set_baud);
    /// A new driver on the open line, as after a power-up.
    motor::Motor& start(const store::SettingValues& values);
    bool has_driver() const { return motor_ != nullptr; }
    motor::Motor& driver() { return *motor_; }
    const motor::Motor& driver() const { return *motor_; }
    const motor::AnyDriver& any_driver() const { return driver_; }
    /// Of the driver.
    base::Instant next_poll(base::Instant now) const { return driver_.next_poll(now); }

    void watch(hal_linux::EventLoop& loop, std::uint32_t mark);
    void ignore(hal_linux::EventLoop& loop);
    /// To be called after the driver's poll: logs changes of the line. True if it has another descriptor.
    bool look(AxisJournal& journal, base::Instant now);
    base::Instant next_look() const { return uart_ ? uart_->next_look() : can_->next_look(); }
    std::string line_in_words() const { return config_.line_in_words(); }
    /// Text for a link that has not come up, and for a lost one.
    std::string silence_in_words() const;
    std::string loss_in_words() const;
    /// New faults and warnings of the drive, once each.
    std::vector<LogMessage> news();
    /// The status is repeated without pause and nothing waits for it: the line need not be watched for some
    /// milliseconds.
    bool needs_no_watch() const;
    /// Allows the driver to read a status that is repeated without pause.
    void open_line(base::Instant now);
    bool was_read_since(base::Instant time) const { return line_ && line_->opened() >= time; }

  private:
    MotorConfig config_;
    std::optional<ReconnectingUart> uart_;
    std::optional<ReconnectingCan> can_;
    std::optional<GatedPort> line_;
    motor::AnyDriver driver_;
    motor::Motor* motor_ = nullptr;
    std::uint8_t told_fault_ = 0;
    std::uint32_t told_warnings_ = 0;
};

}  // namespace nplc::boards
