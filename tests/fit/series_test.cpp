#include "macreg/series.h"

#include <gtest/gtest.h>

#include <cmath>

#include "hidden_axis.h"

/// Recordings that cannot be fitted get one message with the reason.
namespace nplc::macreg {
namespace {

using registers::Model;

Recording good() {
    return hidden::Bench({}, 3).record({{10, 5000, 60}}, 200, true);
}

void refused(const Recording& recording, std::string_view part, std::optional<Model> model = {}) {
    const std::string error = series_of(recording, "r.csv", model).error;
    EXPECT_TRUE(error.starts_with("r.csv: ")) << error;
    EXPECT_NE(error.find(part), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
}

TEST(Series, AGoodRecordingIsTakenByPositionOrVelocity) {
    const Recording whole = good();
    const SeriesReading reading = series_of(whole, "r.csv");
    ASSERT_EQ(reading.error, "");
    EXPECT_EQ(reading.motor, "MAC140");
    ASSERT_EQ(reading.series.size(), 200U);
    Recording without = whole;
    without.columns.erase(without.columns.begin());  // P_IST
    const SeriesReading summed = series_of(without, "r.csv");
    ASSERT_EQ(summed.error, "");
    EXPECT_EQ(summed.series.counts, reading.series.counts);
    EXPECT_EQ(summed.series.torque, reading.series.torque);
}

TEST(Series, APositionThatGoesRoundGoesOn) {
    Recording recording = good();
    const std::vector<double> counts = series_of(recording, "r.csv").series.counts;
    for (double& value : recording.columns[0].values) {
        value += 2147483647 - 2000;
        if (value > 2147483647) value -= 4294967296.0;
    }
    EXPECT_EQ(series_of(recording, "r.csv").series.counts, counts);
}

TEST(Series, WhatCannotBeFittedIsRefused) {
    Recording bad = good();
    bad.incomplete = "Ctrl-C";
    refused(bad, "it is incomplete (Ctrl-C); record again");
    bad = good();
    bad.model = "";
    refused(bad, "add --model");
    EXPECT_EQ(series_of(bad, "r.csv", Model::mac140).error, "");
    refused(good(), "it is of a MAC140 and not of a MAC800", Model::mac800);
    bad = hidden::Bench({}, 3).record({{10, 5000, 60}}, 60, true);
    refused(bad, "60 samples are too few, 100 are the least");
    bad = good();
    bad.rate_hz = 0;
    refused(bad, "it was polled");
    bad.rate_hz = 7812.5;
    refused(bad, "record without --rate fast");
    bad.rate_hz = 770;
    refused(bad, "was it recorded of another motor?");
    bad = good();
    for (double& time : bad.time_s) time *= 1.1;
    refused(bad, "rows are missing");
}

TEST(Series, ColumnsThatAreMissingOrWrongAreNamed) {
    Recording bad = good();
    bad.columns.erase(bad.columns.begin() + 1);
    refused(bad, "it has no VF_OUT");
    bad = good();
    bad.columns.resize(2);
    bad.columns.erase(bad.columns.begin());
    refused(bad, "it has neither P_IST nor V_IST");
    bad = good();
    bad.columns[1].unit = "rpm";
    refused(bad, "VF_OUT is in [rpm], which is no unit of it");
    bad = good();
    bad.columns[2].unit = "rev/s";
    refused(bad, "V_IST");
    bad = good();
    for (double& value : bad.columns[1].values) value *= 0.37;
    refused(bad, "values of VF_OUT lie between the motor's steps");
    bad = good();
    for (double& value : bad.columns[1].values) value = 0;
    refused(bad, "VF_OUT is 0 of 1023 in all samples");
    bad = good();
    for (double& value : bad.columns[0].values) value = 7;
    bad.columns.resize(2);
    refused(bad, "the shaft turned by 0 counts only");
    bad = good();
    bad.columns[0].values[100] += 500;
    refused(bad, "P_IST goes on by");
}

// NaN, a torn line: the message gives the place. Five lines of comment and one of names stand before
// the rows.
TEST(Series, CutAndDamagedFilesAreToldWithTheirLine) {
    const std::string text = to_csv(good());
    const std::string cut = text.substr(0, text.rfind(','));
    EXPECT_TRUE(from_csv(cut, "r.csv").error.starts_with("r.csv:206: ")) << from_csv(cut, "r.csv").error;
    const std::string nan = cut + ",nan\n";
    EXPECT_TRUE(from_csv(nan, "r.csv").error.starts_with("r.csv:206: 'nan'")) << from_csv(nan, "r.csv").error;
}

}  // namespace
}  // namespace nplc::macreg
