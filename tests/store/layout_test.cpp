#include <gtest/gtest.h>

#include <algorithm>

#include "store/layout.h"

// What one firmware has stored the next one reads: README.md, "A slot in bytes". The check sum is that of
// zlib.crc32 in Python.
namespace nplc::store {
namespace {

constexpr std::array<std::uint8_t, kHeaderBytes> kStored{0x4E, 0x50, 0x53, 0x74,   // "NPSt"
                                                         1,    1,    0,    0,      // format, kind
                                                         0x04, 0x03, 0x02, 0x01,   // sequence number
                                                         0x44, 0x33, 0x22, 0x11,   // length
                                                         0x88, 0x77, 0x66, 0x55,   // CRC-32 of the content
                                                         0x8D, 0x8C, 0x3F, 0xF8};  // CRC-32 of what is before
constexpr Header kHeader{
    .kind = Kind::table, .sequence = 0x01020304, .length = 0x11223344, .crc = 0x55667788};

TEST(StoreLayout, AHeaderInBytes) {
    EXPECT_EQ(encode(kHeader), kStored);
    const auto read = decode(kStored);
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read.value(), kHeader);
}

TEST(StoreLayout, AMarkInBytes) {
    EXPECT_EQ(mark_for(kStored),
              (std::array<std::uint8_t, kMarkBytes>{'D', 'O', 'N', 'E', 0x8D, 0x8C, 0x3F, 0xF8}));
}

TEST(StoreLayout, OfAnotherFormatIsDamaged) {
    // Format 2, with its check sum.
    auto bytes = kStored;
    bytes[4] = 2;
    const std::array<std::uint8_t, 4> sum{0x7F, 0x38, 0xF7, 0xD1};
    std::copy(sum.begin(), sum.end(), bytes.begin() + 20);
    EXPECT_FALSE(decode(bytes).ok());
}

/// 256-byte blocks, 8-byte units: header 24, mark 8, content, a unit for what is superseded.
TEST(StoreLayout, WhereThePartsOfASlotLie) {
    const Layout layout({.size = 4096, .erase_block = 256, .program_page = 64, .program_unit = 8},
                        {512, 768});
    EXPECT_TRUE(layout.is_possible());
    EXPECT_EQ(layout.header(0), 512U);
    EXPECT_EQ(layout.mark(0), 536U);
    EXPECT_EQ(layout.content(0), 544U);
    EXPECT_EQ(layout.superseded(0), 1272U);
    EXPECT_EQ(layout.end(0), 1280U);
    EXPECT_EQ(layout.capacity(), 728U);
    EXPECT_EQ(layout.header(1), 1280U);
    EXPECT_EQ(layout.end(1), 2048U);
}

TEST(StoreLayout, PartsBeginWithAUnit) {
    const Layout layout({.size = 4096, .erase_block = 256, .program_page = 256, .program_unit = 32},
                        {0, 256});
    EXPECT_EQ(layout.whole_units(0), 0U);
    EXPECT_EQ(layout.whole_units(1), 32U);
    EXPECT_EQ(layout.whole_units(32), 32U);
    EXPECT_EQ(layout.whole_units(33), 64U);
    EXPECT_EQ(layout.mark(0), 32U);
    EXPECT_EQ(layout.content(0), 64U);
    EXPECT_EQ(layout.superseded(0), 224U);
}

TEST(StoreLayout, AProgrammingStaysInItsPage) {
    const Layout layout({.size = 4096, .erase_block = 256, .program_page = 64, .program_unit = 8}, {0, 256});
    EXPECT_EQ(layout.one_programming(0, 8), 8U);
    EXPECT_EQ(layout.one_programming(0, 100), 64U);
    EXPECT_EQ(layout.one_programming(40, 100), 24U);
    EXPECT_EQ(layout.one_programming(56, 8), 8U);
}

TEST(StoreLayout, LaterIsCountedAcrossTheWrap) {
    EXPECT_TRUE(is_later(1, 0));
    EXPECT_FALSE(is_later(0, 0));
    EXPECT_FALSE(is_later(0, 1));
    EXPECT_TRUE(is_later(0, 0xFFFF'FFFF));
    EXPECT_TRUE(is_later(0x7FFF'FFFF, 0));
    EXPECT_FALSE(is_later(0x8000'0000, 0));
}

struct Misfit {
    const char* what;
    ports::StorageGeometry geometry;
    Area area;
};

constexpr Misfit kMisfits[]{
    {"unit 0", {.size = 4096, .erase_block = 256, .program_page = 64, .program_unit = 0}, {0, 256}},
    {"page 0", {.size = 4096, .erase_block = 256, .program_page = 0, .program_unit = 8}, {0, 256}},
    {"block 0", {.size = 4096, .erase_block = 0, .program_page = 64, .program_unit = 8}, {0, 256}},
    {"page of units and a half",
     {.size = 4096, .erase_block = 240, .program_page = 60, .program_unit = 8},
     {0, 240}},
    {"block of pages and a half",
     {.size = 4096, .erase_block = 160, .program_page = 64, .program_unit = 8},
     {0, 160}},
    {"size of blocks and a half",
     {.size = 4000, .erase_block = 256, .program_page = 64, .program_unit = 8},
     {0, 256}},
    {"unit of 512", {.size = 8192, .erase_block = 4096, .program_page = 512, .program_unit = 512}, {0, 4096}},
    {"slot of blocks and a half",
     {.size = 4096, .erase_block = 256, .program_page = 64, .program_unit = 8},
     {0, 384}},
    {"no slot", {.size = 4096, .erase_block = 256, .program_page = 64, .program_unit = 8}, {0, 0}},
    {"begin inside a block",
     {.size = 4096, .erase_block = 256, .program_page = 64, .program_unit = 8},
     {128, 256}},
    {"begin behind the end",
     {.size = 4096, .erase_block = 256, .program_page = 64, .program_unit = 8},
     {4352, 256}},
    {"second slot behind the end",
     {.size = 4096, .erase_block = 256, .program_page = 64, .program_unit = 8},
     {3840, 256}},
    {"no byte of content", {.size = 960, .erase_block = 96, .program_page = 32, .program_unit = 32}, {0, 96}},
    {"no room for content",
     {.size = 4096, .erase_block = 256, .program_page = 256, .program_unit = 128},
     {0, 256}},
};

TEST(StoreLayout, OnlyOnWhatFits) {
    for (const Misfit& misfit : kMisfits)
        EXPECT_FALSE(Layout(misfit.geometry, misfit.area).is_possible()) << misfit.what;
    const ports::StorageGeometry good{
        .size = 4096, .erase_block = 256, .program_page = 64, .program_unit = 8};
    EXPECT_TRUE(Layout(good, {3584, 256}).is_possible());
    const ports::StorageGeometry largest{
        .size = 8192, .erase_block = 4096, .program_page = 256, .program_unit = 256};
    EXPECT_TRUE(Layout(largest, {0, 4096}).is_possible());
}

}  // namespace
}  // namespace nplc::store
