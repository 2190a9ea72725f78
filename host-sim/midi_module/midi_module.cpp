#include "sim/midi_module.h"

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
      eeprom_{factory_memory(model, options.can, options.imax)},
      supply_(midi::facts_of(model)),
      motion_(model, options.imax, inputs_, eeprom_, supply_,
              {.on_braking = [this] { check_supply(); }, .on_hard_stop = [this] { drop_prepared(); }}) {
    eeprom_.values.address = options.address;
}

void MidiModule::advance(Time to) {
    while (motion_.advance(to.count() / kNanosecondsPerTick)) look_at_switches();
}

bool MidiModule::take_boot() {
    if (!boot_pending_ || deaf()) return false;
    boot_pending_ = false;
    return true;
}

void MidiModule::start(Ticks deaf) {
    motion_.cut_power();
    drop_prepared();
    reference_enabled_ = false;
    supply_.forget_over_voltage();
    trips_ = 0;
    motion_.forget_end_stops();
    wants_restart_ = false;
    baud_code_ = eeprom_.values.baud_code;
    boot_pending_ = true;
    deaf_until_ = motion_.now() + deaf;
    check_world();
}

void MidiModule::restart() {
    if (factory_reset_) {
        const std::int32_t position = eeprom_.values.position;
        eeprom_.values = factory_memory(model_, options_.can, options_.imax);
        eeprom_.values.position = position;
        ++eeprom_.writes;
    }
    factory_reset_ = false;
    start(kDeafTicks);
}

void MidiModule::set_address(std::uint8_t address) {
    eeprom_.values.address = address;
    ++eeprom_.writes;
    boot_pending_ = true;
}

void MidiModule::power_off() {
    if (!is_on()) return;
    motion_.run_out();
    motion_.cut_power();
    supply_.switch_on(false);
}

void MidiModule::power_on() {
    if (is_on()) return;
    supply_.switch_on(true);
    motion_.set_position(eeprom_.values.position);
    start(kDeafTicks);
}

void MidiModule::set_memory(const MidiMemory& memory) {
    eeprom_.values = memory;
    baud_code_ = memory.baud_code;
    motion_.set_position(memory.position);
}

void MidiModule::set_input(Input input, bool active) {
    inputs_.disconnect(input);
    change_input(input, active);
}

void MidiModule::connect(Input input, bool on_above, std::int64_t at) {
    inputs_.connect(input, on_above, at);
    look_at_switches();
}

void MidiModule::look_at_switches() {
    for (const Input input : MidiInputs::kAll) {
        if (const auto active = inputs_.switched(input, shaft())) change_input(input, *active);
    }
}

void MidiModule::change_input(Input input, bool active) {
    if (!inputs_.set(input, active)) return;
    if (input == Input::security) {
        // 003 §IV: the input holds the module in reset; R: its release is a start.
        active ? motion_.cut_power() : start(kDeafTicks);
        return;
    }
    // 003 §IV: the position is 0 where the input goes inactive, turning clockwise.
    const bool finds_reference = input == Input::reference && !active && reference_enabled_;
    if (finds_reference && motion_.direction() > 0 && motion_.follows_profile()) motion_.set_origin();
}

void MidiModule::trip(std::uint32_t trip_bit) {
    // R: a MAC23 has one bit for all but the supply.
    if (model_ == Model::mac23 && trip_bit != midi::kSupplyTrip) trip_bit = midi::kThermalTrip23;
    trips_ |= trip_bit;
    drop_prepared();
    motion_.cut_power();
}

void MidiModule::check_supply() {
    supply_.check();
    if (supply_.trips_amplifier()) trip(midi::kAmplifierTrip);
    if (supply_.trips_supply()) trip(midi::kSupplyTrip);
}

/// Causes that persist trip again at once.
void MidiModule::check_world() {
    check_supply();
    if (temperature_ > midi::kMotorTrip) trip(midi::kThermalTrip);
    if (!encoder_) trip(midi::kEncoderTrip);
}

void MidiModule::set_supply(std::int32_t millivolts) {
    supply_.set(millivolts);
    if (is_on()) check_supply();
}

void MidiModule::set_temperature(std::int32_t thousandths) {
    temperature_ = thousandths;
    if (is_on()) check_world();
}

void MidiModule::connect_encoder(bool connected) {
    encoder_ = connected;
    if (is_on()) check_world();
}

bool MidiModule::fault() const {
    return is_on() && trips_ != 0;
}

std::uint32_t MidiModule::status() const {
    const bool has_kept_bit = options_.release >= 0x0704;
    return trips_ | motion_.stopped_by() | bit(supply_.warns_high(), midi::kOverVoltage) |
           bit(supply_.warns_low(), midi::kUnderVoltage) |
           bit(supply_.over_voltage_kept() && has_kept_bit, midi::kOverVoltageKept);
}

std::uint32_t MidiModule::measures() const {
    const std::uint32_t temperature = midi::measure_of_temperature(model_, temperature_);
    const std::uint32_t volts = midi::measure_of_supply(model_, supply());
    return temperature << 24 | volts << 16 | bit(input(Input::upper_stop), midi::kUpperInput) |
           bit(!busy(), midi::kNotBusy) | bit(input(Input::lower_stop), midi::kLowerInput) |
           bit(input(Input::reference), midi::kReferenceInput);
}

std::uint32_t MidiModule::settings() const {
    const std::uint32_t standby = eeprom_.values.standby ? 1 : 0;
    return std::uint32_t{eeprom_.values.ramp} << 24 | std::uint32_t{eeprom_.values.torque} << 16 |
           standby << 12 | std::uint32_t{eeprom_.values.stops} << 8 | eeprom_.values.tolerance;
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
            return static_cast<std::uint32_t>(position());
        case midi::GET_STATUS:
            return status();
        case midi::GET_UPPER_STOP:
            return static_cast<std::uint32_t>(eeprom_.values.upper_stop);
        case midi::GET_LOWER_STOP:
            return static_cast<std::uint32_t>(eeprom_.values.lower_stop);
        case midi::GET_RELEASE:
            return options_.release;
        case midi::GET_SPEEDS:
            return std::uint32_t{eeprom_.values.unstall} << 24 | eeprom_.values.period;
        case midi::GET_SETTINGS:
            return settings();
        case midi::GET_MEASURES:
            return measures();
        case midi::GET_RAM:  // R: 0 where the manuals name nothing
            return four(
                [this](unsigned at) { return at == midi::kImaxAddress ? std::uint32_t{options_.imax} : 0U; });
        default:
            return four(
                [image = eeprom_image(eeprom_.values)](unsigned at) { return std::uint32_t{image[at]}; });
    }
}

MidiModule::Leds MidiModule::leds() const {
    const std::int32_t mark = facts_of(model_).increments_per_rev / kTopZeros;
    const auto& facts = midi::facts_of(model_);
    return {.supply_good = is_on() && supply() >= facts.under_voltage && supply() <= facts.over_voltage,
            .fault = fault(),
            .catching_up = busy(),
            .top_zero = is_on() && position() % mark == 0,
            .ballast = is_on() && motion_.braking_is_cut()};
}

}  // namespace nplc::sim
