// Records put together by hand after the Hexadecimal Object File Format Specification: length, address high
// byte first, type, data, and a checksum that makes the sum of all bytes 0 modulo 256.
#include "intel_hex/intel_hex.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace nplc::intel_hex {
namespace {

using Bytes = std::vector<std::uint8_t>;

const Bytes kTable = {0xC0, 0, 0, 0x01, 0x80, 0, 0, 0, 0x3F, 0, 0, 0, 0, 0, 0, 0};
const std::string kEnd = ":00000001FF\n";  // 01 -> FF

TEST(IntelHexWriting, OneRecordAndTheEnd) {
    // 10 + C0 + 01 + 80 + 3F = 190 -> checksum 70
    EXPECT_EQ(write(kTable), ":10000000C0000001800000003F0000000000000070\n" + kEnd);
    EXPECT_EQ(write({}), kEnd);
}

TEST(IntelHexWriting, SixteenBytesARecord) {
    const Bytes bytes(17, 0);
    // 10 -> F0; 01 + 10 = 11 -> EF
    EXPECT_EQ(write(bytes), ":1000000000000000000000000000000000000000F0\n:0100100000EF\n" + kEnd);
}

TEST(IntelHexWriting, AFlashAddressTakesAnExtendedRecord) {
    // 02 + 04 + 08 + 01 = 0F -> F1
    EXPECT_EQ(write(kTable, 0x0801'0000),
              ":020000040801F1\n:10000000C0000001800000003F0000000000000070\n" + kEnd);
}

TEST(IntelHexWriting, NoRecordCrosses64KiB) {
    // 08 + FF + F8 + C0 + 01 + 80 = 340 -> C0; 02 + 04 + 01 = 07 -> F9; 08 + 3F = 47 -> B9
    EXPECT_EQ(write(kTable, 0xFFF8),
              ":08FFF800C000000180000000C0\n:020000040001F9\n:080000003F00000000000000B9\n" + kEnd);
}

TEST(IntelHexWriting, TheLastAddressThereIs) {
    // 02 + 04 + FF + FF = 204 -> FC; 01 + FF + FF + AA = 2A9 -> 57
    EXPECT_EQ(write(Bytes{0xAA}, 0xFFFF'FFFF), ":02000004FFFFFC\n:01FFFF00AA57\n" + kEnd);
}

TEST(IntelHexReading, WhatItWrote) {
    std::mt19937 random(1);
    for (const std::uint32_t base : {0U, 1U, 0xFFF0U, 0xFFFFU, 0x10000U, 0x0801'0003U, 0xFFFD'0000U}) {
        for (const std::size_t size : {1U, 8U, 15U, 16U, 17U, 200U, 70'000U}) {
            Bytes bytes(size);
            for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
            const Image image = read(write(bytes, base));
            EXPECT_EQ(image.error, "");
            EXPECT_EQ(image.base, base);
            EXPECT_EQ(image.bytes, bytes) << base << " " << size;
        }
    }
}

TEST(IntelHexReading, LineEndsBlanksAndSmallLetters) {
    const Image image = read("\r\n:01000000aa55\r\n\r\n:00000001ff  \r\n\n \t\n");
    EXPECT_EQ(image.error, "");
    EXPECT_EQ(image.bytes, Bytes{0xAA});
    EXPECT_EQ(read(":01000000AA55\n:00000001FF").bytes, Bytes{0xAA});
}

TEST(IntelHexReading, RecordsInAnyOrder) {
    // 01 + 01 + BB = BD -> 43
    EXPECT_EQ(read(":01000100BB43\n:01000000AA55\n" + kEnd).bytes, (Bytes{0xAA, 0xBB}));
}

TEST(IntelHexReading, SegmentAddressesCountSixteens) {
    // Segment 1200h: the byte is at 12000h. 02 + 02 + 12 = 16 -> EA
    const Image image = read(":020000021200EA\n:01000000AA55\n" + kEnd);
    EXPECT_EQ(image.base, 0x12000U);
    EXPECT_EQ(image.bytes, Bytes{0xAA});
}

TEST(IntelHexReading, AddressesHoldUntilTheNextOne) {
    // 01 + FF + FF + AA = 2A9 -> 57; 02 + 04 + 01 = 07 -> F9
    const Image image = read(":01FFFF00AA57\n:020000040001F9\n:01000000AA55\n" + kEnd);
    EXPECT_EQ(image.base, 0xFFFFU);
    EXPECT_EQ(image.bytes, (Bytes{0xAA, 0xAA}));
}

TEST(IntelHexReading, StartAddressesAreReadOver) {
    // 04 + 03 + 38 = 3F -> C1; 04 + 05 + CD = D6 -> 2A
    EXPECT_EQ(read(":0400000300003800C1\n:04000005000000CD2A\n:01000000AA55\n" + kEnd).bytes, Bytes{0xAA});
}

struct Bad {
    std::string text;
    std::size_t line;
    std::string says;
};

class IntelHexMistake : public testing::TestWithParam<Bad> {};

TEST_P(IntelHexMistake, IsToldWithItsLine) {
    const Image image = read(GetParam().text);
    EXPECT_NE(image.error.find(GetParam().says), std::string::npos) << image.error;
    EXPECT_EQ(image.line, GetParam().line) << image.error;
    EXPECT_TRUE(image.bytes.empty());
}

const std::string kData = ":01000000AA55\n";

INSTANTIATE_TEST_SUITE_P(
    All, IntelHexMistake,
    testing::Values(Bad{"", 1, "the end record (:00000001FF) is missing"}, Bad{kData, 1, "end record"},
                    Bad{kData + "\n\n", 3, "end record"}, Bad{kEnd, 1, "no data records"},
                    Bad{kData + "\nhello\n" + kEnd, 3, "begins with ':'"},
                    Bad{kData + ":0100010XBB43\n" + kEnd, 2, "character 9 is no hex digit"},
                    Bad{":01000000AA56\n" + kEnd, 1, "the checksum is 56 where the record makes 55"},
                    Bad{":01000000AA5\n" + kEnd, 1, "has 11 digits where its length asks for 12"},
                    Bad{":01000000AA5500\n" + kEnd, 1, "has 14 digits where its length asks for 12"},
                    Bad{":\n" + kEnd, 1, "has 0 digits where its length asks for 10"},
                    Bad{":02000000AA55\n" + kEnd, 1, "has 12 digits where its length asks for 14"},
                    Bad{kData + kData + kEnd, 2, "0h is there already"},
                    Bad{":02000000AABB99\n:01000100BB43\n" + kEnd, 2,
                        "1h is there already"},  // 02 + AA + BB = 167 -> 99
                    // 01 + 03 + AA = AE -> 52
                    Bad{kData + ":01000300AA52\n" + kEnd, 2, "nothing says what stands at 1h..2h"},
                    Bad{kData + kEnd + "\n" + kData, 4, "something follows the end record"},
                    Bad{kData + kEnd + "end", 3, "something follows the end record"},
                    Bad{kData + ":00000006FA\n" + kEnd, 2, "no record type 06"},  // 06 -> FA
                    // 01 + 04 + 08 = 0D -> F3; 01 + 01 + AA = AC -> 54
                    Bad{":0100000408F3\n" + kEnd, 1, "type 04 holds 2 bytes, not 1"},
                    Bad{kData + ":01000001AA54\n", 2, "type 01 holds 0 bytes, not 1"},
                    // Two bytes from the last one of a segment on: 02 + FF + FF = 200 -> 00
                    Bad{":020000020000FC\n:02FFFF00000000\n" + kEnd, 2, "runs over the end"},
                    Bad{":02000004FFFFFC\n:02FFFF00000000\n" + kEnd, 2, "runs over the end"},
                    Bad{std::string("\0\0\n", 3), 1, "begins with ':'"}));

TEST(IntelHexFile, KnownByNameOrByItsFirstLine) {
    EXPECT_TRUE(is_file("a.hex", ""));
    EXPECT_TRUE(is_file("a.IHX", "x"));
    EXPECT_TRUE(is_file("a.iHex", "x"));
    EXPECT_TRUE(is_file("a.bin", ":00000001FF"));
    EXPECT_TRUE(is_file("a", ":00000001ff\r\n?"));
    EXPECT_FALSE(is_file("hex", ""));
    EXPECT_FALSE(is_file("a.bin", ""));
    EXPECT_FALSE(is_file("a.bin", ":0000\n"));
    // A raw table can begin with a colon: STATE 3Ah is step 58 with timer and counter at zero.
    const std::string term("\x3A\x01\x01\x02\x80\0\0\0\x3F\0\0\0\0\0\0\0", 16);
    EXPECT_FALSE(is_file("a.bin", term));
}

TEST(FileOfBytes, HoldsThemRawOrAsIntelHex) {
    const std::string raw(kTable.begin(), kTable.end());
    EXPECT_EQ(bytes_in("F.bin", raw).bytes, kTable);
    EXPECT_EQ(bytes_in("F.bin", write(kTable)).bytes, kTable);
    EXPECT_EQ(bytes_in("F.hex", "\xEF\xBB\xBF" + write(kTable) + "\x1A").bytes, kTable);
    EXPECT_EQ(bytes_in("F.bin", "\xEF\xBB\xBF" + write(kTable)).bytes, kTable);
    EXPECT_EQ(bytes_in("F.hex", ":0100000000FF\r" + kEnd.substr(0, 11) + "\r").bytes, Bytes{0});
    EXPECT_EQ(bytes_in("F.bin", std::string(8, '\xFF')).bytes, Bytes(8, 0xFF));  // erased flash
    EXPECT_EQ(bytes_in("F.bin", "").error, "");
}

TEST(FileOfBytes, TextOfAnotherKindIsRefused) {
    const std::string utf16("\xFF\xFEP\0R\0", 6);
    const std::string chinese("?\0\x2D\x4E\x87\x65\x2D\x4E\n\0", 10);  // a table would end at the '?'
    for (const std::string& text :
         {std::string("PROGRAM P"), std::string("T\xC3\xA4glich\r\n"), utf16, chinese}) {
        const Image image = bytes_in("F.bin", text);
        EXPECT_TRUE(image.is_text);
        EXPECT_NE(image.error, "");
        EXPECT_EQ(image.line, 0U);
    }
    EXPECT_EQ(bytes_in("F.bin", chinese).error, "it is text in UTF-16; save it as UTF-8");
    EXPECT_EQ(bytes_in("F.hex", utf16).error, "it is text in UTF-16; save it as UTF-8");
    EXPECT_EQ(bytes_in("F.hex", "PROGRAM P").line, 1U);
}

}  // namespace
}  // namespace nplc::intel_hex
