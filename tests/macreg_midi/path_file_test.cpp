#include "macreg/midi/path_file.h"

#include <gtest/gtest.h>

namespace nplc::macreg::midi {
namespace {

const Scale kMac34{.model = reg::Model::mac34_1};

TEST(MidiPathFile, IsRead) {
    const PathFile file =
        read_path("# a remark\n\ntime_s, 0 [inc], 5 [rev]\r\n0,0,0\n0.5, 1000 ,-0.25 # half\n1,0,0", kMac34);
    EXPECT_EQ(file.problems, std::vector<std::string>{});
    EXPECT_EQ(file.addresses, (std::vector<std::uint8_t>{0, 5}));
    ASSERT_EQ(file.path.size(), 3u);
    EXPECT_EQ(file.path[1], (midi_client::Waypoint{4'000'000, {1000, -2500}}));
}

TEST(MidiPathFile, SpreadsheetsWithSemicolons) {
    const PathFile file = read_path("\"time\";1\n0;5\n0.1;6\n", kMac34);
    EXPECT_EQ(file.problems, std::vector<std::string>{});
    EXPECT_EQ(file.path[1], (midi_client::Waypoint{800'000, {6}}));
}

TEST(MidiPathFile, EveryWrongLineIsTold) {
    const auto problems = read_path("time,0,1\n0,0,0\n0,1,1\n1,x,0\n2,0\n", kMac34).problems;
    ASSERT_EQ(problems.size(), 3u);
    EXPECT_EQ(problems[0], "line 3: its time is not later than the one before");
    EXPECT_EQ(problems[1], "line 4: 'x': write a number and inc or rev behind it");
    EXPECT_EQ(problems[2], "line 5: 2 cells, and the heading has 3");
    EXPECT_EQ(read_path("", kMac34).problems.size(), 1u);
    EXPECT_EQ(read_path("0,0\n1,1\n", kMac34).problems.size(), 1u);
    EXPECT_EQ(read_path("time,300\n0,0\n1,1\n", kMac34).problems.size(), 1u);
    EXPECT_EQ(read_path("time,1,1\n0,0,0\n1,1,1\n", kMac34).problems.size(), 1u);
    EXPECT_EQ(read_path("time,1\n0.5,0\n1,1\n", kMac34).problems.size(), 2u);
    EXPECT_EQ(read_path("time,1 [rev]\n0,0\n1,1\n", {}).problems.size(), 2u) << "turns need the model";
}

}  // namespace
}  // namespace nplc::macreg::midi
