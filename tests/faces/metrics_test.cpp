// What is known of axes as Prometheus's text; promtool and the service: tests/e2e/metrics_test.py.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "metrics/exposition.h"
#include "metrics/server.h"

namespace nplc::metrics {
namespace {

using namespace std::chrono_literals;
namespace gw = registers::gateway;

constexpr base::Instant kNow{10s};

faces::AxisImage image_of(base::Instant taken) {
    faces::AxisImage image;
    image.number = 1;
    image.taken = taken;
    image.own[gw::LINK_LOSSES] = 3;
    image.tally.scans[2] = 7;  // up to 500 us
    image.tally.scans.back() = 1;
    image.tally.scan_microseconds = 2'500'000;
    image.tally.events[3] = 2;
    return image;
}

bool holds(const std::string& text, const std::string& line) {
    return text.find("\n" + line + "\n") != std::string::npos;
}

TEST(Exposition, CountsAndHistogram) {
    faces::AxisModel axis("x");
    axis.board().put(image_of(kNow - 100ms));
    const std::string text = exposition({&axis}, "1.2.3", kNow);
    EXPECT_TRUE(holds(text, "nanoplc_info{version=\"1.2.3\"} 1"));
    EXPECT_TRUE(holds(text, "nanoplc_axis_up{axis=\"x\"} 1"));
    EXPECT_TRUE(holds(text, "nanoplc_link_losses_total{axis=\"x\"} 3"));
    EXPECT_TRUE(holds(text, "nanoplc_scan_seconds_bucket{axis=\"x\",le=\"0.00025\"} 0"));
    EXPECT_TRUE(holds(text, "nanoplc_scan_seconds_bucket{axis=\"x\",le=\"0.0005\"} 7"));
    EXPECT_TRUE(holds(text, "nanoplc_scan_seconds_bucket{axis=\"x\",le=\"1\"} 7"));
    EXPECT_TRUE(holds(text, "nanoplc_scan_seconds_bucket{axis=\"x\",le=\"+Inf\"} 8"));
    EXPECT_TRUE(holds(text, "nanoplc_scan_seconds_sum{axis=\"x\"} 2.5"));
    EXPECT_TRUE(holds(text, "nanoplc_scan_seconds_count{axis=\"x\"} 8"));
    EXPECT_TRUE(holds(text, "nanoplc_events_total{axis=\"x\",event=\"link_down\"} 2"));
}

TEST(Exposition, HowLongAStopIsNotConfirmed) {
    faces::AxisModel axis("x");
    faces::AxisImage image = image_of(kNow);
    image.own[gw::UPTIME] = 20'000;
    axis.board().put(image);
    EXPECT_TRUE(holds(exposition({&axis}, "1", kNow), "nanoplc_stop_unconfirmed_seconds{axis=\"x\"} 0"));
    image.own[gw::STATUS] = gw::kStopUnconfirmed;
    image.own[gw::STOP_SINCE] = 7'500;
    axis.board().put(image);
    EXPECT_TRUE(holds(exposition({&axis}, "1", kNow), "nanoplc_stop_unconfirmed_seconds{axis=\"x\"} 12.5"));
}

TEST(Exposition, WhatIsNotKnownHasNoLine) {
    faces::AxisModel never("never");
    faces::AxisModel old("old");
    old.board().put(image_of(kNow - 1001ms));
    const std::string text = exposition({&never, &old}, "1", kNow);
    EXPECT_TRUE(holds(text, "nanoplc_axis_up{axis=\"never\"} 0"));
    EXPECT_TRUE(holds(text, "nanoplc_axis_up{axis=\"old\"} 0"));
    EXPECT_EQ(text.find("nanoplc_link_losses_total"), std::string::npos);

    faces::AxisModel fresh("fresh");
    faces::AxisImage image = image_of(kNow);
    image.motor[0] = {.is_known = true, .value = 4096, .taken = kNow - 1001ms};  // P_IST, too old
    image.motor[1] = {.is_known = true, .value = 0, .taken = kNow};              // V_IST
    fresh.board().put(image);
    const std::string half = exposition({&fresh, &old}, "1", kNow);
    EXPECT_EQ(half.find("nanoplc_position"), std::string::npos);
    EXPECT_TRUE(holds(half, "nanoplc_velocity_per_second{axis=\"fresh\",unit=\"rev\"} 0"));
    EXPECT_EQ(half.find("{axis=\"old\","), std::string::npos);
}

TEST(Exposition, TheDocumentHasIt) {
    std::ifstream file(METRICS_FOLDER "/README.md");
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_NE(text.str().find(metrics_as_markdown()), std::string::npos) << "put this into it:\n"
                                                                         << metrics_as_markdown();
}

TEST(MetricsServer, PlacesToListen) {
    for (const char* good : {"127.0.0.1:9464", "tcp:127.0.0.1:0", "[::1]:9464", "0.0.0.0:80"})
        EXPECT_EQ(Server::mistake_in(good), "") << good;
    for (const char* wrong :
         {"", "9464", ":9464", "localhost:9464", "127.0.0.1:65536", "127.0.0.1:x", "http://127.0.0.1:80"})
        EXPECT_NE(Server::mistake_in(wrong), "") << wrong;
}

}  // namespace
}  // namespace nplc::metrics
