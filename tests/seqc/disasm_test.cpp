#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(Disasm, RandomTablesComeBackUnchanged) {
    test::Random random(3);
    for (int round = 0; round < 10'000; ++round) {
        Bytes table;
        const unsigned terms = random() % 6;
        for (unsigned i = 0; i < terms; ++i) {
            const std::size_t at = table.size();
            for (int b = 0; b < 8; ++b) table.push_back(static_cast<std::uint8_t>(random()));
            if ((table[at] & 0x3F) == 0x3F) table[at] ^= 1;
        }
        const std::size_t at = table.size();
        for (int b = 0; b < 8; ++b) table.push_back(static_cast<std::uint8_t>(random()));
        table[at] |= 0x3F;
        const Disassembly text = disassemble(table, "Random");
        ASSERT_EQ(text.error, "") << "seed 3, round " << round;
        const Compilation again = compile(text.text);
        ASSERT_TRUE(again.ok) << "seed 3, round " << round << "\n" << test::shown(again, text.text);
        ASSERT_EQ(again.table, table) << "seed 3, round " << round << "\n" << text.text;
    }
}

TEST(Disasm, ALongTableComesBackUnchanged) {
    Bytes table;
    for (int i = 0; i < 3000; ++i)
        table.insert(table.end(), {0xC1, 0, 0, 0x3E, 0x80, 0, 0, static_cast<std::uint8_t>(i)});
    table.insert(table.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_EQ(compile(disassemble(table, "Long").text).table, table);
}

TEST(Disasm, ExplainsEachTerm) {
    const Bytes table = {0xC0, 0x41, 0x49, 0x02, 0x41, 0x09, 0xF4, 0x01,  //
                         0x05, 0x80, 0x00, 0x7E, 0x80, 0xC0, 0x0C, 0x00,  //
                         0xC5, 0x00, 0x80, 0xB1, 0xFF, 0xFF, 0xFF, 0xFF,  //
                         0x3F, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00};
    EXPECT_EQ(disassemble(table, "Old").text,
              "// 4 terms, the end included, one a line: STATE, INPUT, CARE and five bytes of command.\n"
              "PROGRAM Old\n"
              "TERM 16#C0, 16#41, 16#49, 16#02, 16#41, 16#09, 16#F4, 16#01;  // step 0: IF IN0 AND NOT IN3 "
              "AND INPOS "
              "AND NOT ERROR THEN POSITION(P2); OUT OUT0, OUT3; TIMER := T#500ms; NEXT := step 2\n"
              "TERM 16#05, 16#80, 16#00, 16#7E, 16#80, 16#C0, 16#0C, 16#00;  // step 5: IF TIMER.Q AND "
              "COUNTER.Q AND "
              "ERROR THEN OUT none; COUNTER := 12; CLEAR_COUNTER; COUNT_DOWN\n"
              "TERM 16#C5, 16#00, 16#80, 16#B1, 16#FF, 16#FF, 16#FF, 16#FF;  // step 5: IF NOT ERROR THEN "
              "REG(49) P1 := "
              "-1, 32 bits\n"
              "TERM 16#3F, 16#00, 16#00, 16#00, 16#00, 16#00, 16#00, 16#00;  // end of the table\n"
              "END_PROGRAM\n");
}

TEST(Disasm, SaysWhatFollowsTheEnd) {
    const Bytes table = {0x3F, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3};
    const Disassembly result = disassemble(table, "x");
    EXPECT_EQ(result.trailing_bytes, 3U);
    EXPECT_NE(result.text.find("3 bytes that followed the end are left out"), std::string::npos);
    EXPECT_EQ(compile(result.text).table, Bytes(table.begin(), table.begin() + 8));
}

TEST(Disasm, RefusesWhatIsNoTable) {
    EXPECT_NE(disassemble({}, "x").error, "");
    EXPECT_NE(disassemble(Bytes{0x3F, 0, 0}, "x").error, "");
    EXPECT_NE(disassemble(Bytes(16, 0xC0), "x").error, "");
}

TEST(Disasm, OddFileNamesBecomeATable) {
    const Bytes table = {0x3F, 0, 0, 0, 0, 0, 0, 0};
    for (const char* name : {"", "9lives", "my table", "STEP", "a-b", "\xC3\xA4"}) {
        EXPECT_TRUE(compile(disassemble(table, name).text).ok) << name;
    }
}

}  // namespace
}  // namespace nplc::seqc
