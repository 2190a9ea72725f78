#include "macreg/midi/raw.h"

#include <gtest/gtest.h>

namespace nplc::macreg::midi {
namespace {

const Scale kMac23{.model = reg::Model::mac23};

TEST(MidiRaw, TheManualsExample) {
    // 000 §VI, at its end.
    const auto [request, error] = read_raw("00150000000320", false);
    EXPECT_EQ(error, "");
    EXPECT_EQ(request, (midi_client::Request{.number = 0x15, .data = 0x320}));
    EXPECT_EQ(describe_request(request, kMac23), "RUN to address 0: clockwise, period 300 rpm (10000 inc/s)");
    EXPECT_EQ(describe_request(read_raw("7F 15 00 00F60320", false).request, kMac23),
              "RUN to address 127: counter-clockwise, period 300 rpm (10000 inc/s)");
    // 000 §IV, 003 §V.8: who is meant.
    EXPECT_EQ(describe_request(read_raw("FF 18 00 00000000", false).request, {}),
              "EMERGENCY_STOP to all modules");
    EXPECT_EQ(describe_request(read_raw("00 18 00 00000000", true).request, {}, true),
              "EMERGENCY_STOP to all modules");
}

TEST(MidiRaw, Queries) {
    const auto [request, error] = read_raw("0528AF00000000", false);
    EXPECT_EQ(error, "");
    EXPECT_EQ(request, (midi_client::Request{.address = 5, .query = true, .number = 8, .sub_index = 0xAF}));
    EXPECT_EQ(describe_request(request, {}), "GET_RAM of byte AFh to address 5");
    using Kind = midi_client::Answer::Kind;
    EXPECT_EQ(describe_answer(request, {.kind = Kind::value, .value = 0x80000000}, {}), "bytes 80000000h");
    EXPECT_EQ(describe_answer(read_raw("00200000000000", false).request,
                              {.kind = Kind::value, .value = 0xFFFFFFFF}, kMac23),
              "position -1 inc (-0.0005 rev)");
}

TEST(MidiRaw, WrongOnesAreTold) {
    // 000's own example of what the maker's tool takes lacks a digit.
    EXPECT_NE(read_raw("0015000000320", false).error.find("has 13 digits: write 14"), std::string::npos);
    EXPECT_NE(read_raw("", false).error, "");
    EXPECT_NE(read_raw("0015000000032G", false).error, "");
    EXPECT_NE(read_raw("80150000000320", false).error, "");
    EXPECT_EQ(read_raw("FF150000000320", false).error, "");
    EXPECT_NE(read_raw("FF150000000320", true).error, "");
    EXPECT_NE(read_raw("00300000000000", false).error, "");
}

TEST(MidiRaw, WhatMovesOrRenamesIsDangerous) {
    for (const char* frame :
         {"00000000000000", "00010000000000", "00080000000005", "00100000000000", "00110000000000",
          "00130000000320", "00140000000000", "00150000000320", "00160000000320", "00190000000000",
          "001A0000000000", "001B0000000001", "001E0000000320", "00040000000000"})
        EXPECT_NE(danger_of(read_raw(frame, false).request), "") << frame;
    for (const char* frame : {"00170000000000", "00180000000000", "00200000000000", "000D0000000320"})
        EXPECT_EQ(danger_of(read_raw(frame, false).request), "") << frame;
}

}  // namespace
}  // namespace nplc::macreg::midi
