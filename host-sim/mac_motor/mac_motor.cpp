#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

// 001 §4.4.16: special values of MODE_REG, in SAFE_MODE only.
constexpr std::uint16_t kDefaultsToFlash = 256;
constexpr std::uint16_t kDefaults = 257;
constexpr std::uint16_t kStoredAgain = 258;

/// Not parameters: values that the motor itself counts and shows, which are not stored in flash.
constexpr Cell kVolatile[] = {cell::P_SOLL, cell::P_FNC,   cell::P_IST,  cell::V_IST,    cell::FLWERR,
                              cell::FNCERR, cell::FNC_OUT, cell::VF_OUT, cell::MODE_REG, cell::I2T,
                              cell::UIT,    cell::V_EXT,   cell::G_FNC,  cell::REC_CNT};

void clear_volatile(MotorMemory& memory) {
    for (const Cell& volatile_cell : kVolatile) memory.set(volatile_cell, 0);
}

/// The bits of ERR_STAT that are settings (001 §3.2.35).
std::uint32_t setting_bits(const FamilyBits& bits) {
    return err::DIS_P_LIM | bits.relpos_p_soll | bits.relpos_p_fnc;
}

protocol::fastmac::RegisterCode code_of(const MacMotorOptions& options) {
    using protocol::fastmac::RegisterCode;
    return options.old_register_codes ? RegisterCode::older_example : RegisterCode::format_list;
}

}  // namespace

MacMotor::MacMotor(registers::Model model, const MacMotorOptions& options)
    : options_(options),
      state_(model),
      stored_(model),
      servo_(model, options.depth, options.load),
      inputs_(state_),
      profile_(state_, inputs_, servo_),
      modes_(state_, profile_, inputs_, servo_),
      monitor_(state_, modes_, servo_, inputs_.surroundings),
      commands_(state_, profile_, modes_),
      recorder_(state_, servo_, options.depth == Servo::Depth::current_loop),
      link_(
          {.model = model, .baud = options.baud, .code = code_of(options), .log_limit = options.order_limit}),
      mactalk_(model) {
    write_defaults(stored_, options.address);
    power_cycle();
}

void MacMotor::power_cycle() {
    state_.memory = stored_;
    clear_volatile(state_.memory);
    state_.set_mode(number(MotorMode::init));
    state_.set_error_bits(~setting_bits(state_.bits()), false);
    link_on_ = has_user_interface();
    inputs_.power_up();
    link_.power_up();
    mactalk_.power_up();
    recorder_.power_up();
    v_history_.fill(0);
    v_sum_ = 0;
    servo_.power_up(state_.memory);
    profile_.power_up();
    modes_.power_up();
    monitor_.power_up();
    modes_.request_mode(first_mode());
}

/// 001 §3.2.36: FastMAC and the pulse input share their pins. R: MAC800 has two channels and no such bits
/// (004), so both are available.
bool MacMotor::has_user_interface() const {
    constexpr std::int32_t kUserInterface = 3, kCommunication = 3;
    return state_.is_mac800() || (state_.memory.get(cell::CNTRL_BITS) & kUserInterface) == kCommunication;
}

/// 001 §3.2.42: only the homing modes are legal. R: another value is as 0.
std::uint16_t MacMotor::first_mode() const {
    const auto home = static_cast<std::uint16_t>(state_.memory.get(cell::HOME_MODE) & 0xFF);
    const ModeFacts* wanted = facts_of(home);
    return wanted != nullptr && wanted->homing()
               ? home
               : static_cast<std::uint16_t>(state_.memory.get(cell::STARTMODE));
}

double MacMotor::rpm() const {
    return 60e9 * v_ist() / (static_cast<double>(sample_period().count()) * counts_per_revolution());
}

void MacMotor::sample() {
    measure();
    inputs_.read(servo_.counts());
    profile_.resynchronise();
    modes_.end_mode_by_itself();
    if (state_.facts().homing()) modes_.search_home();
    if (state_.facts().driven()) {
        profile_.run();
        profile_.judge_in_position();
    } else {
        profile_.stay_passive(modes_.test_drive());
    }
    monitor_.watch();
    recorder_.end_sample();
}

void MacMotor::coast() {
    servo_.plant().hold(state_.is_mac800());
    state_.memory.set(cell::V_IST, servo_.coast());
    state_.memory.set(cell::VF_OUT, 0);
}

void MacMotor::measure() {
    InnerWatcher* watcher = recorder_.begin_sample();
    servo_.break_encoder(state_.is_mac800() && inputs_.surroundings.encoder_broken);
    servo_.plant().hold(brake_output());
    const std::int32_t v_ist = servo_.advance(state_.memory, inputs_.terminals, watcher);
    state_.memory.set(cell::V_IST, v_ist);
    state_.memory.set(cell::P_IST, wrap32(std::int64_t{p_ist()} + v_ist));

    if (state_.is_mac800()) show_v_ist_16(v_ist);
}

void MacMotor::show_v_ist_16(std::int32_t v_ist) {
    std::int32_t& oldest = v_history_[v_next_++ % v_history_.size()];
    v_sum_ += v_ist - oldest;
    oldest = v_ist;
    state_.memory.set(cell::V_IST_16, v_sum_);
}

