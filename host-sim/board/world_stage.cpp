#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "sim/motor_stage.h"
#include "sim/world.h"

namespace nplc::sim {

void World::set_input(unsigned index, bool level) {
    board_.set_input(index, level);
    wake();
}

void World::toggle_input(unsigned index) {
    set_input(index, (board_.inputs() >> index & 1) == 0);
}

void World::cut_line(bool cut) {
    if (drive_) return drive_->cut(cut);
    if (cut) {
        line_.cut();
    } else {
        line_.restore();
    }
}

void World::spoil_line(const action::SpoilLine& faults) {
    if (drive_) return drive_->spoil(faults);
    if (faults.to_motor) spoil(line_.to_motor(), faults);
    if (faults.from_motor) spoil(line_.from_motor(), faults);
}

void World::power_motor(bool on) {
    if (drive_) return drive_->power(on);
    if (on && !motor_powered_) {
        switch_on(mac_);
        motor_asks_ = std::max(now_, line_.from_motor().busy_until());
    }
    motor_powered_ = on;
}

void World::seed(std::uint64_t value) {
    line_.reseed(value);
    if (drive_) drive_->reseed(value);
}

void World::act(const action::OnMotor& what) {
    if (!drive_) return sim::act(mac_, what);
    if (const std::string_view missing = drive_->act(what); !missing.empty()) drive_has_no(missing);
}

bool World::shaft_is_blocked() const {
    if (drive_) return drive_->is_blocked();
    const Load& load = mac_.plant().load();
    const bool is_rigid = load.low_stop && load.high_stop && load.low_stop->spring_1024 == 0 &&
                          load.high_stop->spring_1024 == 0;
    return is_rigid && load.low_stop->counts >= load.high_stop->counts;
}

/// Reports the missing part; the scenario goes on.
void World::drive_has_no(std::string_view what) {
    log(fmt::format("the virtual {} drive does not have {}", options_.drive->model->family->name(), what));
}

void World::gateway(action::Gateway what) {
    wake();
    switch (what) {
        case action::Gateway::stop:
            controller_->sequence().stop(instant());
            follow_orders();
            return;
        case action::Gateway::run:
            static_cast<void>(controller_->sequence().run());
            return;
        case action::Gateway::restart:
            start_gateway(gateway::StartCause::power_up);
            return;
        case action::Gateway::safe:
            controller_->sequence().enter_safe_state_by_command(instant());
            follow_orders();
            return;
        case action::Gateway::hold:
            static_cast<void>(controller_->sequence().hold());
            return;
        case action::Gateway::step:
            static_cast<void>(controller_->sequence().step_once());
            return;
        case action::Gateway::scan:
            static_cast<void>(controller_->sequence().scan_once());
            return;
    }
}

void World::set_breakpoints(const action::Breakpoints& where) {
    wake();
    controller_->sequence().set_breakpoints(where.steps);
}

/// The scenario renews its forces, as a client does that stays.
void World::force(const action::ForceSignals& what) {
    wake();
    gateway::Gateway& sequence = controller_->sequence();
    registers::gateway::Force force = what.outputs ? sequence.forces().outputs() : sequence.forces().inputs();
    const auto mask = static_cast<std::uint8_t>(what.releases ? force.mask & ~unsigned{what.mask}
                                                              : force.mask | unsigned{what.mask});
    force.levels = static_cast<std::uint8_t>((force.levels & ~unsigned{what.mask}) | what.levels);
    if (what.releases && mask == force.mask) return;
    force.mask = mask;
    what.outputs ? sequence.force_outputs(force, instant()) : sequence.force_inputs(force, instant());
    renews_forces_ = renews_forces_ || !what.releases;
}

/// In sequence: each waits until the previous one is stored.
void World::set_points(const action::SetPoints& asked) {
    wake();
    waiting_.set_points.push_back(asked);
}

void World::refused(gateway::Result why) {
    log("refused: " + waiting_.set_points.front().text + ": " +
        std::string(registers::gateway::describe(why)));
}

/// The gateway restarts; a request in progress is stored or not.
void World::lose_set_points() {
    if (waiting_.writer && waiting_.writer->request != 0) {
        refused(gateway::Result::interrupted);
        waiting_.set_points.pop_front();
    }
    waiting_.writer.reset();
}

void World::serve_set_points() {
    while (!waiting_.set_points.empty()) {
        if (!waiting_.writer) waiting_.writer = {.origin = gateway::Origin::scenario, .since = instant()};
        const auto ended =
            controller_->set_points().serve(*waiting_.writer, waiting_.set_points.front().request, instant());
        if (!ended) return;
        if (!ended.is_done()) refused(static_cast<gateway::Result>(ended.word() & 0xFF));
        waiting_.writer.reset();
        waiting_.set_points.pop_front();
    }
}

std::string World::motor_note() const {
    return drive_ ? drive_->note(driver_) : std::string(mac_.note());
}

void World::log(const std::string& text) {
    if (on_log_) on_log_(text);
}

}  // namespace nplc::sim
