#include "registers/midi.h"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>

namespace nplc::registers::midi {
namespace {

std::set<int> numbers_where(bool (*holds)(const CommandRow&)) {
    std::set<int> numbers;
    for (const CommandRow& row : commands()) {
        if (holds(row)) numbers.insert(row.number);
    }
    return numbers;
}

// 000 §V.1 and §VI, 003 §VI.1 and §VII; 04, 05, 06, 12, 1D and 1F are not used.
TEST(MidiCommands, TheListIsTheManuals) {
    EXPECT_EQ(numbers_where([](const CommandRow& row) { return row.on_v24; }),
              (std::set<int>{0x00, 0x01, 0x02, 0x03, 0x07, 0x08, 0x09, 0x0A, 0x0B, 0x0C, 0x0D, 0x0E, 0x0F,
                             0x10, 0x11, 0x13, 0x14, 0x15, 0x16, 0x17, 0x18, 0x19, 0x1A, 0x1B, 0x1C, 0x1E}));
    EXPECT_EQ(numbers_where([](const CommandRow& row) { return !row.on_can; }), (std::set<int>{0x08, 0x1B}));
    int before = -1;
    for (const CommandRow& row : commands()) {
        EXPECT_GT(row.number, before) << row.name;
        before = row.number;
        EXPECT_EQ(find_command(row.number), &row);
        EXPECT_EQ(find_command(row.name), &row);
        EXPECT_FALSE(row.section.empty()) << row.name;
    }
    EXPECT_EQ(find_command(std::uint8_t{0x04}), nullptr);
    EXPECT_EQ(find_command("go_to"), find_command(std::uint8_t{0x13}));
}

// The marks of both manuals together.
TEST(MidiCommands, ForbiddenWhileMoving) {
    EXPECT_EQ(numbers_where([](const CommandRow& row) { return !row.while_moving; }),
              (std::set<int>{0x02, 0x03, 0x09, 0x0A, 0x0D, 0x0F, 0x13, 0x14}));
}

// 000 §VI 11h: the commands that accept synchronous mode.
TEST(MidiCommands, WhatWaitsForSync) {
    EXPECT_EQ(numbers_where([](const CommandRow& row) { return row.waits_for_sync; }),
              (std::set<int>{0x13, 0x14, 0x15}));
}

// 003 §VII 01h: every motion command; stopping and power off are let through (R).
TEST(MidiCommands, RefusedWithAFault) {
    EXPECT_EQ(numbers_where([](const CommandRow& row) { return !row.with_fault; }),
              (std::set<int>{0x11, 0x13, 0x14, 0x15, 0x16, 0x19, 0x1E}));
}

// "Stored at power-off": 08, 09, 0A, 0C, 0D, 0E, 0F and 1B say so; 02, 03 and 1C are ours.
TEST(MidiCommands, WhatIsKept) {
    EXPECT_EQ(numbers_where([](const CommandRow& row) { return row.kept; }),
              (std::set<int>{0x02, 0x03, 0x08, 0x09, 0x0A, 0x0C, 0x0D, 0x0E, 0x0F, 0x1B, 0x1C}));
}

// The parameters of 000 §VI as eight digits.
TEST(MidiCommands, ParametersStandWhereTheManualHasThem) {
    const auto packed = [](Command number, std::int32_t first = 0, std::int32_t second = 0) {
        return pack(*find_command(number), first, second);
    };
    EXPECT_EQ(packed(STOP_TORQUE, 1), 0x00000001U);
    EXPECT_EQ(packed(END_STOPS, 9), 0x00000009U);
    EXPECT_EQ(packed(ADDRESS, 0x7F), 0x0000007FU);
    EXPECT_EQ(packed(UPPER_STOP, -1), 0xFFFFFFFFU);
    EXPECT_EQ(packed(TORQUE, 0x40), 0x00000040U);
    EXPECT_EQ(packed(SPEED, 0x0320), 0x00000320U);
    EXPECT_EQ(packed(UNSTALL, 5), 0x00000500U);
    EXPECT_EQ(packed(RAMP, 0xFF), 0x000000FFU);
    EXPECT_EQ(packed(GO_TO, -1000), 0xFFFFFC18U);
    EXPECT_EQ(packed(GO_TO_ZERO), 0U);
    EXPECT_EQ(packed(RUN, kTurnsLeft, 0x0320), 0x00F60320U);
    EXPECT_EQ(packed(RUN, 0, 0), 0U);
    EXPECT_EQ(packed(SEGMENT, 1000, 0x1000), 0x03E81000U);
    EXPECT_EQ(packed(SEGMENT, -1000, 0x1000), 0xFC181000U);
    EXPECT_EQ(packed(PAUSE, 1000, 0x1000), 0x03E81000U);
    EXPECT_EQ(packed(BAUD, 3), 3U);
    EXPECT_EQ(packed(TOLERANCE, 255), 0xFFU);
}

TEST(MidiCommands, LimitsOfEveryField) {
    struct Limit {
        Command number;
        int field;
        std::int64_t min;
        std::int64_t max;
    };
    const Limit limits[] = {{STOP_TORQUE, 0, 0, 1},
                            {END_STOPS, 0, 0, 9},
                            {REFERENCE, 0, 0, 1},
                            {ADDRESS, 0, 0, 0x7F},
                            {TORQUE, 0, 0, 0x80},
                            {SPEED, 0, 1, 0xFFFF},
                            {UNSTALL, 0, 1, 0xFF},
                            {RAMP, 0, 0, 0xFF},
                            {GO_TO, 0, -1073741824, 1073741823},
                            {RUN, 0, 0, 0xFF},
                            {RUN, 1, 0, 0xFFFF},
                            {SEGMENT, 0, -32768, 32767},
                            {SEGMENT, 1, 1, 0xFFFF},
                            {PAUSE, 0, -32768, 32767},
                            {PAUSE, 1, 1, 0xFFFF},
                            {BAUD, 0, 1, 3},
                            {TOLERANCE, 0, 0, 0xFF},
                            {UPPER_STOP, 0, INT32_MIN, INT32_MAX},
                            {LOWER_STOP, 0, INT32_MIN, INT32_MAX}};
    for (const auto& [number, field, min, max] : limits) {
        const CommandRow& row = *find_command(number);
        const auto at = [&row, field = field](std::int64_t value) {
            const auto other = row.fields[1 - static_cast<std::size_t>(field)].min;
            const auto v = static_cast<std::int32_t>(value);
            return field == 0 ? pack(row, v, other) : pack(row, other, v);
        };
        for (const std::int64_t value : {min, max}) {
            ASSERT_TRUE(at(value)) << row.name << ' ' << value;
            EXPECT_TRUE(is_legal(row, *at(value))) << row.name << ' ' << value;
            EXPECT_EQ(unpack(row.fields[static_cast<std::size_t>(field)], *at(value)), value) << row.name;
        }
        if (min == INT32_MIN) continue;  // every longword
        EXPECT_FALSE(at(min - 1)) << row.name;
        EXPECT_FALSE(at(max + 1)) << row.name;
    }
    for (const int stops : {2, 3, 4, 5, 6, 7}) EXPECT_FALSE(pack(*find_command(END_STOPS), stops)) << stops;
    EXPECT_FALSE(is_legal(*find_command(END_STOPS), 5));
    EXPECT_FALSE(is_legal(*find_command(GO_TO), 0x40000000));
    EXPECT_TRUE(is_legal(*find_command(END_STOPS), 0xABCDEF09));  // the rest is don't-care
    EXPECT_FALSE(pack(*find_command(STOP), 1));                   // has no parameter
}

TEST(MidiCommands, WhatIsPackedIsUnpacked) {
    constexpr unsigned kSeed = 9;
    std::mt19937 random(kSeed);
    for (int i = 0; i < 100'000; ++i) {
        const CommandRow& row = commands()[random() % commands().size()];
        const auto data = static_cast<std::uint32_t>(random());
        if (!is_legal(row, data)) continue;
        const auto value = [&](std::size_t f) {
            return row.fields[f].bits == 0 ? 0 : unpack(row.fields[f], data);
        };
        const auto again = pack(row, value(0), value(1));
        ASSERT_TRUE(again) << row.name << " seed " << kSeed << ", round " << i;
        ASSERT_EQ(*again & ~data, 0U) << row.name << " seed " << kSeed << ", round " << i;
        ASSERT_TRUE(is_legal(row, *again)) << row.name << " seed " << kSeed << ", round " << i;
    }
}

// 000 §V.2, 003 §VI.2: ten readings, EEPROM on V24 only.
TEST(MidiQueries, TheListIsTheManuals) {
    ASSERT_EQ(queries().size(), 10U);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(queries()[i].number, i);
        EXPECT_EQ(find_query(static_cast<std::uint8_t>(i)), &queries()[i]);
        EXPECT_EQ(find_query(queries()[i].name), &queries()[i]);
        EXPECT_EQ(queries()[i].on_can, i != GET_EEPROM);
        EXPECT_EQ(queries()[i].at_address, i >= GET_RAM);
    }
    EXPECT_EQ(find_query(std::uint8_t{10}), nullptr);
}

// The replies of 000 §VI 25h, 26h and 27h.
TEST(MidiQueries, FieldsOfReplies) {
    const auto field = [](Query number, std::size_t i, std::uint32_t data) {
        return unpack(find_query(number)->fields[i], data);
    };
    EXPECT_EQ(field(GET_POSITION, 0, 0xFFFFFC18), -1000);
    EXPECT_EQ(field(GET_SPEEDS, 0, 0x050001E0), 5);
    EXPECT_EQ(field(GET_SPEEDS, 1, 0x050001E0), 0x1E0);
    EXPECT_EQ(field(GET_SETTINGS, 0, 0x10401914), 0x10);
    EXPECT_EQ(field(GET_SETTINGS, 1, 0x10401914), 0x40);
    EXPECT_EQ(field(GET_SETTINGS, 2, 0x10401914), 1);
    EXPECT_EQ(field(GET_SETTINGS, 3, 0x10401914), 9);
    EXPECT_EQ(field(GET_SETTINGS, 4, 0x10401914), 0x14);
    EXPECT_EQ(field(GET_MEASURES, 0, 0x50782840), 0x50);
    EXPECT_EQ(field(GET_MEASURES, 1, 0x50782840), 0x78);
    EXPECT_EQ(field(GET_MEASURES, 2, 0x50782840), 0x2840);
}

// 000 §VI 21h and 27h: byte and bit.
TEST(MidiQueries, BitsOfStatusAndTerminals) {
    const auto bit = [](int byte, int number) { return 1U << (8 * (3 - byte) + number); };
    EXPECT_EQ(kOverVoltage, bit(0, 6));
    EXPECT_EQ(kUnderVoltage, bit(0, 5));
    EXPECT_EQ(kThermalTrip23, bit(0, 4));
    EXPECT_EQ(kAmplifierTrip, bit(0, 3));
    EXPECT_EQ(kThermalTrip, bit(0, 2));
    EXPECT_EQ(kEncoderTrip, bit(0, 1));
    EXPECT_EQ(kSupplyTrip, bit(0, 0));
    EXPECT_EQ(kAtUpperInput, bit(1, 3));
    EXPECT_EQ(kAtLowerInput, bit(1, 2));
    EXPECT_EQ(kAtUpperStop, bit(1, 1));
    EXPECT_EQ(kAtLowerStop, bit(1, 0));
    EXPECT_EQ(kOverVoltageKept, bit(3, 7));
    EXPECT_EQ(kUpperInput, bit(2, 5));
    EXPECT_EQ(kNotBusy, bit(2, 3));
    EXPECT_EQ(kLowerInput, bit(3, 6));
    EXPECT_EQ(kReferenceInput, bit(3, 5));
    std::uint32_t all = 0;
    for (const Bit& one : status_bits()) {
        EXPECT_EQ(all & one.mask, 0U) << one.text;
        all |= one.mask;
    }
    EXPECT_EQ(all & kTrips, kTrips);
}

// 000 §I, §VI 1Bh; 003 §II.1, §IV, §VII 01h.
TEST(MidiModels, Facts) {
    EXPECT_EQ(facts_of(Model::mac23).increments_per_rev, 2'000);
    EXPECT_EQ(facts_of(Model::mac34_1).increments_per_rev, 10'000);
    EXPECT_EQ(facts_of(Model::mac34_2).increments_per_rev, 10'000);
    EXPECT_EQ(facts_of(Model::mac34_1).max_supply, 80'000);
    EXPECT_EQ(facts_of(Model::mac34_2).max_supply, 160'000);
    EXPECT_EQ(facts_of(Model::mac34_1).over_voltage, 85'000);
    EXPECT_EQ(facts_of(Model::mac34_2).over_voltage, 170'000);
    EXPECT_EQ(facts_of(Model::mac34_1).under_voltage, 21'000);
    EXPECT_EQ(facts_of(Model::mac34_2).under_voltage, 42'000);
    EXPECT_EQ(baud_of(1), 9'600U);
    EXPECT_EQ(baud_of(2), 19'200U);
    EXPECT_EQ(baud_of(3), kFactoryBaud);
    EXPECT_EQ(baud_of(0), 0U);
    EXPECT_EQ(baud_of(4), 0U);
    for (const Model model : {Model::mac23, Model::mac34_1, Model::mac34_2})
        EXPECT_EQ(model_of(facts_of(model).name), model);
    EXPECT_EQ(model_of("mac34-2"), Model::mac34_2);
    EXPECT_FALSE(model_of("MAC34"));
}

}  // namespace
}  // namespace nplc::registers::midi
