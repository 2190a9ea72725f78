#pragma once

#include <chrono>
#include <cstdint>

#include "registers/mac.h"
#include "sim/mode_table.h"
#include "sim/motor_memory.h"

namespace nplc::sim {

/// ERR_STAT bits that MAC50-141 (001 §3.2.35) and MAC800 (004) share.
namespace err {
inline constexpr std::uint32_t I2T_ERR = 1U << 0, FLW_ERR = 1U << 1, FNC_ERR = 1U << 2, UIT_ERR = 1U << 3,
                               IN_POS = 1U << 4, ACC_FLAG = 1U << 5, DEC_FLAG = 1U << 6, PLIM_ERR = 1U << 7,
                               DIS_P_LIM = 1U << 14;
}  // namespace err

/// ERR_STAT bits that only MAC800 has (004).
namespace err800 {
inline constexpr std::uint32_t DEGC_ERR = 1U << 8, OV_ERR = 1U << 11, SPEED_ERR = 1U << 13,
                               INDEX_ERR = 1U << 15, OLD_FILT_ERR = 1U << 16, U24V_ERR = 1U << 17;
}  // namespace err800

/// Bits whose position differs between the families. A mask of 0: the family has no such bit.
struct FamilyBits {
    std::uint32_t frame_err_tx;  ///< ERR_STAT
    std::uint32_t uv_err;        ///< ERR_STAT
    std::uint32_t uv_detect;     ///< ERR_STAT
    std::uint32_t over_current;  ///< ERR_STAT: IX_ERR, MAC800 IPEAK_ERR
    std::uint32_t uv_v_soll_0;   ///< UV_HANDLE
    std::uint32_t keeps_init;    ///< ERR_STAT: errors that forbid leaving INIT (R)
    std::uint32_t resettable;    ///< ERR_STAT: cleared by "reset error" (R)
    bool relpos_in_cntrl_bits;   ///< else in ERR_STAT
    std::uint32_t relpos_p_soll;
    std::uint32_t relpos_p_fnc;
    std::uint32_t auto_resync;  ///< CNTRL_BITS
    std::uint32_t man_resync;
    std::uint32_t rel_resync;
    std::uint32_t record;  ///< CNTRL_BITS
    std::uint32_t rewind;
    std::uint32_t record_inner;
    std::uint32_t index_home;
    std::uint32_t home_done;       ///< HOME_MODE
    std::int32_t counts_to_index;  ///< from one index marker to the next
};

inline constexpr FamilyBits kSmallBits{.frame_err_tx = 1U << 8,
                                       .uv_err = 1U << 12,
                                       .uv_detect = 1U << 13,
                                       .over_current = 1U << 11,
                                       .uv_v_soll_0 = 1U << 3,
                                       .keeps_init = 0x0F | 1U << 7 | 1U << 12,
                                       .resettable = 0x0F | 1U << 7 | 1U << 11 | 1U << 12,
                                       .relpos_in_cntrl_bits = false,
                                       .relpos_p_soll = 1U << 9,
                                       .relpos_p_fnc = 1U << 10,
                                       .auto_resync = 1U << 9,
                                       .man_resync = 1U << 10,
                                       .rel_resync = 1U << 12,
                                       .record = 1U << 6,
                                       .rewind = 1U << 7,
                                       .record_inner = 1U << 8,
                                       .index_home = 1U << 11,
                                       .home_done = 0,
                                       .counts_to_index = 2048};

/// MAC800's additional errors: 8 temperature, 9 undervoltage, 11 overvoltage, 12 current, 13 speed, 15
/// encoder, 17 24 V.
inline constexpr FamilyBits kMac800Bits{.frame_err_tx = 0,
                                        .uv_err = 1U << 9,
                                        .uv_detect = 1U << 10,
                                        .over_current = 1U << 12,
                                        .uv_v_soll_0 = 1U << 2,
                                        .keeps_init = 0x2BB8F,
                                        .resettable = 0x2BB8F,
                                        .relpos_in_cntrl_bits = true,
                                        .relpos_p_soll = 1U << 3,
                                        .relpos_p_fnc = 1U << 4,
                                        .auto_resync = 1U << 5,
                                        .man_resync = 1U << 6,
                                        .rel_resync = 1U << 8,
                                        .record = 1U << 0,
                                        .rewind = 1U << 1,
                                        .record_inner = 1U << 2,
                                        .index_home = 1U << 9,
                                        .home_done = 1U << 16,
                                        .counts_to_index = 8000};

constexpr const FamilyBits& family_bits(registers::Model model) {
    return model == registers::Model::mac800 ? kMac800Bits : kSmallBits;
}

/// The motor's registers, and the values read from them in every sample. Shared by all parts of a motor.
class MotorState {
  public:
    explicit MotorState(registers::Model model) : memory(model), bits_(&family_bits(model)) {}
    MotorState(const MotorState&) = delete;
    MotorState& operator=(const MotorState&) = delete;

    MotorMemory memory;
    bool emergency = false;  ///< STOP_MODE brakes with ACC_EMERG (001 §4.1.8)

    registers::Model model() const { return memory.model(); }
    bool is_mac800() const { return sim::is_mac800(model()); }
    const FamilyBits& bits() const { return *bits_; }
    std::int32_t counts_per_revolution() const { return is_mac800() ? 8000 : 4096; }
    /// Of the outer loop.
    std::chrono::nanoseconds sample_period() const {
        return std::chrono::nanoseconds(is_mac800() ? 1'298'701 : 1'920'000);
    }

    std::uint16_t mode() const { return static_cast<std::uint16_t>(memory.get(cell::MODE_REG)); }
    bool is_mode(MotorMode mode) const { return this->mode() == number(mode); }
    /// `mode` must be in the table.
    void set_mode(std::uint16_t mode) {
        memory.set(cell::MODE_REG, mode);
        facts_ = facts_of(mode);
    }
    const ModeFacts& facts() const { return *facts_; }

    std::int32_t p_ist() const { return memory.get(cell::P_IST); }
    std::int32_t v_ist() const { return memory.get(cell::V_IST); }
    /// |V_IST| as an integer that compares with speed_at.
    std::int64_t speed() const {
        constexpr std::int64_t kNanosecondsInMinute = 60'000'000'000;
        const std::int64_t v = v_ist();
        return (v < 0 ? -v : v) * kNanosecondsInMinute;
    }
    std::int64_t speed_at(std::int64_t rpm) const {
        return rpm * counts_per_revolution() * sample_period().count();
    }

    /// CNTRL_BITS
    std::uint32_t control() const { return static_cast<std::uint32_t>(memory.get(cell::CNTRL_BITS)); }
    void set_control(std::uint32_t bits) { memory.set(cell::CNTRL_BITS, static_cast<std::int32_t>(bits)); }

    /// ERR_STAT
    std::uint32_t error_status() const { return static_cast<std::uint32_t>(memory.get(cell::ERR_STAT)); }
    void set_error_bits(std::uint32_t mask, bool on) { show_error_bits(mask, on ? mask : 0); }
    /// Replaces the bits of `mask` by those of `on`.
    void show_error_bits(std::uint32_t mask, std::uint32_t on) {
        const std::uint32_t status = error_status();
        const std::uint32_t wanted = (status & ~mask) | on;
        if (wanted != status) memory.set(cell::ERR_STAT, static_cast<std::int32_t>(wanted));
    }

  private:
    const FamilyBits* bits_;
    const ModeFacts* facts_ = facts_of(0);  // of MODE_REG
};

}  // namespace nplc::sim
