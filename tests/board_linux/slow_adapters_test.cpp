// USB adapters that hold a motor's characters back, in a sysfs of the test's own.
#include "slow_adapters.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace nplc::boards {
namespace {

namespace fs = std::filesystem;

struct SlowAdapters : testing::Test {
    SlowAdapters() {
        std::string name = fs::temp_directory_path() / "adapters.XXXXXX";
        folder = ::mkdtemp(name.data());
        std::ofstream(folder / "ttyUSB7").put(' ');
        fs::create_symlink(folder / "ttyUSB7", folder / "by-id");
        fs::create_directories(timer().parent_path());
        AxisConfig axis;
        axis.motor.port = {(folder / "by-id").string(), 12, "axis[x].motor.port"};
        config.axes.push_back(axis);
    }
    ~SlowAdapters() override { fs::remove_all(folder); }

    fs::path timer() const { return folder / "sys/bus/usb-serial/devices/ttyUSB7/latency_timer"; }
    void set(int milliseconds) const { std::ofstream(timer()) << milliseconds << "\n"; }
    /// `after`: what the driver makes of the question for a low latency.
    std::vector<Mistake> look(int after) {
        return slow_adapters(config, (folder / "sys").string(), [&](const std::string& path) {
            EXPECT_EQ(path, (folder / "by-id").string());
            ++asked;
            set(after);
        });
    }

    fs::path folder;
    Config config;
    int asked = 0;
};

TEST_F(SlowAdapters, OneThatCannotBeSetLowIsNamedWithWhatToDo) {
    set(16);
    const auto slow = look(16);
    ASSERT_EQ(slow.size(), 1U);
    EXPECT_EQ(slow[0].line, 12);
    EXPECT_EQ(slow[0].key, "axis[x].motor.port");
    for (const std::string& word :
         {std::string("by-id"), std::string("16 ms"), timer().string(), std::string("70-nanoplc.rules")})
        EXPECT_NE(slow[0].text.find(word), std::string::npos) << slow[0].text;
}

TEST_F(SlowAdapters, OneThatTheServiceSetsLowIsInOrder) {
    set(16);
    EXPECT_TRUE(look(1).empty());
    EXPECT_EQ(asked, 1);
}

TEST_F(SlowAdapters, AQuickOneIsLeftAlone) {
    set(1);
    EXPECT_TRUE(look(16).empty());
    EXPECT_EQ(asked, 0);
}

TEST_F(SlowAdapters, WhatIsNoUsbAdapterIsLeftAlone) {
    EXPECT_TRUE(look(16).empty()) << "no such timer";
    config.axes[0].motor.port.text = (folder / "none").string();
    EXPECT_TRUE(look(16).empty());
    config.axes[0].motor.port.text = "pty:" + (folder / "by-id").string();
    set(16);
    EXPECT_TRUE(look(16).empty());
    EXPECT_EQ(asked, 0);
}

}  // namespace
}  // namespace nplc::boards
