#include "sim/text.h"

#include <gtest/gtest.h>

namespace nplc::sim {
namespace {

using namespace std::chrono_literals;

TEST(Text, DurationsTakeAllUnits) {
    EXPECT_EQ(parse_duration("250us"), Time(250us));
    EXPECT_EQ(parse_duration("500ms"), Time(500ms));
    EXPECT_EQ(parse_duration("1.5 s"), Time(1500ms));
    EXPECT_EQ(parse_duration("2min"), Time(120s));
    EXPECT_EQ(parse_duration("0s"), Time(0));
    EXPECT_EQ(parse_duration("1000000min"), Time(60'000'000s));
}

TEST(Text, DurationsAreReadStrictly) {
    for (const char* text : {"", "5", "s", "-1s", "5 sec", "1..5s", ".5s", "5.s", "5s ", " 5s", "1e3ms",
                             "5s5s", "1000001min", "99999999999999999999min", "nan s", "0x5s"}) {
        EXPECT_FALSE(parse_duration(text).has_value()) << text;
    }
}

TEST(Text, PercentNeedsItsSignAndItsRange) {
    EXPECT_EQ(parse_percent("1%"), 0.01);
    EXPECT_EQ(parse_percent("0.5 %"), 0.005);
    EXPECT_EQ(parse_percent("100%"), 1.0);
    for (const char* text : {"1", "%", "-1%", "100.1%", "1%%", "a%"}) {
        EXPECT_FALSE(parse_percent(text).has_value()) << text;
    }
}

TEST(Text, IntegersAreReadStrictly) {
    EXPECT_EQ(parse_integer("-7"), -7);
    for (const char* text : {"", "+7", " 7", "7 ", "7.0", "0x7", "9223372036854775808"}) {
        EXPECT_FALSE(parse_integer(text).has_value()) << text;
    }
}

TEST(Text, TimesArePrintedBack) {
    EXPECT_EQ(in_milliseconds(Time(12'345'678)), "12.345");
    EXPECT_EQ(in_milliseconds(Time(2s)), "2000.000");
    EXPECT_EQ(in_words(Time(250us)), "250 us");
    EXPECT_EQ(in_words(Time(1500us)), "1.5 ms");
    EXPECT_EQ(in_words(Time(2s)), "2 s");
}

TEST(Text, InXml) {
    EXPECT_EQ(in_xml("a < \"b\" & c > d"), "a &lt; &quot;b&quot; &amp; c &gt; d");
    EXPECT_EQ(in_xml("M\xC3\xBChle 5 \xE2\x82\xAC"), "M\xC3\xBChle 5 \xE2\x82\xAC");
    EXPECT_EQ(in_xml(std::string_view("\n\x7F\xFF\xC3", 4)), "????");
}

}  // namespace
}  // namespace nplc::sim
