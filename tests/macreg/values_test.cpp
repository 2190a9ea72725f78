#include "macreg/values.h"

#include <gtest/gtest.h>

namespace nplc::macreg {
namespace {

using registers::Model;

const registers::Register& reg(std::string_view name, Model model = Model::mac140) {
    return *registers::find(model, name);
}

TypedValue typed(std::string_view name, std::string_view text, Model model = Model::mac140) {
    return typed_value(reg(name, model), model, text);
}

// 001 §3.2.5: 1600 is 762.9 rpm; a step is 0.4768 rpm, so 1500 rpm is 3145.7 steps.
TEST(Values, TakesUnitsRawHexAndNames) {
    EXPECT_EQ(typed("V_SOLL", "1500rpm").raw, 3146);
    EXPECT_NE(typed("V_SOLL", "1500rpm").rounding.find("1500.13 rpm (raw 3146)"), std::string::npos);
    EXPECT_EQ(typed("V_SOLL", "100 counts/sample").raw, 1600);  // 1/16 counts a sample
    EXPECT_EQ(typed("V_SOLL", "1600").rounding, "");
    EXPECT_EQ(typed("V_SOLL", "raw:-1600").raw, -1600);
    EXPECT_EQ(typed("V_SOLL", "0xFFFE").raw, -2);
    EXPECT_EQ(typed("KVOUT", "1.5").raw, 384);
    EXPECT_EQ(typed("KVOUT", "raw:384").raw, 384);
    EXPECT_EQ(typed("MODE_REG", "P_MODE").raw, 2);
    EXPECT_EQ(typed("MODE_REG", "p_mode").raw, 2);
    EXPECT_EQ(typed("CNTRL_BITS", "USERINTF=COMMUNICATION+HICLK").raw, 0x13);
    EXPECT_EQ(typed("CNTRL_BITS", "none").raw, 0);
    EXPECT_EQ(typed("T_SOLL", "100%").raw, 1023);
}

TEST(Values, SaysWhatIsWrong) {
    for (const auto& [name, text, part] :
         std::vector<std::array<const char*, 3>>{{"T_SOLL", "1024", "0 %peak to 100 %peak (raw 0 to 1023)"},
                                                 {"T_SOLL", "101%", "out of range"},
                                                 {"T_SOLL", "20A", "T_SOLL takes %peak"},
                                                 {"V_SOLL", "32768", "out of range"},
                                                 {"V_SOLL", "raw:40000", "out of range"},
                                                 {"V_SOLL", "0x1FFFF", "16 bits"},
                                                 {"V_SOLL", "0.1rpm", "less than half a step"},
                                                 {"V_SOLL", "raw:", "no value"},
                                                 {"V_SOLL", "1 2", "no value"},
                                                 {"MODE_REG", "FAST", "no value"},
                                                 {"MODE_REG", "GEAR_MODE", "did you mean GP_MODE?"},
                                                 {"MODE_REG", "P-MODE", "did you mean P_MODE?"},
                                                 {"ERR_STAT", "RELPOS", "`macreg list ERR_STAT`"},
                                                 {"CNTRL_BITS", "HICLK+FOO", "no value"},
                                                 {"GEARF1", "3 rpm", "plain number"},
                                                 {"V_SOLL", "1,5rpm", "'1,5' is no number"},
                                                 {"V_SOLL", "1e3 rpm", "'1e3' is no number"},
                                                 {"P_SOLL", "1.2.3", "'1.2.3' is no number"},
                                                 {"T_SOLL", "5,0 %", "'5,0' is no number"},
                                                 {"V_SOLL", "", "no value"}}) {
        const TypedValue value = typed(name, text);
        EXPECT_NE(value.error.find(part), std::string::npos) << name << " " << text << ": " << value.error;
    }
}

TEST(Values, ShownNamesGiveTheSameBitsAgain) {
    EXPECT_EQ(value_text(reg("MODE_REG"), Model::mac140, 2), "P_MODE");
    EXPECT_EQ(value_text(reg("ERR_STAT"), Model::mac140, 0x12), "FLW_ERR IN_POS");
    EXPECT_EQ(typed("ERR_STAT", "FLW_ERR IN_POS").raw, 0x12);
    EXPECT_EQ(value_text(reg("V_SOLL"), Model::mac140, 1600), "762.94 rpm");
    EXPECT_EQ(value_text(*registers::find(Model::mac800, "MODE_REG"), Model::mac800, 15), "SAFE_MODE");
    EXPECT_EQ(bits_word(reg("ERR_STAT"), Model::mac140, 0x4400), "RELPOSPFNC+DIS_P_LIM");
    EXPECT_EQ(bits_word(reg("ERR_STAT"), Model::mac140, 0), "none");
    EXPECT_EQ(bits_word(reg("ERR_STAT"), Model::mac140, 0x8001), "0x8001") << "bit 15 has no name";
    EXPECT_EQ(bits_word(*registers::find(Model::mac800, "CNTRL_BITS"), Model::mac800, -1), "0xFFFFFFFF");
}

// Counts resolve single steps; 4096 of them are a turn, P_FNC's steps are sixteenths (001 §3.2.8).
TEST(Values, PositionsAreShownInCountsAndWhereThereIsRoomInTurnsToo) {
    EXPECT_EQ(value_text(reg("P_IST"), Model::mac140, 20'480), "20480 counts");
    EXPECT_TRUE(long_value_text(reg("P_IST"), Model::mac140, 20'480).starts_with("20480 counts (5"));
    EXPECT_EQ(long_value_text(reg("P_IST"), Model::mac140, 0), "0 counts");
    EXPECT_TRUE(long_value_text(reg("P_FNC"), Model::mac140, 16 * 4096).ends_with(" rev)"));
    EXPECT_EQ(long_value_text(reg("V_SOLL"), Model::mac140, 1600), "762.94 rpm");
    EXPECT_EQ(typed("V_SOLL", "100 rev/s").error.find("counts/sample"), std::string::npos);
    EXPECT_NE(typed("V_SOLL", "3 V").error.find("counts/sample"), std::string::npos);
}

TEST(Values, FindsRegistersByNameAndNumber) {
    EXPECT_EQ(find_register(Model::mac140, "v_soll").reg, &reg("V_SOLL"));
    EXPECT_EQ(find_register(Model::mac140, "5").reg, &reg("V_SOLL"));
    EXPECT_NE(find_register(Model::mac140, "V_SOL").error.find("did you mean V_SOLL"), std::string::npos);
    EXPECT_NE(find_register(Model::mac140, "4").error.find("upper word of register 3, P_SOLL"),
              std::string::npos);
    // Of the other family's, no guess that is another register.
    EXPECT_NE(find_register(Model::mac800, "KIC").error.find("but each of MAC50 to MAC141 has"),
              std::string::npos);
    EXPECT_NE(find_register(Model::mac800, "MYADDR").error.find("did you mean MY_ADDR"), std::string::npos);
    EXPECT_NE(find_register(Model::mac140, "ADDRESS").error.find("did you mean MYADDR"), std::string::npos);
    for (const char* silly : {"", "BAR", "FOO", "BAUD"})
        EXPECT_EQ(find_register(Model::mac140, silly).error.find("did you mean"), std::string::npos) << silly;
    for (const char* wrong : {"0", "256", "-1", "999999999999999999999", "165", ""})
        EXPECT_EQ(find_register(Model::mac140, wrong).reg, nullptr) << wrong;
}

// 004, column "MacTalk name"; MIN and MAX as they act.
TEST(MacTalkNames, AreThoseOfBothFamilies) {
    for (const auto& [name, small, large] :
         std::vector<std::array<std::string_view, 3>>{{"Max velocity", "V_SOLL", "V_SOLL"},
                                                      {"Motor load (mean)", "I2T", "I2T"},
                                                      {"Input", "GEARF1", "GEARF_1"},
                                                      {"Position limit min", "MIN_P_IST", "MIN_P_IST"},
                                                      {"Motor address", "MYADDR", "MY_ADDR"},
                                                      {"Zero search speed", "V_HOME", "V_HOME"}}) {
        EXPECT_EQ(mactalk_name(*registers::find(Model::mac140, small)), name);
        EXPECT_EQ(mactalk_name(*registers::find(Model::mac800, large)), name);
    }
    for (const auto& [reg, name] : std::vector<std::array<std::string_view, 2>>{{"POS0", "P1"},
                                                                                {"POS7", "P8"},
                                                                                {"VEL3", "V4"},
                                                                                {"ACC0", "A1"},
                                                                                {"TQ3", "T4"},
                                                                                {"LOAD0", "L1"},
                                                                                {"ZERO3", "Z4"}})
        EXPECT_EQ(mactalk_name(*registers::find(Model::mac800, reg)), name);
    EXPECT_EQ(mactalk_name(*registers::find(Model::mac140, "KFF3")), "");
}

}  // namespace
}  // namespace nplc::macreg
