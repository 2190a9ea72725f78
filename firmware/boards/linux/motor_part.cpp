#include "motor_part.h"

#include <fmt/format.h>

#include <utility>

#include "drive_support.h"
#include "gateway/settings_manager.h"

namespace nplc::boards {

void MotorPart::open(const MotorConfig& config, std::uint32_t set_baud) {
    config_ = config;
    JournalFields lost = cause_field(gateway::SafeReason::link_down);
    if (config.is_on_can()) {
        if (!can_)
            can_.emplace().open({.interface = config.can.text, .bitrate = config.bitrate}, std::move(lost));
        return;
    }
    const std::uint32_t baud = config.baud.value_or(set_baud);
    static_cast<void>(uart_.emplace().open({.path = config.port.text, .baud = baud, .rs485 = config.rs485},
                                           std::move(lost)));
}

motor::Motor& MotorPart::start(const store::SettingValues& values) {
    motor::DriverSettings settings = gateway::driver_settings_of(values);
    settings.baud = config_.baud.value_or(settings.baud);
    motor::DriverPorts ports;
    if (can_)
        ports.can = &can_->can();
    else if (support_of(config_).streams_status())
        ports.serial = &line_.emplace(uart_->uart());
    else
        ports.serial = &uart_->uart();
    told_fault_ = 0;
    told_warnings_ = 0;
    motor_ = &driver_.start(ports, settings);
    return *motor_;
}

std::string MotorPart::silence_in_words() const {
    const std::string line = config_.line_in_words();
    std::string why = support_of(config_).silence_in_words(driver_, line);
    if (why.empty()) why = support_of(config_).loss_in_words(driver_, line);
    if (!why.empty()) return why;
    return fmt::format("no motor has answered yet on {}; look at its supply, its line, and at [axis.motor]",
                       line);
}

std::string MotorPart::loss_in_words() const {
    std::string why = support_of(config_).loss_in_words(driver_, config_.line_in_words());
    if (!why.empty()) return why;
    const bool has_cause = support_of(config_).fault_in_words(driver_).has_value();
    return fmt::format("{} on {}", has_cause ? "no link to the motor" : "the motor does not answer",
                       config_.line_in_words());
}

std::vector<LogMessage> MotorPart::news() {
    const DriveSupport& support = support_of(config_);
    std::vector<LogMessage> news;
    if (const std::uint8_t fault = support.fault(driver_); fault != told_fault_) {
        told_fault_ = fault;
        if (auto said = support.fault_in_words(driver_)) news.push_back(std::move(*said));
    }
    const std::uint32_t warnings = support.warnings(driver_);
    for (std::uint32_t left = warnings & ~told_warnings_; left != 0; left &= left - 1)
        news.push_back({LogLevel::warning,
                        fmt::format("the drive warns: {}", support.warning_in_words(left & (~left + 1)))});
    told_warnings_ = warnings;
    return news;
}

void MotorPart::watch(hal_linux::EventLoop& loop, std::uint32_t mark) {
    loop.watch(uart_ ? uart_->uart().descriptor() : can_->can().descriptor(), mark);
}

void MotorPart::ignore(hal_linux::EventLoop& loop) {
    if (uart_) loop.ignore(uart_->uart().descriptor());
}

bool MotorPart::look(AxisJournal& journal, base::Instant now) {
    if (uart_) return uart_->look(journal, now);
    can_->look(journal, now);
    return false;
}

void MotorPart::open_line(base::Instant now) {
    if (line_) line_->open(now);
}

bool MotorPart::needs_no_watch() const {
    return line_ && motor::link_is_usable(motor_->link()) && motor_->orders_complete() &&
           !motor::is_open(motor_->access_state()) && !uart_->gone();
}

}  // namespace nplc::boards
