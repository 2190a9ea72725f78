#include "motor_part.h"

#include <fmt/format.h>

#include "gateway/settings_keeper.h"

namespace nplc::boards {
namespace {

/// Those that do not come and go with every braking (000 §VI 21h).
constexpr std::uint32_t kWarnings = registers::midi::kUnderVoltage | registers::midi::kOverVoltageKept;

}  // namespace

void MotorPart::open(const std::string& who, const MotorConfig& config, std::uint32_t jvl_baud) {
    config_ = config;
    if (config.is_on_can()) {
        if (!can_) can_.emplace().open(who, {.interface = config.can.text, .bitrate = config.bitrate});
        return;
    }
    const std::uint32_t baud = config.midi ? config.v24_baud : jvl_baud;
    static_cast<void>(
        uart_.emplace().open(who, {.path = config.port.text, .baud = baud, .rs485 = config.rs485}));
}

motor::Motor& MotorPart::start(const store::SettingValues& values) {
    driver_ = config_.midi ? &start_midi(*config_.midi) : &start_jvl(values);
    return *driver_;
}

motor::Motor& MotorPart::start_jvl(const store::SettingValues& values) {
    jvl_.reset();
    return jvl_.emplace(line_.emplace(uart_->uart()), gateway::driver_settings_of(values));
}

motor::Motor& MotorPart::start_midi(registers::midi::Model model) {
    midi_.reset();
    told_fault_ = motor::MidiFault::none;
    told_warnings_ = 0;
    motor::MidiLink* link = nullptr;
    if (can_)
        link = &on_can_.emplace(can_->can(), motor::MidiCanLink::Settings{.address = config_.midi_address});
    else
        link = &v24_.emplace(uart_->uart(), motor::MidiV24Link::Settings{.address = config_.midi_address,
                                                                         .baud = config_.v24_baud});
    return midi_.emplace(*link, motor::MidiMotor::Settings{.model = model});
}

std::string MotorPart::silence_in_words() const {
    const std::string line = config_.line_in_words();
    if (midi_ && midi_->fault() == motor::MidiFault::several) return loss_in_words();
    if (midi_ && midi_->probe().kind == motor::MidiOutcome::Kind::refused)
        return fmt::format(
            "something answers to {} and refuses to tell its status, which no MIDI drive does; is it another "
            "kind of device?",
            line);
    if (midi_ && midi_->probe().damaged)
        return fmt::format(
            "what comes from {} cannot be read; is the speed right, is there noise, or do two drives have "
            "this address?",
            line);
    return fmt::format("no motor has answered yet on {}; look at its supply, its line, and at [axis.motor]",
                       line);
}

std::string MotorPart::loss_in_words() const {
    using motor::MidiFault;
    const bool told = midi_ && midi_->fault() != MidiFault::none && midi_->fault() != MidiFault::link_lost;
    return fmt::format("{} on {}", told ? "no link to the motor" : "the motor does not answer",
                       config_.line_in_words());
}

std::vector<Said> MotorPart::news() {
    std::vector<Said> news;
    if (!midi_) return news;
    if (const motor::MidiFault fault = midi_->fault(); fault != told_fault_) {
        told_fault_ = fault;
        if (auto said = in_words(*midi_)) news.push_back(std::move(*said));
    }
    const std::uint32_t warnings = midi_->drive_status() & kWarnings;
    for (const registers::midi::Bit& bit : registers::midi::status_bits()) {
        if ((bit.mask & warnings & ~told_warnings_) != 0)
            news.push_back({LogLevel::warning, fmt::format("the drive warns: {}", bit.text)});
    }
    told_warnings_ = warnings;
    return news;
}

void MotorPart::watch(hal_linux::EventLoop& loop, std::uint32_t mark) {
    loop.watch(uart_ ? uart_->uart().descriptor() : can_->can().descriptor(), mark);
}

void MotorPart::ignore(hal_linux::EventLoop& loop) {
    if (uart_) loop.ignore(uart_->uart().descriptor());
}

bool MotorPart::look(Journal& journal, base::Instant now) {
    if (uart_) return uart_->look(journal, now);
    can_->look(journal, now);
    return false;
}

void MotorPart::open_line(base::Instant now) {
    if (line_) line_->open(now);
}

bool MotorPart::may_rest() const {
    return jvl_ && motor::delivers(driver_->link()) && driver_->settled() &&
           !motor::is_open(driver_->access_state()) && !uart_->gone();
}

}  // namespace nplc::boards
