#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal_linux/event_loop.h"
#include "journal.h"
#include "kept_can.h"
#include "kept_uart.h"
#include "motor/jvl_motor.h"
#include "motor/midi_can_link.h"
#include "motor/midi_motor.h"
#include "motor/midi_v24_link.h"
#include "motor_config.h"
#include "round_port.h"
#include "words.h"

namespace nplc::boards {

/// The motor of an axis: its line and its driver, whatever kind it is.
class MotorPart {
  public:
    /// Of a JVL motor the line has `jvl_baud`. One that cannot be had now is silent until look() finds it.
    void open(const std::string& who, const MotorConfig& config, std::uint32_t jvl_baud);
    /// A new driver on the open line, as after a power-up.
    motor::Motor& start(const store::SettingValues& values);
    bool has_driver() const { return driver_ != nullptr; }
    motor::Motor& driver() { return *driver_; }
    const motor::Motor& driver() const { return *driver_; }
    /// The driver's.
    base::Instant next_poll(base::Instant now) const {
        return midi_ ? midi_->next_poll(now) : jvl_->next_poll(now);
    }

    void watch(hal_linux::EventLoop& loop, std::uint32_t mark);
    void ignore(hal_linux::EventLoop& loop);
    /// After the driver's poll: says what has happened to the line. True if it has another descriptor.
    bool look(Journal& journal, base::Instant now);
    base::Instant next_look() const { return uart_ ? uart_->next_look() : can_->next_look(); }
    /// Why the link has not come up, and that it was lost.
    std::string silence_in_words() const;
    std::string loss_in_words() const;
    /// What a MIDI drive says of its faults and warnings, once each.
    std::vector<Said> news();
    /// Status comes without pause and nothing waits for it: the line need not be watched for some
    /// milliseconds.
    bool may_rest() const;
    /// A JVL motor's status is taken from the line only while it is open. Other lines are always.
    void open_line(base::Instant now);
    bool was_read_since(base::Instant time) const { return line_ && line_->opened() >= time; }

  private:
    motor::Motor& start_jvl(const store::SettingValues& values);
    motor::Motor& start_midi(registers::midi::Model model);

    MotorConfig config_;
    std::optional<KeptUart> uart_;
    std::optional<KeptCan> can_;
    std::optional<RoundPort> line_;
    std::optional<motor::JvlMotor> jvl_;
    std::optional<motor::MidiV24Link> v24_;
    std::optional<motor::MidiCanLink> on_can_;
    std::optional<motor::MidiMotor> midi_;
    motor::Motor* driver_ = nullptr;
    motor::MidiFault told_fault_ = motor::MidiFault::none;
    std::uint32_t told_warnings_ = 0;
};

}  // namespace nplc::boards
