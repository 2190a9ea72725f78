#include "sim/midi_module.h"

namespace nplc::sim {
namespace {

namespace midi = registers::midi;

constexpr std::size_t kMostActions = 10'000;

std::int32_t field(const midi::CommandRow& row, std::size_t number, std::uint32_t data) {
    return midi::unpack(row.fields[number], data);
}

}  // namespace

bool MidiModule::may_execute(const midi::CommandRow& row, std::uint32_t data) const {
    if (!(options_.can ? row.on_can : row.on_v24)) return false;
    if (!row.while_moving && moving()) return false;
    if (!row.with_fault && trips_ != 0) return false;
    if (row.number == midi::TORQUE && field(row, 0, data) > options_.imax) return false;
    return midi::is_legal(row, data);
}

bool MidiModule::execute(std::uint8_t number, std::uint8_t sub_index, std::uint32_t data) {
    if (!carry_out(number, sub_index, data)) return false;
    if (actions_.size() == kMostActions) actions_.pop_front();
    actions_.push_back({Time{motion_.now() * 125}, number, data});
    return true;
}

bool MidiModule::carry_out(std::uint8_t number, std::uint8_t sub_index, std::uint32_t data) {
    const midi::CommandRow* row = midi::find_command(number);
    if (row == nullptr || sub_index != 0 || !may_execute(*row, data))
        return false;  // R: sub-index, unused numbers
    switch (row->kind) {
        case midi::Kind::initialisation:
            factory_reset_ = number == midi::FACTORY;
            wants_restart_ = true;
            return true;
        case midi::Kind::parameter:
            return set_parameter(number, data);
        case midi::Kind::motion:
            break;
    }
    return armed_ && row->waits_for_sync ? prepare(number, data) : move(number, data);
}

bool MidiModule::set_parameter(std::uint8_t number, std::uint32_t data) {
    const midi::CommandRow& row = *midi::find_command(number);
    const std::int32_t value = row.fields[0].bits == 0 ? 0 : field(row, 0, data);
    MidiMemory memory = eeprom_.values;
    switch (number) {
        case midi::STOP_TORQUE:
            memory.standby = value == 1;
            break;
        case midi::END_STOPS:
            memory.stops = static_cast<std::uint8_t>(value);
            break;
        case midi::REFERENCE:
            reference_enabled_ = value == 1;
            break;
        case midi::ADDRESS:
            memory.address = static_cast<std::uint8_t>(value);
            break;
        case midi::UPPER_STOP:
            memory.upper_stop = value;
            break;
        case midi::LOWER_STOP:
            memory.lower_stop = value;
            break;
        case midi::ZERO_POSITION:
            motion_.set_origin();
            memory.position = eeprom_.values.position;
            break;
        case midi::TORQUE:
            memory.torque = static_cast<std::uint8_t>(value);
            break;
        case midi::SPEED:
            memory.period = static_cast<std::uint16_t>(value);
            break;
        case midi::UNSTALL:
            memory.unstall = static_cast<std::uint8_t>(value);
            break;
        case midi::RAMP:
            memory.ramp = static_cast<std::uint8_t>(value);
            break;
        case midi::BAUD:
            memory.baud_code = static_cast<std::uint8_t>(value);
            wants_restart_ = true;
            break;
        default:
            memory.tolerance = static_cast<std::uint8_t>(value);
            break;
    }
    eeprom_.write(memory);
    return true;
}

bool MidiModule::move(std::uint8_t number, std::uint32_t data) {
    switch (number) {
        case midi::WAIT_SYNC:
            armed_ = true;
            return true;
        case midi::SYNC:
            return sync();
        case midi::GO_TO:
        case midi::GO_TO_ZERO:
            motion_.go_to(number == midi::GO_TO ? static_cast<std::int32_t>(data) : 0);
            return true;
        case midi::RUN:
            return run(data);
        case midi::SEGMENT:
        case midi::PAUSE:
            return motion_.add_segment({number, data});
        case midi::STOP:
            if (motion_.follows_segments()) return false;  // 003 §VII 17h: only 13h, 14h, 15h
            motion_.ramp_down();
            return true;
        case midi::EMERGENCY_STOP:
            motion_.stop_hard();
            return true;
        case midi::POWER_ON:
            motion_.give_power();
            return true;
        default:
            motion_.cut_power();
            return true;
    }
}

/// R: of several the last one counts.
bool MidiModule::prepare(std::uint8_t number, std::uint32_t data) {
    prepared_ = MidiMotion::Segment{number, data};
    armed_ = false;
    return true;
}

/// R: without a prepared command there is no effect, and no refusal.
bool MidiModule::sync() {
    if (!is_on() || !prepared_ || deaf()) return true;
    const MidiMotion::Segment prepared = *prepared_;
    prepared_.reset();
    const midi::CommandRow& row = *midi::find_command(prepared.number);
    return may_execute(row, prepared.data) && move(prepared.number, prepared.data);
}

void MidiModule::drop_prepared() {
    prepared_.reset();
    armed_ = false;
}

bool MidiModule::run(std::uint32_t data) {
    const midi::CommandRow& row = *midi::find_command(midi::RUN);
    const int direction = field(row, 0, data) == midi::kTurnsLeft ? -1 : 1;
    return motion_.run(direction, static_cast<std::uint16_t>(field(row, 1, data)));
}

}  // namespace nplc::sim
