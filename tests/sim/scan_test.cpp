#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "input_file.h"
#include "scan_command.h"
#include "sequencer/term.h"

namespace nplc::sim {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::string_view kHeader = "scan,step,timer,counter,outputs,fastmac,flexmac\n";

/// 001 §6.1.5 - §6.1.8, byte by byte. The end term is added.
std::string scan(Bytes terms, const std::string& stimulus_rows) {
    terms.insert(terms.end(), {0x3F, 0, 0, 0, 0, 0, 0, 0});
    const std::string csv =
        scan_csv(terms, parse_stimulus("dt_ms,inputs,inpos,error\n" + stimulus_rows, "s.csv"));
    EXPECT_TRUE(csv.starts_with(kHeader));
    return csv.substr(kHeader.size());
}

std::string message(const std::string& stimulus) {
    try {
        parse_stimulus(stimulus, "s.csv");
    } catch (const InputError& error) {
        return error.what();
    }
    return "(taken)";
}

TEST(Scan, PresetsOfSetPointsStandAboveTheHeader) {
    const std::string text =
        "# preset 10000 in term 5, 9: Soak := 10000 ms\r\n# preset 1 in term "
        "0\ndt_ms,inputs,inpos,error\n1,2,0,0\n";
    EXPECT_EQ(parse_presets(text, "s.csv"),
              (std::vector<StimulusPreset>{{.value = 10000, .terms = {5, 9}}, {.value = 1, .terms = {0}}}));
    EXPECT_EQ(parse_stimulus(text, "s.csv"), (std::vector<StimulusRow>{{1, 2}}));
    EXPECT_TRUE(parse_presets("dt_ms,inputs,inpos,error\n", "s.csv").empty());
    for (const char* wrong : {"# preset 70000 in term 1\n", "# preset 1 in term\n", "# Soak\n",
                              "# preset 1 in term 2 Soak\n", "# preset 1 in term 2,\n"})
        EXPECT_THROW(parse_presets(wrong, "s.csv"), InputError) << wrong;
    EXPECT_NE(message("dt_ms,inputs,inpos,error\n# preset 1 in term 2\n"), "(taken)");
}

TEST(Scan, TheTimeToTheNextScanIsTakenOffAPreset) {
    // Step 0, timer and counter free (C0h); NEXT_STATE 1; no command (FAST_DIS); OUT0 and OUT3; timer 500 =
    // 01F4h
    EXPECT_EQ(scan({0xC0, 0x00, 0x00, 0x01, 0x80, 0x09, 0xF4, 0x01}, "10,0,0,0\n490,0,0,0\n"),
              "1,1,490,0,9,,\n"
              "2,1,0,0,9,,\n");
}

TEST(Scan, CommandsAreHexWithoutToggleInTableOrder) {
    // POSITION(P2) = 10 00001 = 41h; NOP is 60h; both sent while IN0 is 1. The FlexMAC terms write register
    // 65 (41h) with 3146 = 0C4Ah, and register 49 (31h) as a longword (B1h) with 49152 = 0000C000h.
    const Bytes table{0xC0, 0x01, 0x01, 0x3E, 0x41, 0x00, 0x00, 0x00,  //
                      0xC0, 0x01, 0x81, 0x41, 0x4A, 0x0C, 0x00, 0x00,  //
                      0xC0, 0x01, 0x81, 0xB1, 0x00, 0xC0, 0x00, 0x00,  //
                      0xC0, 0x01, 0x01, 0x3E, 0x60, 0x00, 0x00, 0x00};
    EXPECT_EQ(scan(table, "1,1,0,0\n1,0,0,0\n"),
              "1,0,0,0,0,41 60,65=3146 49=49152\n"
              "2,0,0,0,0,,\n");
}

TEST(Scan, InputsInposAndErrorAreTheImage) {
    // INPUT 61h with CARE 61h: IN0 and IN5 and INPOS; ERROR bit 0. Second term: ERROR bit 1, whatever the
    // rest.
    const Bytes table{0xC0, 0x61, 0x61, 0x02, 0x80, 0x00, 0x00, 0x00,  //
                      0xC0, 0x80, 0x00, 0x03, 0x80, 0x00, 0x00, 0x00};
    EXPECT_EQ(scan(table, "0,33,0,0\n0,33,1,0\n"), "1,0,0,0,0,,\n2,2,0,0,0,,\n");
    EXPECT_EQ(scan(table, "0,33,1,1\n"), "1,3,0,0,0,,\n");
}

TEST(Scan, TheCounterIsPresetAndCountedDown) {
    // Step 0: counter := 2 (NEXT_STATE 41h = CNT_TIME + step 1). Step 1: CNT_DWN (80h), stays.
    const Bytes table{0xC0, 0x00, 0x00, 0x41, 0x80, 0x00, 0x02, 0x00,  //
                      0xC1, 0x00, 0x00, 0x3E, 0x80, 0x80, 0x00, 0x00};
    EXPECT_EQ(scan(table, "0,0,0,0\n0,0,0,0\n0,0,0,0\n0,0,0,0\n"),
              "1,1,0,2,0,,\n2,1,0,1,0,,\n3,1,0,0,0,,\n4,1,0,0,0,,\n");
}

TEST(Scan, ALongPauseEmptiesTheTimer) {
    EXPECT_EQ(scan({0xC0, 0x00, 0x00, 0x01, 0x80, 0x00, 0xFF, 0xFF}, "4294967295,0,0,0\n"), "1,1,0,0,0,,\n");
}

TEST(Stimulus, RowsAreRead) {
    const auto rows = parse_stimulus("dt_ms,inputs,inpos,error\r\n10,63,1,0\r\n0,0,0,1", "s.csv");
    EXPECT_EQ(rows, (std::vector<StimulusRow>{{10, 0x7F}, {0, 0x80}}));
    EXPECT_TRUE(parse_stimulus("dt_ms,inputs,inpos,error\n", "s.csv").empty());
}

TEST(Stimulus, MistakesNameFileAndLine) {
    const std::string header = "dt_ms,inputs,inpos,error\n";
    EXPECT_EQ(message(""), "s.csv:1: the header is \"\"; write dt_ms,inputs,inpos,error");
    EXPECT_EQ(message("dt,inputs\n1,2,0,0\n"),
              "s.csv:1: the header is \"dt,inputs\"; write dt_ms,inputs,inpos,error");
    EXPECT_EQ(message(header + "1,2,0\n"),
              "s.csv:2: \"1,2,0\" has 3 fields; write the four dt_ms,inputs,inpos,error");
    EXPECT_EQ(message(header + "1,2,0,0\n\n , ,,\n1,2,0\n"),
              "s.csv:5: \"1,2,0\" has 3 fields; write the four dt_ms,inputs,inpos,error");
    EXPECT_EQ(message(header + "1,64,0,0\n"), "s.csv:2: inputs is \"64\"; write a whole number 0 to 63");
    EXPECT_EQ(message(header + "1,0,2,0\n"), "s.csv:2: inpos is \"2\"; write a whole number 0 to 1");
    EXPECT_EQ(message(header + "1,0,0,-1\n"), "s.csv:2: error is \"-1\"; write a whole number 0 to 1");
    EXPECT_EQ(message(header + "4294967296,0,0,0\n"),
              "s.csv:2: dt_ms is \"4294967296\"; write a whole number 0 to 4294967295");
    for (const char* field : {"", " 1", "1 ", "+1", "0x1", "1.0", "1e3", "99999999999999999999"}) {
        EXPECT_EQ(message(header + field + ",0,0,0\n"),
                  "s.csv:2: dt_ms is \"" + std::string(field) + "\"; write a whole number 0 to 4294967295");
    }
}

TEST(Stimulus, MessagesStayOnOneShortLine) {
    const std::string text = message("\x1B[31m" + std::string(5000, 'x'));
    EXPECT_EQ(text.find('\x1B'), std::string::npos);
    EXPECT_LT(text.size(), 120U);
}

}  // namespace
}  // namespace nplc::sim
