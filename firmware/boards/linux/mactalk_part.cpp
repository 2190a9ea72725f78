#include "mactalk_part.h"

#include <algorithm>

namespace nplc::boards {

void MactalkPart::open(const std::string& path) {
    static_cast<void>(port_.emplace().open({.path = path, .baud = 19'200}));
}

ports::SerialPort* MactalkPart::start(motor::Motor& motor, std::uint8_t address) {
    if (!port_) return nullptr;
    motor_ = &motor;
    return &line_.emplace(port_->uart(), address, motor.longwords_only());
}

void MactalkPart::look(const gateway::Gateway& sequence, AxisJournal& journal, base::Instant now) {
    if (!line_) return;
    port_->look(journal, now);
    const bool is_wanted = sequence.stop_unconfirmed() && !motor::link_is_usable(motor_->link());
    if (!line_->stop(is_wanted, now)) return;
    motor_->give_up_stop();
    journal.write(LogLevel::notice, JournalEvent::stop_confirmed,
                  "the motor was stopped over its MacTalk port");
}

base::Instant MactalkPart::next_look(base::Instant now) const {
    return line_ ? std::min(port_->next_look(), line_->next_poll(now)) : base::kNever;
}

}  // namespace nplc::boards
