#include "sim/midi_module.h"

#include <algorithm>

#include "registers/midi_scale.h"

namespace nplc::sim {
namespace {

namespace midi = registers::midi;

constexpr std::int64_t kNanosecondsPerTick = 125;
constexpr std::int64_t kDeafTicks = 2 * std::int64_t{midi::kTicksPerSecond};  // 000 §VI 00h
constexpr std::int32_t kTopZeros = 50;                                        // 003 §IV

constexpr std::uint32_t bit(bool is_set, std::uint32_t mask) {
    return is_set ? mask : 0;
}

}  // namespace

MidiModule::MidiModule(Model model, const MidiOptions& options)
    : model_(model),
      options_(options),
      memory_(factory_memory(model, options.can, options.imax)),
      shaft_(midi::facts_of(model).increments_per_rev, options.imax),
      supply_(midi::facts_of(model).max_supply * 3 / 5) {
    memory_.address = options.address;
}

void MidiModule::advance(Time to) {
    const Ticks until = to.count() / kNanosecondsPerTick;
    for (;;) {
        const bool drags = next_drag_ && *next_drag_ <= until && !(next_step_ && *next_step_ < *next_drag_);
        std::optional<Ticks>& next = drags ? next_drag_ : next_step_;
        if (!next || *next > until) break;
        ticks_ = std::max(ticks_, *next);
        next.reset();
        drags ? drag() : step();
        look_at_switches();
    }
    ticks_ = std::max(ticks_, until);
}

bool MidiModule::take_boot() {
    if (!boot_pending_ || deaf()) return false;
    boot_pending_ = false;
    return true;
}

void MidiModule::start(Ticks deaf) {
    cut_power();
    prepared_.reset();
    armed_ = reference_enabled_ = over_voltage_kept_ = false;
    trips_ = stopped_by_ = 0;
    wants_restart_ = false;
    baud_code_ = memory_.baud_code;
    boot_pending_ = true;
    deaf_until_ = ticks_ + deaf;
    check_world();
}

void MidiModule::restart() {
    if (factory_reset_) {
        const std::int32_t position = memory_.position;
        memory_ = factory_memory(model_, options_.can, options_.imax);
        memory_.position = position;
        ++memory_writes_;
    }
    factory_reset_ = false;
    start(kDeafTicks);
}

void MidiModule::set_address(std::uint8_t address) {
    memory_.address = address;
    ++memory_writes_;
    boot_pending_ = true;
}

void MidiModule::power_off() {
    if (!on_) return;
    run_out();
    cut_power();
    on_ = false;
}

void MidiModule::power_on() {
    if (on_) return;
    on_ = true;
    position_ = set_point_ = goal_ = memory_.position;
    start(kDeafTicks);
}

void MidiModule::set_memory(const MidiMemory& memory) {
    memory_ = memory;
    baud_code_ = memory.baud_code;
    position_ = set_point_ = goal_ = memory.position;
}

void MidiModule::remember() {
    if (memory_.position == position_) return;
    memory_.position = position_;
    ++memory_writes_;
}

void MidiModule::set_input(Input which, bool active) {
    switches_[index(which)].reset();
    change_input(which, active);
}

void MidiModule::connect(Input input, bool on_above, std::int64_t at) {
    switches_[index(input)] = Switch{at, on_above};
    look_at_switches();
}

void MidiModule::look_at_switches() {
    for (const Input input : {Input::upper_stop, Input::lower_stop, Input::reference, Input::security}) {
        const std::optional<Switch>& connected = switches_[index(input)];
        if (connected)
            change_input(input, connected->on_above ? shaft() > connected->at : shaft() < connected->at);
    }
}

void MidiModule::change_input(Input which, bool active) {
    bool& level = inputs_[index(which)];
    const bool released = level && !active;
    if (level == active) return;
    level = active;
    if (which == Input::security) {
        // 003 §IV: it holds the module in reset; R: a release is a start.
        active ? cut_power() : start(kDeafTicks);
        return;
    }
    // 003 §IV: the position is 0 where the input goes inactive, turning clockwise.
    if (which == Input::reference && released && reference_enabled_ && direction_ > 0 && profile_.running())
        set_origin();
}

void MidiModule::trip(std::uint32_t trip_bit) {
    // R: a MAC23 has one bit for all but the supply.
    if (model_ == Model::mac23 && trip_bit != midi::kSupplyTrip) trip_bit = midi::kThermalTrip23;
    trips_ |= trip_bit;
    prepared_.reset();
    armed_ = false;
    cut_power();
}

void MidiModule::check_supply() {
    const auto& facts = midi::facts_of(model_);
    over_voltage_kept_ = over_voltage_kept_ || supply() >= facts.over_voltage;
    if (std::int64_t{supply()} * 100 > std::int64_t{facts.max_supply} * midi::kTripPercent)
        trip(midi::kAmplifierTrip);
    if (supply() < midi::kLeastSupply) trip(midi::kSupplyTrip);
}

/// Causes that are still there trip again at once.
void MidiModule::check_world() {
    check_supply();
    if (temperature_ > midi::kMotorTrip) trip(midi::kThermalTrip);
    if (!encoder_) trip(midi::kEncoderTrip);
}

void MidiModule::set_supply(std::int32_t millivolts) {
    supply_ = millivolts;
    if (on_) check_supply();
}

void MidiModule::set_temperature(std::int32_t thousandths) {
    temperature_ = thousandths;
    if (on_) check_world();
}

void MidiModule::connect_encoder(bool connected) {
    encoder_ = connected;
    if (on_) check_world();
}

bool MidiModule::moving() const {
    if (mode_ == Mode::coast || profile_.running()) return true;
    return busy() && adjusts();
}

std::uint8_t MidiModule::torque() const {
    if (!powered_) return 0;
    return memory_.standby && !moving() ? static_cast<std::uint8_t>(memory_.torque / 2) : memory_.torque;
}

bool MidiModule::busy() const {
    if (!on_ || !powered_) return false;
    if (mode_ == Mode::run) return stalled_;
    if (mode_ == Mode::segments) return std::abs(position_ - set_point_) > memory_.tolerance;
    return mode_ == Mode::position && std::abs(position_ - goal_) > memory_.tolerance;
}

bool MidiModule::fault() const {
    return on_ && trips_ != 0;
}

std::uint32_t MidiModule::status() const {
    const auto& facts = midi::facts_of(model_);
    const bool has_kept_bit = options_.release >= 0x0704;
    return trips_ | stopped_by_ | bit(supply() >= facts.over_voltage, midi::kOverVoltage) |
           bit(supply() <= facts.under_voltage, midi::kUnderVoltage) |
           bit(over_voltage_kept_ && has_kept_bit, midi::kOverVoltageKept);
}

std::uint32_t MidiModule::measures() const {
    const std::uint32_t temperature = midi::measure_of_temperature(model_, temperature_);
    const std::uint32_t volts = midi::measure_of_supply(model_, supply());
    return temperature << 24 | volts << 16 | bit(input(Input::upper_stop), midi::kUpperInput) |
           bit(!busy(), midi::kNotBusy) | bit(input(Input::lower_stop), midi::kLowerInput) |
           bit(input(Input::reference), midi::kReferenceInput);
}

std::uint32_t MidiModule::settings() const {
    const std::uint32_t standby = memory_.standby ? 1 : 0;
    return std::uint32_t{memory_.ramp} << 24 | std::uint32_t{memory_.torque} << 16 | standby << 12 |
           std::uint32_t{memory_.stops} << 8 | memory_.tolerance;
}

std::optional<std::uint32_t> MidiModule::answer(std::uint8_t query, std::uint8_t sub_index) const {
    const midi::QueryRow* row = midi::find_query(query);
    if (row == nullptr || !(options_.can ? row->on_can : row->on_v24)) return std::nullopt;
    if (!row->at_address && sub_index != 0) return std::nullopt;  // R
    const auto four = [sub_index](const auto& byte_at) {
        std::uint32_t value = 0;
        for (unsigned i = 0; i < 4; ++i) value = value << 8 | byte_at((sub_index + i) & 0xFF);  // R: wraps
        return value;
    };
    switch (query) {
        case midi::GET_POSITION:
            return static_cast<std::uint32_t>(position_);
        case midi::GET_STATUS:
            return status();
        case midi::GET_UPPER_STOP:
            return static_cast<std::uint32_t>(memory_.upper_stop);
        case midi::GET_LOWER_STOP:
            return static_cast<std::uint32_t>(memory_.lower_stop);
        case midi::GET_RELEASE:
            return options_.release;
        case midi::GET_SPEEDS:
            return std::uint32_t{memory_.unstall} << 24 | memory_.period;
        case midi::GET_SETTINGS:
            return settings();
        case midi::GET_MEASURES:
            return measures();
        case midi::GET_RAM:  // R: 0 where the manuals name nothing
            return four(
                [this](unsigned at) { return at == midi::kImaxAddress ? std::uint32_t{options_.imax} : 0U; });
        default:
            return four([image = eeprom_image(memory_)](unsigned at) { return std::uint32_t{image[at]}; });
    }
}

MidiModule::Leds MidiModule::leds() const {
    const auto& facts = midi::facts_of(model_);
    const std::int32_t mark = facts_of(model_).increments_per_rev / kTopZeros;
    return {.supply_good = on_ && supply() >= facts.under_voltage && supply() <= facts.over_voltage,
            .fault = fault(),
            .catching_up = busy(),
            .top_zero = on_ && position_ % mark == 0,
            .ballast = on_ && braking_is_cut()};
}

}  // namespace nplc::sim
