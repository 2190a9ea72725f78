#include "registers/mac.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

namespace nplc::registers {
namespace {

const Register& small_register(std::uint8_t number) {
    return *find(Model::mac140, number);
}
const Register& large(std::uint8_t number) {
    return *find(Model::mac800, number);
}

// 001 §3.2: the number in a section's title is the register's number.
TEST(MacMap, NumbersOf001) {
    EXPECT_EQ(small_register(1).name, "PROG_VERSION");
    EXPECT_EQ(small_register(3).name, "P_SOLL");
    EXPECT_EQ(small_register(5).name, "V_SOLL");
    EXPECT_EQ(small_register(10).name, "P_IST");
    EXPECT_EQ(small_register(35).name, "ERR_STAT");
    EXPECT_EQ(small_register(49).name, "P1");
    EXPECT_EQ(small_register(63).name, "P8");
    EXPECT_EQ(small_register(72).name, "V8");
    EXPECT_EQ(small_register(76).name, "A4");
    EXPECT_EQ(small_register(80).name, "T4");
    EXPECT_EQ(small_register(84).name, "L4");
    EXPECT_EQ(small_register(88).name, "Z4");
    EXPECT_EQ(small_register(100).name, "KVFY0");
    EXPECT_EQ(small_register(111).name, "KIB0");
    EXPECT_EQ(small_register(117).name, "FNC_OUT");
    EXPECT_EQ(small_register(127).name, "AMPLITUDE");
    EXPECT_EQ(small_register(156).name, "MYADDR");
    EXPECT_EQ(small_register(163).name, "P_NEW");
}

// 004: the MAC800's own numbers above 88.
TEST(MacMap, NumbersOf004) {
    EXPECT_EQ(large(4).name, "P_NEW");
    EXPECT_EQ(large(49).name, "POS0");
    EXPECT_EQ(large(88).name, "ZERO3");
    EXPECT_EQ(large(121).name, "KFF5");
    EXPECT_EQ(large(138).name, "KVFY0");
    EXPECT_EQ(large(149).name, "KIB0");
    EXPECT_EQ(large(169).name, "VF_OUT");
    EXPECT_EQ(large(170).name, "ANINP");
    EXPECT_EQ(large(172).name, "ELDEG_OFFSET");
    EXPECT_EQ(large(201).name, "TC0_CV2");
    EXPECT_EQ(large(206).name, "CHKSUM");
    EXPECT_EQ(find(Model::mac800, std::uint8_t{89}), nullptr);  // 89..120 are reserved
    EXPECT_EQ(find(Model::mac800, std::uint8_t{120}), nullptr);
}

TEST(MacMap, EveryNameOfTheHeaderIsInBothMapsWhereItSaysSo) {
    for (int number :
         {PROG_VERSION, MODE_REG, P_SOLL,     V_SOLL,    A_SOLL,    T_SOLL,    P_FNC,     P_IST,     V_IST,
          KVOUT,        GEARF1,   GEARF2,     I2T,       FLWERRMAX, MIN_P_IST, MAX_P_IST, ACC_EMERG, INPOSWIN,
          INPOSCNT,     ERR_STAT, CNTRL_BITS, STARTMODE, P_HOME,    V_HOME,    T_HOME,    HOME_MODE, P_REG_P,
          Z_REG_P,      P1,       V1,         A1,        T1,        L1,        Z1}) {
        EXPECT_NE(find(Model::mac95, static_cast<std::uint8_t>(number)), nullptr) << number;
        EXPECT_NE(find(Model::mac800, static_cast<std::uint8_t>(number)), nullptr) << number;
    }
}

TEST(MacMap, RowsAreInOrderNamedOnceAndInsideTheirFormat) {
    for (Model model : {Model::mac50, Model::mac800}) {
        int previous = 0;
        std::set<std::string> names;
        for (const Register& r : map_of(model)) {
            EXPECT_GT(r.number, previous) << r.name;
            EXPECT_TRUE(names.insert(std::string(r.name)).second) << r.name;
            EXPECT_LT(r.min, r.max) << r.name;
            EXPECT_FALSE(r.section.empty()) << r.name;
            const std::int64_t low = r.format == Format::word ? 0
                                     : is_32_bit(r.format)    ? -2147483648LL
                                                              : -32768;
            const std::int64_t high = r.format == Format::word ? 65535
                                      : is_32_bit(r.format)    ? 2147483647
                                                               : 32767;
            EXPECT_GE(r.min, low) << r.name;
            EXPECT_LE(r.max, high) << r.name;
            previous = r.number;
        }
    }
}

// 001 §3.2: "registers of the format LongInt take up two register numbers".
TEST(MacMap, SecondWordOfALongIntIsNotARegister) {
    const auto map = map_of(Model::mac141);
    for (std::size_t i = 0; i + 1 < map.size(); ++i) {
        if (is_32_bit(map[i].format)) {
            EXPECT_GE(map[i + 1].number, map[i].number + 2) << map[i].name;
        }
    }
    for (int number : {4, 9, 11, 21, 29, 39, 50, 64, 155, 159}) {
        EXPECT_EQ(find(Model::mac141, static_cast<std::uint8_t>(number)), nullptr) << number;
    }
}

TEST(MacMap, AllNumbersUpTo163AreCovered) {
    std::set<int> covered;
    for (const Register& r : map_of(Model::mac50)) {
        covered.insert(r.number);
        if (is_32_bit(r.format)) covered.insert(r.number + 1);
    }
    for (int number = 1; number <= 164; ++number) {
        EXPECT_TRUE(covered.contains(number)) << number;
    }
}

TEST(MacMap, FormatsUnitsAndRangesOf001) {
    EXPECT_EQ(small_register(P_SOLL).format, Format::long_int);  // §3.2.3: +/-67E6 encoder counts
    EXPECT_EQ(small_register(P_SOLL).unit, Unit::counts);
    EXPECT_EQ(small_register(P_SOLL).max, 67'000'000);
    EXPECT_EQ(small_register(P_SOLL).min, -67'000'000);
    EXPECT_EQ(small_register(V_SOLL).format, Format::integer);
    EXPECT_EQ(small_register(V_SOLL).unit, Unit::velocity_16);
    EXPECT_EQ(small_register(A_SOLL).format, Format::word);
    EXPECT_EQ(small_register(A_SOLL).unit, Unit::acceleration_16);
    EXPECT_EQ(small_register(T_SOLL).max, 1023);
    EXPECT_EQ(small_register(P_FNC).unit, Unit::counts_16);
    EXPECT_EQ(small_register(V_IST).unit, Unit::velocity);
    EXPECT_EQ(small_register(INPOSWIN).max, 32767);
    EXPECT_EQ(small_register(T_HOME).min, -800);
    EXPECT_EQ(small_register(P_REG_P).max, 8);
    EXPECT_EQ(small_register(Z_REG_P).max, 4);
    EXPECT_EQ(small_register(81).format, Format::fixed8);
    EXPECT_EQ(small_register(93).format, Format::fixed4);
    EXPECT_EQ(small_register(127).max, 212);  // 0.83 x 256 = 212.48
    EXPECT_EQ(small_register(V_SOLL).section, "001 §3.2.5");
}

TEST(MacMap, EveryRegisterOfTheMac800Is32Bit) {
    for (const Register& r : map_of(Model::mac800)) EXPECT_TRUE(is_32_bit(r.format)) << r.name;
    EXPECT_EQ(large(81).format, Format::fixed16);
    EXPECT_EQ(large(121).format, Format::fixed24);
}

TEST(MacMap, DangerousOnes) {
    for (int number = 89; number <= 111; ++number)
        EXPECT_TRUE(small_register(static_cast<std::uint8_t>(number)).dangerous);
    EXPECT_TRUE(small_register(127).dangerous);
    EXPECT_TRUE(small_register(140).dangerous);
    EXPECT_FALSE(small_register(V_SOLL).dangerous);
    EXPECT_FALSE(small_register(P1).dangerous);
    EXPECT_FALSE(small_register(CNTRL_BITS).dangerous);
    EXPECT_TRUE(large(149).dangerous);
    EXPECT_TRUE(large(186).dangerous);
    EXPECT_FALSE(large(V_SOLL).dangerous);
}

TEST(MacMap, FindsByNameWhateverTheCase) {
    EXPECT_EQ(find(Model::mac50, "v_soll")->number, 5);
    EXPECT_EQ(find(Model::mac50, "InPosWin")->number, 33);
    EXPECT_EQ(find(Model::mac50, "V_SOL"), nullptr);
    EXPECT_EQ(find(Model::mac50, ""), nullptr);
}

// 004 calls register 49 POS0 and gives P1 as MacTalk's name for it.
TEST(MacMap, FindsCommonNamesOnTheMac800) {
    EXPECT_EQ(find(Model::mac800, "P1")->number, 49);
    EXPECT_EQ(find(Model::mac800, "P1")->name, "POS0");
    EXPECT_EQ(find(Model::mac800, "z4")->number, 88);
    EXPECT_EQ(find(Model::mac800, "P_FNC")->number, 8);
    EXPECT_EQ(find(Model::mac800, "ANINP")->number, 170);  // its own number, not 001's 122
    EXPECT_EQ(find(Model::mac800, "UV_HANDLE")->number, 23);
    EXPECT_EQ(find(Model::mac800, "U_SUPPLY"), nullptr);
}

TEST(MacScale, MatchesTheManualsExamples) {
    // 001 §3.2.5: V_SOLL 1600 is 762.9 rpm.
    const Scale s = scale_of(Model::mac140);
    EXPECT_NEAR(1600.0 / 16 * s.samples_per_second / s.counts_per_rev * 60, 762.9, 0.05);
    // 004: 1 rpm = 2.77056 counts/sample/16.
    const Scale l = scale_of(Model::mac800);
    EXPECT_NEAR(16.0 * l.counts_per_rev / 60 / l.samples_per_second, 2.77056, 0.00001);
}

TEST(MacModel, Names) {
    EXPECT_EQ(model_of("mac140"), Model::mac140);
    EXPECT_EQ(model_of("MAC800"), Model::mac800);
    EXPECT_EQ(model_of("MAC14"), std::nullopt);
    for (Model m : {Model::mac50, Model::mac95, Model::mac140, Model::mac141, Model::mac800}) {
        EXPECT_EQ(model_of(name_of(m)), m);
    }
}

}  // namespace
}  // namespace nplc::registers
