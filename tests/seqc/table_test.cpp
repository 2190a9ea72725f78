// Whole tables written down by hand from 001 §5.2.1.4 and §6.1.5 - §6.1.8.
#include <gtest/gtest.h>

#include "support.h"

namespace nplc::seqc {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes table_of(std::string_view source) {
    const Compilation compilation = compile(source);
    EXPECT_TRUE(compilation.ok) << test::shown(compilation, source);
    return compilation.table;
}

TEST(Table, SmallestProgram) {
    // Step 0 goes to step 1 (NEXT 01, FAST_DIS 80); ERROR in step 1 has no term: OWN ERROR.
    EXPECT_EQ(table_of("PROGRAM P STEP S: OWN ERROR; END_STEP END_PROGRAM"),
              (Bytes{0xC0, 0x00, 0x00, 0x01, 0x80, 0x00, 0x00, 0x00,  //
                     0x3F, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00}));
}

// 001 §6.1.5's condition: INPUT0 AND NOT INPUT3 AND INPOS AND NOT ERROR: INPUT 41h, CARE 49h.
TEST(Table, ManualsCondition) {
    EXPECT_EQ(
        table_of("PROGRAM P STEP S: OWN ERROR; IF IN0 AND NOT IN3 AND INPOS THEN NEXT := T; END_IF END_STEP\n"
                 "STEP T: OWN ERROR; END_STEP END_PROGRAM"),
        (Bytes{0xC0, 0x00, 0x00, 0x01, 0x80, 0x00, 0x00, 0x00,  //
               0xC1, 0x41, 0x49, 0x02, 0x80, 0x00, 0x00, 0x00,  //
               0x3F, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00}));
}

TEST(Table, TimerCounterOutputsAndCommand) {
    EXPECT_EQ(table_of("PROGRAM P MOTOR MAC140;\n"
                       "STEP S: OWN ERROR; OUT OUT1;\n"
                       "  IF IN5 THEN TIMER := T#500ms; COUNTER := 12; NEXT := T; END_IF END_STEP\n"
                       "STEP T: OWN ERROR; OUT OUT0, OUT3; ENTRY POSITION(P2);\n"
                       "  IF TIMER.Q THEN COUNT_DOWN; NEXT := S; END_IF END_STEP END_PROGRAM"),
              (Bytes{
                  0xC0, 0x00, 0x00, 0x01,
                  0x80, 0x02, 0x00, 0x00,  // outputs of S: bit 1
                  0xC1, 0x20, 0x20, 0x02,
                  0x41, 0x09, 0xF4, 0x01,  // position mode 10, P2 00001; 500 = 01F4h to the timer
                  0xC1, 0x20, 0x20, 0x42,
                  0x80, 0x09, 0x0C, 0x00,  // CNT_TIME 40h: 12 to the counter, no command
                  0x42, 0x00, 0x00, 0x01,
                  0x80, 0x82, 0x00, 0x00,  // TIMER_BIT 0: timer zero; CNT_DWN 80h, outputs of S
                  0x3F, 0x00, 0x00, 0x00,
                  0x00, 0x00, 0x00, 0x00,
              }));
}

TEST(Table, PowerUpWritesRegistersThenCommandsThenGoesOn) {
    EXPECT_EQ(table_of("PROGRAM P MOTOR MAC140; SCALE 1 rev = 5 mm;\n"
                       "VAR_MOTOR Place AT P2 := 60 mm; Fast AT V1 := 1500 rpm; END_VAR\n"
                       "POWER_UP INIT(Fast, A1); NEXT := S; END_POWER_UP\n"
                       "STEP S: OWN ERROR; OUT OUT3; END_STEP END_PROGRAM"),
              (Bytes{
                  // 60 mm = 12 rev = 12 x 4096 = 49152 = C000h into register 51 (33h), LONGWORD 80h
                  0xC0,
                  0x00,
                  0x80,
                  0xB3,
                  0x00,
                  0xC0,
                  0x00,
                  0x00,
                  // 1500 rpm = 25 rev/s x 4096 / (7812.5 / 15) x 16 = 3145.7, so 3146 = 0C4Ah into register
                  // 65 (41h)
                  0xC0,
                  0x00,
                  0x80,
                  0x41,
                  0x4A,
                  0x0C,
                  0x00,
                  0x00,
                  0xC0,
                  0x00,
                  0x00,
                  0x01,
                  0x08,
                  0x08,
                  0x00,
                  0x00,  // init mode 00, V1 01000
                  0xC0,
                  0x00,
                  0x00,
                  0x01,
                  0x10,
                  0x08,
                  0x00,
                  0x00,  // init mode 00, A1 10000
                  0x3F,
                  0x00,
                  0x00,
                  0x00,
                  0x00,
                  0x00,
                  0x00,
                  0x00,
              }));
}

TEST(Table, RegistersOfTheMac800AreLong) {
    // 100 rpm is 277 on a MAC800 (004, register 5), 277 = 0115h; -5 counts = FFFFFFFBh.
    EXPECT_EQ(
        table_of("PROGRAM P MOTOR MAC800; VAR_MOTOR v AT V2 := 100 rpm; p AT POS0 := -5 counts; END_VAR\n"
                 "STEP S: OWN ERROR; END_STEP END_PROGRAM"),
        (Bytes{
            0xC0, 0x00, 0x80, 0xC2, 0x15, 0x01, 0x00, 0x00,  //
            0xC0, 0x00, 0x80, 0xB1, 0xFB, 0xFF, 0xFF, 0xFF,  //
            0xC0, 0x00, 0x00, 0x01, 0x80, 0x00, 0x00, 0x00,  //
            0x3F, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
        }));
}

TEST(Table, OnErrorCoversPowerUpAndEveryOtherStep) {
    EXPECT_EQ(table_of("PROGRAM P MOTOR MAC140; VAR_MOTOR w AT Z1 := 20 counts; END_VAR\n"
                       "ON ERROR NEXT := Fault;\n"
                       "STEP S: END_STEP\n"
                       "STEP Fault: OWN ERROR; OUT OUT2; ENTRY STOP;\n"
                       "  IF ANY ERROR AND IN2 THEN RESET_ERROR; NEXT := S; END_IF END_STEP END_PROGRAM"),
              (Bytes{
                  0xC0, 0x00, 0x80, 0x55,
                  0x14, 0x00, 0x00, 0x00,  // 20 into register 85
                  0xC0, 0x00, 0x00, 0x01,
                  0x80, 0x00, 0x00, 0x00,  //
                  0xC0, 0x80, 0x80, 0x55,
                  0x14, 0x00, 0x00, 0x00,  // the value also where the motor starts with an error
                  0xC0, 0x80, 0x00, 0x02,
                  0x65, 0x04, 0x00, 0x00,  // to Fault, with its ENTRY and outputs
                  0xC1, 0x80, 0x00, 0x02,
                  0x65, 0x04, 0x00, 0x00,  //
                  0xC2, 0x04, 0x04, 0x01,
                  0x61, 0x00, 0x00, 0x00,  // ANY ERROR: one term without
                  0xC2, 0x84, 0x04, 0x01,
                  0x61, 0x00, 0x00, 0x00,  // and one with ERROR
                  0x3F, 0x00, 0x00, 0x00,
                  0x00, 0x00, 0x00, 0x00,
              }));
}

// Every command byte of 001 §5.2.1.4 by name, without its toggle bit.
TEST(Table, EveryCommand) {
    struct Row {
        const char* text;
        int byte;
    };
    const Row rows[] = {
        {"NOP", 0x60},
        {"RESET_ERROR", 0x61},
        {"CLEAR_P_SOLL", 0x62},
        {"CLEAR_P_IST", 0x63},
        {"CLEAR_P_FNC", 0x64},
        {"STOP", 0x65},
        {"CLEAR_T_SOLL", 0x66},
        {"CLEAR_IN_POS", 0x67},
        {"MOVE_P7_BY_P_FNC", 0x68},
        {"MOVE_P8_BY_P_FNC", 0x69},
        {"USE_SET(1)", 0x6C},
        {"USE_SET(2)", 0x6D},
        {"USE_SET(3)", 0x6E},
        {"USE_SET(4)", 0x6F},
        {"HOME", 0x70},
        {"MOVE_P7_BY_P_SOLL", 0x71},
        {"MOVE_P8_BY_P_SOLL", 0x72},
        {"POSITIONS_ABSOLUTE", 0x74},
        {"POSITIONS_RELATIVE_P_SOLL", 0x75},
        {"POSITIONS_RELATIVE_P_FNC", 0x76},
        {"TRANSMIT_ADDRESS", 0x7D},
        {"INIT(P1)", 0x00},
        {"INIT(P8)", 0x07},
        {"INIT(V2)", 0x09},
        {"INIT(A1)", 0x10},
        {"INIT(T2)", 0x15},
        {"INIT(L4)", 0x1B},
        {"INIT(Z3)", 0x1E},
        {"VELOCITY(V3)", 0x2A},
        {"VELOCITY(V8)", 0x2F},
        {"POSITION(P2)", 0x41},
        {"POSITION(P6)", 0x45},
    };
    for (const Row& row : rows) {
        const Bytes table =
            table_of("PROGRAM P MOTOR MAC140; STEP S: OWN ERROR; IF IN0 THEN " + std::string(row.text) +
                     "; NEXT := T; END_IF END_STEP STEP T: OWN ERROR; END_STEP END_PROGRAM");
        ASSERT_EQ(table.size(), 24U) << row.text;
        EXPECT_EQ(table[8 + 4], row.byte) << row.text;
    }
}

TEST(Table, SelectionsGoOutBeforeThePosition) {
    const Bytes table = table_of(
        "PROGRAM P MOTOR MAC140; STEP S: OWN ERROR; IF IN0 THEN INIT(P5, V3, Z1); NEXT := T; "
        "END_IF END_STEP STEP T: OWN ERROR; END_STEP END_PROGRAM");
    EXPECT_EQ(test::scan(table, 1, 0x01, false, false).sends, (std::vector<std::string>{"0A", "1C", "04"}));
}

TEST(Table, CountersBits) {
    const Bytes table = table_of(
        "PROGRAM P STEP S: OWN ERROR;\n"
        "IF IN0 THEN CLEAR_COUNTER; NEXT := T; ELSIF IN1 THEN COUNTER := 0; NEXT := T; "
        "ELSIF COUNTER.Q THEN COUNT_DOWN; NEXT := T; END_IF END_STEP\n"
        "STEP T: OWN ERROR; END_STEP END_PROGRAM");
    EXPECT_EQ(test::scan(table, 1, 0x01, false, false).clears, true);
    EXPECT_EQ(test::scan(table, 1, 0x02, false, false).clears, true);
    EXPECT_EQ(test::scan(table, 1, 0x00, false, true).counts, true);
    EXPECT_EQ(test::scan(table, 1, 0x00, false, false), test::Scan{});
}

TEST(Table, RawTermsStandAsWritten) {
    EXPECT_EQ(table_of("PROGRAM P TERM 16#C0, 1, 2#10, 16#42, 93, 202, 16#F4, 16#01;\n"
                       "TERM 16#FF, 1, 2, 3, 4, 5, 6, 7; END_PROGRAM"),
              (Bytes{0xC0, 0x01, 0x02, 0x42, 0x5D, 0xCA, 0xF4, 0x01, 0xFF, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(Table, RawTermInsideItsStepFollowsTheStepsOwn) {
    const Bytes table = table_of(
        "PROGRAM P STEP S: OWN ERROR; TERM 16#C1,0,0,16#3E,16#80,15,0,0;\n"
        "IF IN0 THEN NEXT := T; END_IF END_STEP STEP T: OWN ERROR; END_STEP END_PROGRAM");
    EXPECT_EQ(test::term_text(table, 1), "C1 01 01 02 80 00 00 00");
    EXPECT_EQ(test::term_text(table, 2), "C1 00 00 3E 80 0F 00 00");
}

}  // namespace
}  // namespace nplc::seqc
