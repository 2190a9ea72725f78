// Rows written down from the manuals' pages by hand, at least one a page, and the whole of both counted.

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "registers/details.h"
#include "registers/layout.h"
#include "registers/mac.h"

namespace nplc::registers {
namespace {

constexpr Format W = Format::word, I = Format::integer, L = Format::long_int, F4 = Format::fixed4,
                 F8 = Format::fixed8, F16 = Format::fixed16, F24 = Format::fixed24;
constexpr std::int64_t kMost = 2'147'483'647;

struct Row {
    int page;  ///< of 001
    std::uint8_t number;
    std::string_view name;
    Format format;
    std::int64_t min;
    std::int64_t max;
};

// 001 §3.2. A register without a range in the text has that of its format (§3.1).
constexpr Row kSmallRows[] = {
    {17, 1, "PROG_VERSION", W, 0, 65'535},
    {17, 2, "MODE_REG", W, 0, 258},  // 0..24, 256; 257 and 258 of §4.4.16
    {18, 3, "P_SOLL", L, -67'000'000, 67'000'000},
    {19, 5, "V_SOLL", I, -32'767, 32'767},
    {20, 6, "A_SOLL", W, 0, 65'535},
    {21, 7, "T_SOLL", W, 0, 1023},
    {22, 8, "P_FNC", L, -kMost, kMost},
    {22, 10, "P_IST", L, -kMost, kMost},
    {23, 12, "V_IST", I, -32'767, 32'767},
    {24, 13, "KVOUT", F8, -32'767, 32'767},
    {25, 14, "GEARF1", I, -32'767, 32'767},
    {25, 15, "GEARF2", W, 0, 65'535},
    {26, 17, "I2TLIM", W, 0, 65'535},
    {26, 19, "UITLIM", W, 0, 65'535},
    {27, 20, "FLWERR", L, -67'000'000, 67'000'000},
    {27, 22, "FLWERRMAX", L, 0, 67'000'000},
    {28, 24, "FNCERR", L, -134'217'727, 134'217'727},
    {28, 26, "FNCERRMAX", L, 0, 134'217'727},
    {29, 28, "MIN_P_IST", L, -kMost, kMost},
    {29, 30, "MAX_P_IST", L, -kMost, kMost},
    {30, 32, "ACC_EMERG", W, 0, 65'535},
    {30, 33, "INPOSWIN", W, 0, 32'767},
    {30, 34, "INPOSCNT", W, 0, 32'767},
    {31, 35, "ERR_STAT", W, 0, 65'535},
    {32, 36, "CNTRL_BITS", W, 0, 65'535},
    {34, 37, "STARTMODE", W, 0, 65'535},
    {34, 38, "P_HOME", L, -67'000'000, 67'000'000},
    {34, 40, "V_HOME", I, -32'767, 32'767},
    {35, 41, "T_HOME", I, -800, 800},
    {35, 42, "HOME_MODE", W, 0, 65'535},
    {36, 43, "P_REG_P", W, 0, 8},
    {36, 45, "A_REG_P", W, 0, 4},
    {37, 48, "Z_REG_P", W, 0, 4},
    {38, 49, "P1", L, -67'000'000, 67'000'000},
    {38, 63, "P8", L, -67'000'000, 67'000'000},
    {38, 72, "V8", I, -32'767, 32'767},
    {39, 76, "A4", W, 0, 65'535},
    {39, 80, "T4", W, 0, 1023},
    {39, 84, "L4", F8, -32'767, 32'767},
    {39, 88, "Z4", W, 0, 32'767},
    {40, 89, "KFF3", F8, -32'767, 32'767},
    {40, 93, "KVFX4", F4, -32'767, 32'767},
    {40, 100, "KVFY0", F4, -32'767, 32'767},
    {41, 101, "GEARB", F8, -32'767, 32'767},
    {41, 109, "KIFY0", F4, -32'767, 32'767},
    {42, 110, "KIB1", F8, -32'767, 32'767},
    {43, 115, "SAMPLE4", W, 1, 164},
    {43, 116, "REC_CNT", W, 0, 895},
    {43, 119, "VB_OUT", I, -32'767, 32'767},
    {44, 120, "V_EXT", I, -32'767, 32'767},
    {44, 121, "VF_OUT", I, -1023, 1023},
    {44, 123, "ANINP_OFFSET", I, -32'767, 32'767},
    {45, 125, "ELDEGP_OFFSET", W, 0, 2047},
    {45, 126, "PHASE_COMP", F8, -32'767, 32'767},
    {46, 127, "AMPLITUDE", F8, 0, 212},  // 0.83 x 256 = 212.48
    {46, 128, "MAN_I_NOM", W, 0, 1023},
    {46, 129, "MAN_ALPHA", W, 0, 2047},
    {47, 130, "UMEAS", W, 0, 100},
    {47, 135, "IC_SOLL", I, -850, 850},
    {47, 136, "IX_SELECT", W, 0, 65'535},
    {48, 139, "IC_IST", I, -1023, 1023},
    {48, 142, "IC_OFFSET", W, 0, 2047},
    {48, 143, "ELDEG_IST", W, 0, 2047},
    {49, 144, "V_ELDEG", I, -32'767, 32'767},
    {49, 147, "UC_VAL", I, -32'767, 32'767},
    {49, 150, "KIC", W, 0, 65'535},
    {49, 152, "U_MIN_SUP", W, 0, 65'535},
    {50, 153, "MOTOR_TYPE", W, 0, 65'535},
    {50, 154, "SERIAL_NMB", L, -kMost, kMost},
    {50, 156, "MYADDR", W, 1, 254},
    {50, 158, "CHKSUM", L, -kMost, kMost},
    {50, 160, "UV_HANDLE", W, 0, 65'535},
    {51, 161, "INV_OUTPUT", W, 0, 65'535},
    {51, 163, "P_NEW", L, -kMost, kMost},
};

// 004, a table after the other. No page numbers survive; 0 stands for them.
constexpr Row kLargeRows[] = {
    {0, 1, "PROG_VER", L, -kMost, kMost},
    {0, 2, "MODE_REG", L, 0, 21},
    {0, 4, "P_NEW", L, -kMost, kMost},
    {0, 7, "T_SOLL", L, 0, 1023},
    {0, 9, "INDEX_OFFSET", L, -kMost, kMost},
    {0, 11, "V_IST_16", L, -kMost, kMost},
    {0, 13, "KVOUT", F16, -kMost - 1, kMost},
    {0, 15, "GEARF_2", L, -kMost, kMost},
    {0, 21, "U_24V", L, -kMost, kMost},
    {0, 23, "UV_HANDLE", L, -kMost, kMost},
    {0, 26, "FNCERRMAX", L, 0, kMost},
    {0, 31, "DEGCMAX", L, -kMost, kMost},
    {0, 35, "ERR_STAT", L, -kMost, kMost},
    {0, 37, "START_MODE", L, -kMost, kMost},
    {0, 39, "HW_SETUP", L, -kMost, kMost},
    {0, 42, "HOME_MODE", L, -kMost, kMost},
    {0, 48, "Z_REG_P", L, 0, 4},
    {0, 63, "POS7", L, -kMost, kMost},
    {0, 72, "VEL7", L, -kMost, kMost},
    {0, 76, "ACC3", L, -kMost, kMost},
    {0, 80, "TQ3", L, 0, 1023},
    {0, 84, "LOAD3", F16, -kMost - 1, kMost},
    {0, 121, "KFF5", F24, -kMost - 1, kMost},
    {0, 127, "KVFX6", F16, -kMost - 1, kMost},
    {0, 143, "KVB0", F24, -kMost - 1, kMost},
    {0, 147, "KIFY0", F16, -kMost - 1, kMost},
    {0, 148, "KIB1", F24, -kMost - 1, kMost},
    {0, 156, "S_ORDER", L, -kMost, kMost},
    {0, 162, "REC_CNT", L, -kMost, kMost},
    {0, 166, "FNC_OUT", F16, -kMost - 1, kMost},
    {0, 171, "ANINP_OFFSET", L, -kMost, kMost},
    {0, 175, "MAN_I_NOM", F16, -kMost - 1, kMost},
    {0, 198, "U_BUS", L, -kMost, kMost},
    {0, 204, "SERIAL_NUMBER", L, -kMost, kMost},
};

void compare(Model model, std::span<const Row> rows) {
    for (const Row& row : rows) {
        const Register* reg = find(model, row.number);
        ASSERT_NE(reg, nullptr) << row.name;
        EXPECT_EQ(reg->name, row.name) << "page " << row.page;
        EXPECT_EQ(reg->format, row.format) << row.name;
        EXPECT_EQ(reg->min, row.min) << row.name;
        EXPECT_EQ(reg->max, row.max) << row.name;
    }
}

TEST(Rows, OfEveryPageOf001) {
    compare(Model::mac95, kSmallRows);
    std::set<int> pages;
    for (const Row& row : kSmallRows) pages.insert(row.page);
    for (int page = 17; page <= 51; ++page) {
        EXPECT_TRUE(pages.contains(page) || page == 33) << page;  // 33 goes on with CNTRL_BITS
    }
}

TEST(Rows, OfEveryTableOf004) {
    compare(Model::mac800, kLargeRows);
}

// 001: 164 numbers; LongInts are 3 8 10 20 22 24 26 28 30 38, eight positions, 154 158 163: 21 take two.
TEST(Rows, Counted) {
    EXPECT_EQ(map_of(Model::mac140).size(), 164U - 21U);
    // 004: 1..24, 26..49, 51 53 .. 63, 65..88, 121..149, 154 156 157, 158..206
    EXPECT_EQ(map_of(Model::mac800).size(), 24U + 24 + 7 + 24 + 29 + 3 + 49);
}

// The numbers that 004 does not list: 25, those between positions, 89..120 reserved, 150..153 and 155.
TEST(Rows, GapsOf004) {
    std::set<int> gaps;
    for (int number = 1; number <= 206; ++number) {
        if (find(Model::mac800, static_cast<std::uint8_t>(number)) == nullptr) gaps.insert(number);
    }
    std::set<int> expected = {25, 50, 52, 54, 56, 58, 60, 62, 64, 150, 151, 152, 153, 155};
    for (int number = 89; number <= 120; ++number) expected.insert(number);
    EXPECT_EQ(gaps, expected);
}

TEST(Rows, NoTwoRegistersShareANumber) {
    for (const Model model : {Model::mac141, Model::mac800}) {
        const auto map = map_of(model);
        for (std::size_t i = 1; i < map.size(); ++i) {
            EXPECT_FALSE(overlap(cells_of(model, map[i - 1]), cells_of(model, map[i]))) << map[i].name;
        }
    }
}

// 001: "updated in all modes" (§3.2.12, §3.2.122), "freely overwritten" (§3.2.10), overwritten with 0
// (§3.2.43), adjusted in INIT (§3.2.140), bits reset by themselves (§3.2.36).
TEST(Rows, WhoWrites) {
    for (const char* name :
         {"V_IST", "FLWERR", "I2T", "ANINP", "V_EXT", "ELDEG_IST", "U_SUPPLY", "SERIAL_NMB"}) {
        EXPECT_EQ(find(Model::mac50, name)->access, Access::read_only) << name;
    }
    for (const char* name : {"P_IST", "P_FNC", "P_REG_P", "IA_OFFSET", "CNTRL_BITS", "MODE_REG", "REC_CNT"}) {
        EXPECT_EQ(find(Model::mac50, name)->access, Access::motor_writes) << name;
    }
    for (const char* name : {"GEARF1", "P_HOME", "P1", "Z4", "KFF3", "MYADDR", "UV_HANDLE"}) {
        EXPECT_EQ(find(Model::mac50, name)->access, Access::read_write) << name;
    }
    for (const char* name : {"V_IST_16", "U_24V", "DEGC", "VF_OUT", "U_BUS", "CHKSUM"}) {
        EXPECT_EQ(find(Model::mac800, name)->access, Access::read_only) << name;
    }
    EXPECT_EQ(find(Model::mac800, "HOME_MODE")->access, Access::motor_writes);  // Home_Done
    EXPECT_EQ(find(Model::mac800, "DEGCMAX")->access, Access::read_write);
}

}  // namespace
}  // namespace nplc::registers
