#include "sim/motor_monitor.h"

namespace nplc::sim {
namespace {

// R: 004 gives no limits for these.
constexpr std::int32_t kLowBus = 135;     // U_BUS below 120 V
constexpr std::int32_t kHighBus = 506;    // U_BUS above 450 V (004), 0.888798 V each
constexpr std::int32_t kLowLogic = 1340;  // U_24V below 18 V
constexpr std::int64_t kFastest = 3600;   // rpm (004)
constexpr std::int32_t kAbove52V = 968;   // U_SUPPLY, 53.7 mV each (001 §3.2.18)

constexpr std::int32_t kSetUvErr = 1, kUvGoPassive = 2;

}  // namespace

void MotorMonitor::watch() {
    watch_limits();
    watch_supply();
    watch_currents();
    if (state_.is_mac800()) watch_mac800();
}

// 001 §4.5.1 to §4.5.5
void MotorMonitor::watch_limits() {
    if (is_above(cell::I2T, cell::I2TLIM)) modes_.fail(err::I2T_ERR);
    const auto feeds_back = [&] { return state_.is_mac800() || memory_.get(cell::U_SUPPLY) > kAbove52V; };
    if (is_above(cell::UIT, cell::UITLIM) && feeds_back()) modes_.fail(err::UIT_ERR);
    if (exceeds(cell::FLWERR, cell::FLWERRMAX)) modes_.fail(err::FLW_ERR);
    if (exceeds(cell::FNCERR, cell::FNCERRMAX)) modes_.fail(err::FNC_ERR);
    const std::int32_t low = memory_.get(cell::MIN_P_IST);
    const std::int32_t high = memory_.get(cell::MAX_P_IST);
    const bool limited = (low != 0 || high != 0) && (state_.error_status() & err::DIS_P_LIM) == 0;
    if (limited && (state_.p_ist() < low || state_.p_ist() > high)) modes_.fail(err::PLIM_ERR);
}

// 001 §4.5.6. R: UV_V_SOLL0 acts if the bit is set; MAC800, whose UVMIN is "not used", has its own limit.
void MotorMonitor::watch_supply() {
    const std::int64_t voltage = memory_.get(cell::U_SUPPLY);
    const std::int64_t least = state_.is_mac800() ? kLowBus : memory_.get(cell::U_MIN_SUP);
    if (uv_timer_ == 0 && 4 * voltage > 5 * least)
        return state_.set_error_bits(state_.bits().uv_detect, false);
    const bool low = voltage < least;
    const bool well = state_.is_mode(MotorMode::init) ? 4 * voltage >= 5 * least : 4 * voltage > 5 * least;
    if (uv_timer_ > 0) --uv_timer_;
    if (low || (!well && state_.is_mode(MotorMode::init))) {
        constexpr std::int64_t kSecond = 1'000'000'000;
        uv_timer_ = static_cast<std::int32_t>((kSecond + state_.sample_period().count() - 1) /
                                              state_.sample_period().count());
        state_.set_error_bits(state_.bits().uv_detect, true);
    } else if (well && uv_timer_ == 0) {
        state_.set_error_bits(state_.bits().uv_detect, false);
    }
    if (!low) return;
    const std::int32_t handle = memory_.get(cell::UV_HANDLE);
    if ((handle & kSetUvErr) != 0) state_.set_error_bits(state_.bits().uv_err, true);
    if ((static_cast<std::uint32_t>(handle) & state_.bits().uv_v_soll_0) != 0) memory_.set(cell::V_SOLL, 0);
    if ((handle & kUvGoPassive) != 0) modes_.go_passive(true);
}

// 001 §3.2.35 bit 11: IX_ERR is only shown and does not stop the motor. MAC800's IPEAK_ERR does (R).
void MotorMonitor::watch_currents() {
    if (!servo_.current_at_the_end()) return;
    if (state_.is_mac800()) return modes_.fail(state_.bits().over_current);
    state_.set_error_bits(state_.bits().over_current, true);
}

void MotorMonitor::watch_mac800() {
    if (state_.speed() > state_.speed_at(kFastest)) modes_.fail(err800::SPEED_ERR);
    if (is_above(cell::DEGC, cell::DEGCMAX)) modes_.fail(err800::DEGC_ERR);
    if (memory_.get(cell::U_SUPPLY) > kHighBus) modes_.fail(err800::OV_ERR);
    if (memory_.get(cell::U_24V) < kLowLogic) modes_.fail(err800::U24V_ERR);
    state_.set_error_bits(err800::OLD_FILT_ERR, !servo_.filters_answer());  // R: shown only
    if (surroundings_.encoder_broken) modes_.fail(err800::INDEX_ERR);
}

}  // namespace nplc::sim
