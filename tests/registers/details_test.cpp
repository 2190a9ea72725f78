#include "registers/details.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace nplc::registers {
namespace {

struct Bit {
    std::string_view name;
    int first;
    int width = 1;
};

void compare(Model model, std::uint8_t number, std::span<const Bit> bits) {
    EXPECT_EQ(fields_of(model, number).size(), bits.size());
    for (const Bit& bit : bits) {
        const Field* field = field_of(model, number, bit.name);
        ASSERT_NE(field, nullptr) << bit.name;
        EXPECT_EQ(field->first, bit.first) << bit.name;
        EXPECT_EQ(field->width, bit.width) << bit.name;
    }
}

// 001 §3.2.35, its list from the bottom up.
TEST(Fields, ErrStatOf001) {
    constexpr Bit kBits[] = {{"I2T_ERR", 0},      {"FLW_ERR", 1},     {"FNC_ERR", 2},     {"UIT_ERR", 3},
                             {"IN_POS", 4},       {"ACC_FLAG", 5},    {"DEC_FLAG", 6},    {"PLIM_ERR", 7},
                             {"FRAME_ERR_TX", 8}, {"RELPOSPSOLL", 9}, {"RELPOSPFNC", 10}, {"IX_ERR", 11},
                             {"UV_ERR", 12},      {"UV_DETECT", 13},  {"DIS_P_LIM", 14}};
    compare(Model::mac50, 35, kBits);
}

// 001 §3.2.36.
TEST(Fields, CntrlBitsOf001) {
    constexpr Bit kBits[] = {{"USERINTF", 0, 2}, {"PULSEDIR", 2},    {"INPSIGN", 3},     {"HICLK", 4},
                             {"HALL_INT", 5},    {"RECORDBIT", 6},   {"REWINDBIT", 7},   {"RECINNERBIT", 8},
                             {"AUTO_RESYNC", 9}, {"MAN_RESYNC", 10}, {"INDEX_HOME", 11}, {"REL_RESYNC", 12},
                             {"HALL", 13, 3}};
    compare(Model::mac141, 36, kBits);
}

// 004, register 35.
TEST(Fields, ErrStatOf004) {
    constexpr Bit kBits[] = {{"I2T_ERR", 0},       {"FLW_ERR", 1},    {"FNC_ERR", 2},    {"UIT_ERR", 3},
                             {"IN_POS", 4},        {"ACC_FLAG", 5},   {"DEC_FLAG", 6},   {"PLIM_ERR", 7},
                             {"DEGC_ERR", 8},      {"UV_ERR", 9},     {"UV_DETECT", 10}, {"OV_ERR", 11},
                             {"IPEAK_ERR", 12},    {"SPEED_ERR", 13}, {"DIS_P_LIM", 14}, {"INDEX_ERR", 15},
                             {"OLD_FILT_ERR", 16}, {"U24V_ERR", 17}};
    compare(Model::mac800, 35, kBits);
}

// 004, registers 36, 23, 39, 42 and 1; 001 §3.2.160.
TEST(Fields, OtherBits) {
    constexpr Bit kControl[] = {
        {"RECORDBIT", 0},   {"REWINDBIT", 1},  {"RECINNERBIT", 2},  {"RELPOSPSOLL", 3}, {"RELPOSPFNC", 4},
        {"SYNCPOSAUTO", 5}, {"SYNCPOSMAN", 6}, {"MAN_NO_BRAKE", 7}, {"SYNCPOSREL", 8},  {"INDEX_HOME", 9}};
    compare(Model::mac800, 36, kControl);
    constexpr Bit kUndervoltage[] = {{"SET_UV_ERR", 0}, {"UV_GO_PASSIVE", 1}, {"UV_VSOLL0", 2}};
    compare(Model::mac800, 23, kUndervoltage);
    constexpr Bit kSmallUndervoltage[] = {{"SET_UV_ERR", 0}, {"UV_GO_PASSIVE", 1}, {"UV_VSOLL0", 3}};
    compare(Model::mac95, 160, kSmallUndervoltage);
    constexpr Bit kHardware[] = {{"DIRAWR", 0}, {"DIRBWR", 1}, {"PULSEOUT", 2}, {"XSEL1", 3},
                                 {"XPRINP", 4}, {"NOFILT", 5}, {"INVXDIR", 6}};
    compare(Model::mac800, 39, kHardware);
    EXPECT_EQ(field_of(Model::mac800, 42, "home_done")->first, 16);
    constexpr Bit kVersion[] = {
        {"MINOR", 0, 6}, {"MAJOR", 6, 7}, {"BETA", 13}, {"RESERVED", 14}, {"LARGE", 15}};
    compare(Model::mac800, 1, kVersion);
}

TEST(Fields, EachBitOnceInOrderAndInsideItsRegister) {
    for (const Model model : {Model::mac50, Model::mac800}) {
        for (const Register& reg : map_of(model)) {
            const auto fields = fields_of(model, reg.number);
            EXPECT_TRUE(reg.unit != Unit::bits || !fields.empty()) << reg.name;
            std::uint32_t used = 0;
            std::set<std::string> names;
            for (const Field& field : fields) {
                EXPECT_EQ(used & mask_of(field), 0U) << reg.name << " " << field.name;
                EXPECT_GT(mask_of(field), used) << reg.name << " " << field.name;
                EXPECT_LE(field.first + field.width, is_32_bit(reg.format) ? 32 : 16) << reg.name;
                EXPECT_TRUE(names.insert(std::string(field.name)).second) << reg.name << " " << field.name;
                EXPECT_FALSE(field.meaning.empty()) << reg.name << " " << field.name;
                used |= mask_of(field);
            }
        }
        EXPECT_EQ(fields_of(model, V_SOLL).size(), 0U);
    }
}

TEST(Fields, NamedValuesFitTheirFieldAndRegister) {
    for (const Model model : {Model::mac50, Model::mac800}) {
        for (const Register& reg : map_of(model)) {
            for (const Field& field : fields_of(model, reg.number)) {
                int previous = -1;
                for (const NamedValue& value : field.values) {
                    EXPECT_GT(value.value, previous) << reg.name;
                    EXPECT_LE(value.value, mask_of(field) >> field.first) << reg.name;
                    EXPECT_LE(value.value, reg.max) << reg.name;
                    EXPECT_EQ(named(field, value.value), &value);
                    previous = value.value;
                }
            }
        }
    }
}

TEST(Values, Modes) {
    const Field& mode = fields_of(Model::mac140, MODE_REG)[0];
    for (std::uint32_t number = 0; number <= 24; ++number) EXPECT_NE(named(mode, number), nullptr) << number;
    EXPECT_EQ(named(mode, 0)->name, "INIT_MODE");  // 001 §3.2.2
    EXPECT_EQ(named(mode, 2)->name, "P_MODE");
    EXPECT_EQ(named(mode, 11)->name, "STOP_MODE");
    EXPECT_EQ(named(mode, 13)->name, "HOME2_MODE");
    EXPECT_EQ(named(mode, 18)->name, "AG_MODE");
    EXPECT_EQ(named(mode, 24)->name, "GF_MODE");
    EXPECT_NE(named(mode, 256), nullptr);
    EXPECT_EQ(named(mode, 25), nullptr);
    const Field& large = fields_of(Model::mac800, MODE_REG)[0];
    EXPECT_NE(named(large, 21), nullptr);            // 004 register 2: 0..14, 16..21
    EXPECT_EQ(named(large, 15)->name, "SAFE_MODE");  // 54h leads there (001 §5.1)
    EXPECT_EQ(named(large, 22), nullptr);
}

TEST(Values, PointersUserInterfaceAndHoming) {
    EXPECT_EQ(named(fields_of(Model::mac140, 43)[0], 8)->name, "P8");
    EXPECT_EQ(named(fields_of(Model::mac140, 48)[0], 5), nullptr);  // 0 .. 4
    const Field& pins = *field_of(Model::mac140, CNTRL_BITS, "USERINTF");
    EXPECT_EQ(named(pins, value_in(pins, 0xFFFF))->name, "COMMUNICATION");  // 11
    EXPECT_EQ(named(pins, 2), nullptr);                                     // 10 is not in §3.2.36
    const Field& command = *field_of(Model::mac140, HOME_MODE, "BY_COMMAND");
    EXPECT_EQ(named(command, value_in(command, 0x0D0C))->name, "HOME2_MODE");  // high byte 0Dh = 13
}

TEST(Details, EveryRegisterHasATitleOfItsOwn) {
    for (const Model model : {Model::mac50, Model::mac800}) {
        std::set<std::string> titles;
        for (const Register& reg : map_of(model)) {
            const Details* details = details_of(model, reg.number);
            ASSERT_NE(details, nullptr) << reg.name;
            EXPECT_FALSE(details->title.empty()) << reg.name;
            const bool is_new = titles.insert(std::string(details->title)).second;
            EXPECT_TRUE(is_new || details->title == "Not described") << details->title;
        }
        EXPECT_EQ(details_of(model, 255), nullptr);
    }
    EXPECT_EQ(details_of(Model::mac50, 4), nullptr);
}

// 001: A_SOLL 1..1000; KVOUT 1.0..10.0; INPOSCNT 3-5; PHASE_COMP 3.0..7.0; offsets 1000..1050; KIA nominal
// 256.
TEST(Details, Recommended) {
    struct {
        std::uint8_t number;
        int from;
        int to;
    } rows[] = {{6, 1, 1000}, {32, 1, 1000},           {76, 1, 1000},     {13, 256, 2560}, {84, 256, 2560},
                {34, 3, 5},   {126, 3 * 256, 7 * 256}, {142, 1000, 1050}, {148, 256, 256}, {5, 0, 0}};
    for (const auto& row : rows) {
        EXPECT_EQ(details_of(Model::mac140, row.number)->recommended.from, row.from) << int{row.number};
        EXPECT_EQ(details_of(Model::mac140, row.number)->recommended.to, row.to) << int{row.number};
    }
}

}  // namespace
}  // namespace nplc::registers
