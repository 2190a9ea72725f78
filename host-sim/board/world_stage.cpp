#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "registers/details.h"
#include "sim/motor_stage.h"
#include "sim/without_effect.h"
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

/// What is set up before the run begins waits for its motor; later an action without an effect is told.
void World::tell_without_effect(const Action& action) {
    if (now_ == Time{0}) return;
    const std::string why =
        drive_ ? drive_->without_effect(action) : sim::without_effect(mac_, motor_powered_, action);
    if (!why.empty()) log(fmt::format("{}: nothing follows: {}", name_of(action), why));
}

void World::fail_motor() {
    tell_without_effect({.what = action::FailMotor{}});
    motor_fails_ = drive_ != nullptr || motor_powered_;
}

void World::power_motor(bool on) {
    tell_without_effect({.what = action::PowerMotor{on}});
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
    std::visit([this](const auto& one) { tell_without_effect({.what = one}); }, what);
    if (!drive_) return sim::act(mac_, what);
    if (const std::string_view missing = drive_->act(what); !missing.empty())
        log(lacks(*options_.drive->model, missing));
}

bool World::shaft_is_blocked() const {
    if (drive_) return drive_->is_blocked();
    const Load& load = mac_.plant().load();
    const bool is_rigid = load.low_stop && load.high_stop && load.low_stop->spring_1024 == 0 &&
                          load.high_stop->spring_1024 == 0;
    return is_rigid && load.low_stop->counts >= load.high_stop->counts;
}

void World::gateway(action::Gateway what) {
    wake();
    gateway::Gateway& sequence = controller_->sequence();
    const auto tell = [this](std::string_view word, const base::Status& begun) {
        if (!begun)
            log(fmt::format("gateway {}: refused: {}", word,
                            registers::gateway::describe(gateway::result_of(begun.error()))));
    };
    switch (what) {
        case action::Gateway::stop:
            if (sequence.run_state() == gateway::RunState::stopped)
                log("gateway stop: the sequence is stopped already");
            sequence.stop(instant());
            follow_orders();
            return;
        case action::Gateway::run:
            return tell("run", sequence.run());
        case action::Gateway::restart:
            start_gateway(gateway::StartCause::power_up);
            return;
        case action::Gateway::safe:
            sequence.enter_safe_state_by_command(instant());
            follow_orders();
            return;
        case action::Gateway::hold:
            if (!sequence.hold()) log("gateway hold: refused: the sequence does not run");
            return;
        case action::Gateway::step:
            return tell("step", sequence.step_once());
        case action::Gateway::scan:
            return tell("scan", sequence.scan_once());
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

namespace {

/// 001 §4.5.6: UV_HANDLE's UV_GO_PASSIVE sets no error.
bool is_passive_for_undervoltage(const MacMotor& motor, const FamilyBits& bits) {
    constexpr std::int32_t kUvGoPassive = 2;
    if ((motor.err_stat() & bits.uv_detect) == 0 || !motor.is_mode(MotorMode::init)) return false;
    return (motor.read(registers::find(motor.model(), "UV_HANDLE")->number) & kUvGoPassive) != 0;
}

/// Which errors keep a motor passive, by the manual's names; empty: none.
std::string faults_in_words(const MacMotor& motor) {
    constexpr std::uint32_t kInStatusByte = 0x0F;  // 001 §5.2.1.6
    const FamilyBits& bits = family_bits(motor.model());
    const std::uint32_t faults = motor.err_stat() & bits.keeps_init;
    if (faults == 0 && is_passive_for_undervoltage(motor, bits))
        return "UV_DETECT: the supply is too low, and UV_GO_PASSIVE in UV_HANDLE makes the motor passive; no "
               "ERROR for the sequence";
    if (faults == 0) return {};
    std::string text;
    for (const registers::Field& field : registers::fields_of(motor.model(), registers::ERR_STAT)) {
        if ((faults & mask_of(field)) == 0) continue;
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", field.name, field.meaning);
    }
    if ((faults & kInStatusByte) == 0)
        text +=
            "; no ERROR for the sequence: FastMAC's status tells of I2T_ERR, FLW_ERR, FNC_ERR and UIT_ERR "
            "only";
    return text;
}

}  // namespace

std::string World::motor_note() const {
    if (drive_) return drive_->note(driver_);
    std::string text = motor_powered_ ? faults_in_words(mac_) : std::string();
    if (text.empty()) text = mac_.note();
    return text;
}

void World::log(const std::string& text) {
    if (on_log_) on_log_(text);
}

}  // namespace nplc::sim
