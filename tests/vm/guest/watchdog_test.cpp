#include "hal_linux/watchdog.h"

#include <chrono>
#include <fstream>

#include "outside.h"

// The watchdog of the virtual board is an Intel 6300ESB. The kernel's data on it is under
// /sys/class/watchdog.
namespace nplc::board_tests {
namespace {

using hal_linux::DeviceWatchdog;
using namespace std::chrono_literals;

std::string told(const std::string& what) {
    std::ifstream file("/sys/class/watchdog/watchdog0/" + what);
    std::string line;
    std::getline(file, line);
    return line;
}

TEST(BoardWatchdog, IsArmedByOpeningAndDisarmedAtAnOrderlyEnd) {
    EXPECT_EQ(told("state"), "inactive");
    const auto opened = DeviceWatchdog::open("/dev/watchdog", 30'999ms);
    ASSERT_NE(opened.watchdog, nullptr) << opened.error;
    EXPECT_EQ(opened.watchdog->timeout(), 30s);
    EXPECT_EQ(told("state"), "active");
    EXPECT_EQ(told("timeout"), "30");
    EXPECT_FALSE(opened.watchdog->has_reset_board());
    EXPECT_FALSE(DeviceWatchdog::any_has_reset_board());
    opened.watchdog->feed();
    EXPECT_EQ(opened.watchdog->disarm(), "");
    EXPECT_EQ(told("state"), "inactive");
    EXPECT_EQ(opened.watchdog->disarm(), "") << "again";
    opened.watchdog->feed();
    EXPECT_EQ(told("state"), "inactive");
}

TEST(BoardWatchdog, StaysArmedWhenItsProgramEndsOtherwise) {
    Process process([] { return DeviceWatchdog::open("/dev/watchdog0", 600s).watchdog == nullptr; });
    EXPECT_EQ(process.status(), 0);
    EXPECT_EQ(told("state"), "active");
    const auto opened = DeviceWatchdog::open("/dev/watchdog0", 600s);
    ASSERT_NE(opened.watchdog, nullptr) << opened.error << ": the next start takes it over";
    EXPECT_EQ(opened.watchdog->disarm(), "");
    EXPECT_EQ(told("state"), "inactive");
}

TEST(BoardWatchdog, IsHeldByOneProgram) {
    const auto first = DeviceWatchdog::open("/dev/watchdog0", 600s);
    ASSERT_NE(first.watchdog, nullptr) << first.error;
    EXPECT_EQ(DeviceWatchdog::open("/dev/watchdog0", 600s).error,
              "/dev/watchdog0: another program has it; systemd does if its RuntimeWatchdogSec= is set");
    EXPECT_EQ(first.watchdog->disarm(), "");
}

TEST(BoardWatchdog, SaysWhatIsWrong) {
    EXPECT_EQ(DeviceWatchdog::open("/dev/watchdog0", 900ms).error,
              "/dev/watchdog0: its time is at least 1 s");
    EXPECT_EQ(DeviceWatchdog::open("/dev/watchdog0", 24h).error,
              "/dev/watchdog0: cannot do 86400 s: Invalid argument");
    EXPECT_EQ(told("state"), "inactive");
    EXPECT_EQ(as_nobody([] { return DeviceWatchdog::open("/dev/watchdog0", 30s).error; }),
              "you may not use /dev/watchdog0; its group may, or root");
}

TEST(BoardWatchdog, SaysThatItCannotBeStopped) {
    run("echo 1 > /sys/class/watchdog/watchdog0/nowayout");
    Process process([] {
        const auto opened = DeviceWatchdog::open("/dev/watchdog0", 600s);
        if (opened.watchdog == nullptr) return 1;
        return opened.watchdog->disarm() ==
                       "/dev/watchdog0: it cannot be stopped any more (nowayout): the board resets unless "
                       "another "
                       "program feeds it"
                   ? 0
                   : 2;
    });
    EXPECT_EQ(process.status(), 0);
    EXPECT_EQ(told("state"), "active");
}

// The last before the board resets: it waits for that.
TEST(StarvedWatchdog, ResetsTheBoard) {
    const auto opened = DeviceWatchdog::open("/dev/watchdog0", 1s);
    ASSERT_NE(opened.watchdog, nullptr) << opened.error;
    std::puts("STARVING");
    std::fflush(stdout);
    ::pause();
}

// The first after it.
TEST(AfterTheReset, TheDriverSaysWhoResetTheBoard) {
    const auto opened = DeviceWatchdog::open("/dev/watchdog0", 600s);
    ASSERT_NE(opened.watchdog, nullptr) << opened.error;
    EXPECT_TRUE(opened.watchdog->has_reset_board());
    EXPECT_TRUE(DeviceWatchdog::any_has_reset_board());
    EXPECT_EQ(opened.watchdog->disarm(), "");
}

}  // namespace
}  // namespace nplc::board_tests
