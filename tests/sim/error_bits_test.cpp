// The virtual motor's bits against the register maps' names for them.
#include "sim/motor_state.h"

#include <gtest/gtest.h>

#include "registers/details.h"

namespace nplc::sim {
namespace {

using registers::CNTRL_BITS;
using registers::ERR_STAT;
using registers::Model;

std::uint32_t bit(Model model, std::uint8_t number, std::string_view name) {
    const registers::Field* field = registers::field_of(model, number, name);
    return field != nullptr ? mask_of(*field) : 0;
}

TEST(ErrorBits, SharedOnesAreTheMapsOfBothFamilies) {
    for (const Model model : {Model::mac140, Model::mac800}) {
        EXPECT_EQ(err::I2T_ERR, bit(model, ERR_STAT, "I2T_ERR"));
        EXPECT_EQ(err::FLW_ERR, bit(model, ERR_STAT, "FLW_ERR"));
        EXPECT_EQ(err::FNC_ERR, bit(model, ERR_STAT, "FNC_ERR"));
        EXPECT_EQ(err::UIT_ERR, bit(model, ERR_STAT, "UIT_ERR"));
        EXPECT_EQ(err::IN_POS, bit(model, ERR_STAT, "IN_POS"));
        EXPECT_EQ(err::ACC_FLAG, bit(model, ERR_STAT, "ACC_FLAG"));
        EXPECT_EQ(err::DEC_FLAG, bit(model, ERR_STAT, "DEC_FLAG"));
        EXPECT_EQ(err::PLIM_ERR, bit(model, ERR_STAT, "PLIM_ERR"));
        EXPECT_EQ(err::DIS_P_LIM, bit(model, ERR_STAT, "DIS_P_LIM"));
    }
}

TEST(ErrorBits, EachFamilysOwn) {
    for (const Model model : {Model::mac140, Model::mac800}) {
        const FamilyBits& bits = family_bits(model);
        const bool large = model == Model::mac800;
        const std::uint8_t relative = bits.relpos_in_cntrl_bits ? CNTRL_BITS : ERR_STAT;
        EXPECT_EQ(bits.frame_err_tx, bit(model, ERR_STAT, "FRAME_ERR_TX"));
        EXPECT_EQ(bits.relpos_p_soll, bit(model, relative, "RELPOSPSOLL"));
        EXPECT_EQ(bits.relpos_p_fnc, bit(model, relative, "RELPOSPFNC"));
        EXPECT_EQ(bits.auto_resync, bit(model, CNTRL_BITS, large ? "SYNCPOSAUTO" : "AUTO_RESYNC"));
        EXPECT_EQ(bits.man_resync, bit(model, CNTRL_BITS, large ? "SYNCPOSMAN" : "MAN_RESYNC"));
        EXPECT_EQ(bits.rel_resync, bit(model, CNTRL_BITS, large ? "SYNCPOSREL" : "REL_RESYNC"));
    }
}

// The errors that keep INIT, by name: 0-3, 7, 12 of MAC50-141; 8, 9, 11, 13, 15 and 17 more of MAC800.
TEST(ErrorBits, ThoseThatKeepInitAreErrors) {
    std::uint32_t large = 0;
    for (const char* name : {"I2T_ERR", "FLW_ERR", "FNC_ERR", "UIT_ERR", "PLIM_ERR", "DEGC_ERR", "UV_ERR",
                             "OV_ERR", "IPEAK_ERR", "SPEED_ERR", "INDEX_ERR", "U24V_ERR"}) {
        large |= bit(Model::mac800, ERR_STAT, name);
    }
    EXPECT_EQ(kMac800Bits.keeps_init, large);
    std::uint32_t small = 0;
    for (const char* name : {"I2T_ERR", "FLW_ERR", "FNC_ERR", "UIT_ERR", "PLIM_ERR", "UV_ERR"}) {
        small |= bit(Model::mac50, ERR_STAT, name);
    }
    EXPECT_EQ(kSmallBits.keeps_init, small);
    EXPECT_EQ(kSmallBits.resettable, small | bit(Model::mac50, ERR_STAT, "IX_ERR"));
}

}  // namespace
}  // namespace nplc::sim
