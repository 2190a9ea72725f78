// Pictures of recordings: ticks, panels, both files.
#include "macreg/plot.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nplc::macreg {
namespace {

Recording ramp() {
    Recording recording{.model = "MAC140", .address = 8, .rate_hz = 100};
    recording.columns = {{"P_IST", "counts", {}}, {"V_IST", "rpm", {}}, {"V_SOLL", "rpm", {}}};
    for (int i = 0; i < 200; ++i) {
        recording.time_s.push_back(i / 100.0);
        recording.columns[0].values.push_back(10.0 * i);
        recording.columns[1].values.push_back(std::sin(i / 20.0));
        recording.columns[2].values.push_back(i < 100 ? 0 : 1);
    }
    return recording;
}

std::vector<double> all(const Ticks& ticks) {
    std::vector<double> values;
    for (int i = 0; i < ticks.count; ++i) values.push_back(ticks.at(i));
    return values;
}

TEST(Ticks, AreRoundAndInside) {
    EXPECT_EQ(all(nice_ticks(0, 10, 5)), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(all(nice_ticks(-3, 17, 4)), (std::vector<double>{0, 5, 10, 15}));
    EXPECT_EQ(nice_ticks(0, 10, 5).decimals, 0);
    const Ticks fine = nice_ticks(0.012, 0.029, 4);
    EXPECT_NEAR(fine.step, 0.005, 1e-12);
    EXPECT_EQ(fine.decimals, 3);
    EXPECT_NEAR(fine.first, 0.015, 1e-12);
    EXPECT_EQ(fine.count, 3);  // 0.015, 0.020, 0.025
}

TEST(Plot, APanelAUnit) {
    const auto plotted = plot(ramp(), {.title = "a & b"});
    ASSERT_EQ(plotted.error, "");
    const std::string svg = to_svg(plotted.picture);
    for (const char* words :
         {">[counts]<", ">[rpm]<", ">P_IST<", ">V_IST<", ">V_SOLL<", ">time [s]<", ">a &amp; b<"})
        EXPECT_NE(svg.find(words), std::string::npos) << words;
    EXPECT_EQ(svg.find(">[rpm]<"), svg.rfind(">[rpm]<")) << "two curves share a panel";
}

TEST(Plot, ShortTimesAreInMilliseconds) {
    Recording recording = ramp();
    for (double& time : recording.time_s) time /= 10;
    EXPECT_NE(to_svg(plot(recording, {}).picture).find(">time [ms]<"), std::string::npos);
}

TEST(Plot, CurvesStayInsideThePicture) {
    for (const int width : {320, 960}) {
        const auto plotted = plot(ramp(), {.width = width});
        for (const auto& line : plotted.picture.lines) {
            for (const Point& point : line.points) {
                EXPECT_TRUE(point.x >= 0 && point.x <= width);
                EXPECT_TRUE(point.y >= 0 && point.y <= plotted.picture.height);
            }
        }
    }
}

TEST(Plot, ASpikeBetweenPixelsIsKept) {
    Recording recording;
    recording.columns = {{"P_IST", "counts", {}}};
    for (int i = 0; i < 100'000; ++i) {
        recording.time_s.push_back(i);
        recording.columns[0].values.push_back(i == 54'321 ? 1000 : 0);
    }
    const auto plotted = plot(recording, {});
    double highest = 1e9;
    std::size_t points = 0;
    for (const Point& point : plotted.picture.lines.back().points) highest = std::min(highest, point.y);
    points = plotted.picture.lines.back().points.size();
    // 6 % of room over the spike: a panel of 200 pixels from 48 on, 1000 of -60..1060.
    EXPECT_NEAR(highest, 48 + 200 * 60.0 / 1120, 0.5);
    EXPECT_LT(points, 5'000U);
}

TEST(Plot, AConstantIsDrawn) {
    Recording recording = ramp();
    for (double& value : recording.columns[1].values) value = 0;
    recording.columns.resize(2);
    EXPECT_EQ(to_svg(plot(recording, {}).picture).find("nan"), std::string::npos);
}

TEST(Plot, WhatCannotBeDrawnIsSaid) {
    EXPECT_EQ(plot(ramp(), {.columns = {"NONE"}}).error,
              "the recording has no column 'NONE', only P_IST, V_IST, V_SOLL");
    Recording five = ramp();
    while (five.columns.size() < 5) five.columns.push_back(five.columns.front());
    EXPECT_NE(plot(five, {}).error.find("5 columns are more than 4 curves"), std::string::npos);
    Recording one = ramp();
    one.time_s.resize(1);
    EXPECT_NE(plot(one, {}).error, "");
}

// Signature, width and height as the PNG standard has them.
TEST(Plot, APngIsOne) {
    const auto plotted = plot(ramp(), {.width = 640, .height = 480});
    const std::string png = to_png(plotted.picture);
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1A\n");
    EXPECT_EQ(png.substr(16, 8), std::string("\0\0\x02\x80\0\0\x01\xE0", 8));
    EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND");
}

}  // namespace
}  // namespace nplc::macreg
