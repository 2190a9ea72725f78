#include "gateway/controller.h"

#include <algorithm>

namespace nplc::gateway {

Controller::Controller(const Ports& ports, const store::Area& tables, std::span<std::uint8_t> table,
                       SettingsManager& settings, StartCause cause)
    : motor_(ports.motor),
      registers_(sequence_, tables_, set_points_, settings, ports.shown_lines),
      user_port_(ports.user_line, ports.motor_mactalk_line, sequence_, ports.motor, registers_, settings),
      sequence_({ports.inputs, ports.outputs, ports.watchdog, ports.motor}, settings_of(settings.values()),
                cause),
      set_points_(sequence_, ports.storage, ports.set_points),
      tables_(sequence_, ports.motor, set_points_, ports.storage, tables, table) {
    settings.attach(sequence_);
    set_points_.mount();
    tables_.mount();
}

void Controller::poll(base::Instant now) {
    motor_.poll(now);
    sequence_.poll(now);
    registers_.poll();
    user_port_.poll(now);
}

void Controller::poll_after_edge(base::Instant now) {
    sequence_.poll(now);
    motor_.poll(now);
    registers_.poll();
    user_port_.poll(now);
}

base::Instant Controller::next_poll(base::Instant now, base::Instant motors) {
    const base::Instant next =
        std::min({sequence_.next_poll(now, motors), registers_.next_poll(now), user_port_.next_poll(now)});
    sequence_.expect_poll(next, now);
    return next;
}

}  // namespace nplc::gateway
