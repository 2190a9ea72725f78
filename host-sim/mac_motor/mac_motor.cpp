#include "sim/mac_motor.h"

namespace nplc::sim {
namespace {

protocol::fastmac::RegisterCode code_of(const MacMotorOptions& options) {
    using protocol::fastmac::RegisterCode;
    return options.old_register_codes ? RegisterCode::older_example : RegisterCode::format_list;
}

}  // namespace

MacMotor::MacMotor(registers::Model model, const MacMotorOptions& options)
    : options_(options),
      memory_(model),
      stored_(model),
      bits_(&family_bits(model)),
      servo_(model, options.depth, options.load),
      analogue_level_(model),
      link_(
          {.model = model, .baud = options.baud, .code = code_of(options), .log_limit = options.order_limit}),
      mactalk_(model) {
    write_defaults(stored_, options.address);
    power_cycle();
}

void MacMotor::power_cycle() {
    memory_ = stored_;
    clear_volatile(memory_);
    set_mode(number(MotorMode::init));
    constexpr std::uint32_t kKept = err::DIS_P_LIM;
    set_error_bits(~(kKept | bits().relpos_p_soll | bits().relpos_p_fnc), false);
    set_home_done(false);
    set_up_user_interface();
    link_.power_up();
    mactalk_.power_up();
    samples_.rewind();
    samples_.clear();
    v_history_.fill(0);
    v_sum_ = 0;
    v_old_ = v_from_ = samples_within_ = corrected_braking_ = 0;
    follow_error_16_ = 0;
    emergency_ = false;
    mode_after_stop_ = 0;
    servo_.power_up(memory_);
    gear_.reset();
    coil_.forget();
    analogue_level_ = AnalogueLevel(model());
    analogue_was_on_ = coasting_ = false;
    uv_timer_ = 0;
    note_ = {};
    request_mode(first_mode());
}

/// 001 §3.2.36: FastMAC and the pulse input share their pins. R: on MAC800, which has two channels and no
/// such bits (004), both are there.
void MacMotor::set_up_user_interface() {
    constexpr std::int32_t kUserInterface = 3, kCommunication = 3;
    const std::int32_t control = memory_.get(cell::CNTRL_BITS);
    link_on_ = is_mac800(model()) || (control & kUserInterface) == kCommunication;
    pulse_input_.configure(model(), control, memory_.get(cell::HW_SETUP));
}

/// 001 §3.2.42: only the homing modes are legal. R: another value is as 0.
std::uint16_t MacMotor::first_mode() const {
    const auto home = static_cast<std::uint16_t>(memory_.get(cell::HOME_MODE) & 0xFF);
    const ModeFacts* wanted = facts_of(home);
    return wanted != nullptr && wanted->homing() ? home
                                                 : static_cast<std::uint16_t>(memory_.get(cell::STARTMODE));
}

std::int32_t MacMotor::counts_per_revolution() const {
    return is_mac800(model()) ? 8000 : 4096;
}

std::chrono::nanoseconds MacMotor::sample_period() const {
    return std::chrono::nanoseconds(is_mac800(model()) ? 1'298'701 : 1'920'000);
}

double MacMotor::rpm() const {
    return 60e9 * v_ist() / (static_cast<double>(sample_period().count()) * counts_per_revolution());
}

void MacMotor::receive(std::uint8_t byte, bool framing_error, base::Instant now) {
    if (link_on_) link_.receive(byte, framing_error, now, *this);
}

std::optional<std::uint8_t> MacMotor::transmit(base::Instant now) {
    if (!link_on_) return std::nullopt;
    return link_.transmit(now, *this);
}

void MacMotor::sample() {
    measure();
    read_inputs();
    resynchronise();
    end_mode_by_itself();
    if (facts().homing()) search_home();
    if (is_driven()) {
        run_profile();
        judge_in_position();
    } else {
        stay_passive();
    }
    monitor();
    run_sample_buffer();
}

void MacMotor::measure() {
    const auto control = static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS));
    const bool watching = (control & bits().record) != 0 && records_inner(control);
    if (watching && (control & bits().rewind) != 0) rewind_samples();
    servo_.break_encoder(is_mac800(model()) && surroundings_.encoder_broken);
    servo_.plant().hold(brake_output());
    const std::int32_t v_ist = servo_.advance(memory_, terminals_, watching ? this : nullptr);
    memory_.set(cell::V_IST, v_ist);
    memory_.set(cell::P_IST, wrap32(std::int64_t{p_ist()} + v_ist));

    if (is_mac800(model())) show_v_ist_16(v_ist);
}