bool MacMotor::brake_output() const {
    constexpr std::int32_t kManNoBrake = 0x80;
    return state_.is_mac800() && state_.facts().drive == Drive::Kind::shorted &&
           (state_.memory.get(cell::CNTRL_BITS) & kManNoBrake) == 0;
}

void MacMotor::receive(std::uint8_t byte, bool framing_error, base::Instant now) {
    if (link_on_) link_.receive(byte, framing_error, now, *this);
}

std::optional<std::uint8_t> MacMotor::transmit(base::Instant now) {
    if (!link_on_) return std::nullopt;
    return link_.transmit(now, *this);
}

void MacMotor::receive_mactalk(std::uint8_t byte, bool framing_error) {
    mactalk_.receive(byte, framing_error, *this);
}

std::optional<std::uint8_t> MacMotor::transmit_mactalk() {
    return mactalk_.transmit();
}

void MacMotor::show_framing_error(bool seen) {
    if (state_.bits().frame_err_tx != 0) state_.set_error_bits(state_.bits().frame_err_tx, seen);
}

std::uint8_t MacMotor::my_address() const {
    return static_cast<std::uint8_t>(state_.memory.get(cell::MYADDR));
}

std::uint32_t MacMotor::read_register(std::uint8_t reg, bool longword) const {
    return state_.memory.read(reg, longword);
}

void MacMotor::write_register(std::uint8_t reg, std::uint32_t value, bool longword) {
    const std::uint16_t mode_before = mode();
    state_.memory.write(reg, value, longword);
    const auto touches = [&](Cell cell) {
        const int words = longword && !state_.is_mac800() ? 2 : 1;
        const int last = cell.small + (cell.kind == Cell::Kind::long_int && !state_.is_mac800() ? 1 : 0);
        return reg <= last && reg + words > cell.small;
    };
    if (touches(cell::FLWERR)) profile_.take_follow_error();
    if (touches(cell::MODE_REG)) {
        const std::uint16_t wanted = mode();
        state_.set_mode(mode_before);
        if (in_safe_mode())
            load_parameters(wanted);
        else
            modes_.request_mode(wanted);
    }
    commands_.act_on_pointers();
}

std::int32_t MacMotor::read(std::uint8_t reg) const {
    if (reg == 0) return 0;
    const registers::Register* entry = registers::find(model(), reg);
    const bool wide = state_.is_mac800() || (entry != nullptr && registers::is_32_bit(entry->format));
    const std::uint32_t value = state_.memory.read(reg, wide);
    const bool has_sign = entry != nullptr && entry->min < 0;
    return !wide && has_sign ? static_cast<std::int16_t>(value) : static_cast<std::int32_t>(value);
}

void MacMotor::write(std::uint8_t reg, std::int32_t value, bool longword) {
    write_register(reg, static_cast<std::uint32_t>(value), longword);
}

void MacMotor::write(std::uint8_t reg, std::int32_t value) {
    const registers::Register* entry = registers::find(model(), reg);
    write(reg, value, state_.is_mac800() || (entry != nullptr && registers::is_32_bit(entry->format)));
}

// Functions available over MacTalk only: entering and leaving SAFE_MODE, flash, reset (001 §4.4.16, §5.1).

bool MacMotor::enter_safe_mode() {
    if (!is_mode(MotorMode::init)) return false;
    state_.set_mode(number(MotorMode::safe));
    return true;
}

bool MacMotor::leave_safe_mode() {
    if (!is_mode(MotorMode::safe)) return false;
    state_.set_mode(number(MotorMode::init));
    return true;
}

void MacMotor::go_to_init() {
    if (!leave_safe_mode()) modes_.request_mode(number(MotorMode::init));
}

bool MacMotor::write_flash() {
    if (!is_mode(MotorMode::safe)) return false;
    store_registers();
    ++flash_writes_;
    power_cycle();
    return true;
}

bool MacMotor::reset() {
    if (!is_mode(MotorMode::safe) && !is_mode(MotorMode::init)) return false;
    power_cycle();
    return true;
}

void MacMotor::store_registers() {
    const std::int32_t version = stored_.get(cell::PROG_VERSION);  // 001 §3.2.1: not to be stored
    stored_ = state_.memory;
    clear_volatile(stored_);
    stored_.set(cell::PROG_VERSION, version);
    stored_.set(cell::ERR_STAT, static_cast<std::int32_t>(error_status() & setting_bits(state_.bits())));
}

void MacMotor::load_parameters(std::uint16_t command) {
    MotorMemory wanted = stored_;
    if (command == kDefaultsToFlash || command == kDefaults) {
        wanted = MotorMemory(model());
        write_defaults(wanted, options_.address);
    }
    if (command == kDefaultsToFlash) {
        stored_ = wanted;
        ++flash_writes_;
        return power_cycle();
    }
    if (command != kDefaults && command != kStoredAgain) return;
    for (const Cell& volatile_cell : kVolatile) wanted.set(volatile_cell, state_.memory.get(volatile_cell));
    wanted.set(cell::ERR_STAT, state_.memory.get(cell::ERR_STAT));
    state_.memory = wanted;
}

}  // namespace nplc::sim
