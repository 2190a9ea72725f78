#pragma once

#include <cstdint>

#include "registers/mac.h"

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

/// Bits that the families put in different places. A mask of 0: the family has no such bit.
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

/// MAC800's further errors: 8 temperature, 9 undervoltage, 11 overvoltage, 12 current, 13 speed, 15 encoder,
/// 17 24 V.
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

}  // namespace nplc::sim