void MacMotor::show_v_ist_16(std::int32_t v_ist) {
    std::int32_t& oldest = v_history_[v_next_++ % v_history_.size()];
    v_sum_ += v_ist - oldest;
    oldest = v_ist;
    memory_.set(cell::V_IST_16, v_sum_);
}

// 001 §3.2.120, §3.2.122
void MacMotor::read_inputs() {
    const std::int32_t voltage = analogue_voltage_.of(model(), terminals_.millivolts(servo_.counts()));
    memory_.set(cell::ANINP, wrap32(std::int64_t{voltage} + memory_.get(cell::ANINP_OFFSET)));
    analogue_was_on_ = analogue_level_.on();
    analogue_level_.update(memory_.get(cell::ANINP));
    if (is_mac800(model())) {
        memory_.set(cell::DEGC, memory_.get(cell::DEGC) + surroundings_.degc());
        memory_.set(cell::U_24V, surroundings_.u_24v());
    }

    const std::int32_t pulses = terminals_.next_pulses(sample_period(), pulse_input_);
    if (!facts().counts_pulses) return;
    const std::int64_t turned = is_mode(MotorMode::coil) ? memory_.get(cell::V1[7]) : 0;  // 001 §4.4.20
    memory_.set(cell::V_EXT, wrap32(pulses + turned));
}

bool MacMotor::brake_output() const {
    constexpr std::int32_t kManNoBrake = 0x80;
    return is_mac800(model()) && facts().drive == Drive::Kind::shorted &&
           (memory_.get(cell::CNTRL_BITS) & kManNoBrake) == 0;
}

// 001 §3.2.163
void MacMotor::resynchronise() {
    const auto control = static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS));
    if ((control & bits().man_resync) != 0) {
        const bool relative = (control & bits().rel_resync) != 0;
        const std::int64_t p_new = memory_.get(cell::P_NEW);
        const auto move = [&](Cell position, std::int64_t by) {
            memory_.set(position, wrap32((relative ? memory_.get(position) : 0) + by));
        };
        move(cell::P_SOLL, p_new);
        move(cell::P_IST, p_new);
        move(cell::P_FNC, p_new * 16);
        memory_.set(cell::CNTRL_BITS, static_cast<std::int32_t>(control & ~bits().man_resync));
    }
    if (resynchronises_by_itself()) {
        memory_.set(cell::P_FNC, wrap32(16 * std::int64_t{p_ist()}));
    }
}

bool MacMotor::resynchronises_by_itself() const {
    const auto control = static_cast<std::uint32_t>(memory_.get(cell::CNTRL_BITS));
    return (control & bits().auto_resync) != 0 && (is_mode(MotorMode::init) || is_mode(MotorMode::safe));
}

/// Without speed regulator.
// R: P_FNC runs on with the shaft, so that a stop does not cost the motor its position.
void MacMotor::stay_passive() {
    if (!resynchronises_by_itself()) {
        const std::int64_t moved = 16 * std::int64_t{v_ist()} - follow_error_16_;
        memory_.set(cell::P_FNC, wrap32(memory_.get(cell::P_FNC) + moved));
    }
    follow_error_16_ = 0;
    memory_.set(cell::FLWERR, 0);
    memory_.set(cell::FNCERR, 0);
    go_on_from(0, false);
    servo_.carry_out(test_drive(), memory_);
    show_profile(0);
    clear_in_position();
}

}  // namespace nplc::sim
