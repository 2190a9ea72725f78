#include "hal_linux/watchdog.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>

namespace nplc::hal_linux {
namespace {

/// In the place of systemd.
class Manager {
  public:
    explicit Manager(const std::string& place) : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0)) {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::memcpy(address.sun_path, place.data(), place.size());
        if (place[0] == '@') address.sun_path[0] = '\0';
        const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + place.size());
        EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    }
    ~Manager() { ::close(socket_); }
    /// A datagram has come when its send has returned. "": there is none.
    std::string heard() {
        std::array<char, 256> room{};
        const ssize_t count = ::recv(socket_, room.data(), room.size(), 0);
        return {room.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
    }

  private:
    int socket_;
};

class Service : public testing::Test {
  protected:
    void SetUp() override {
        place_ = testing::TempDir() + "notify_" + std::to_string(::getpid());
        for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
    }
    void TearDown() override { ::unlink(place_.c_str()); }

    std::string place_;
};

TEST_F(Service, WithoutSystemdNothingIsSaidOrWanted) {
    const auto opened = ServiceWatchdog::open();
    ASSERT_NE(opened.watchdog, nullptr) << opened.error;
    EXPECT_FALSE(opened.watchdog->has_service());
    EXPECT_EQ(opened.watchdog->timeout(), std::nullopt);
    opened.watchdog->ready();
    opened.watchdog->feed();
    opened.watchdog->stopping();
}

TEST_F(Service, TellsWhatSystemdKnows) {
    Manager manager(place_);
    ::setenv("NOTIFY_SOCKET", place_.c_str(), 1);
    const auto opened = ServiceWatchdog::open();
    ASSERT_NE(opened.watchdog, nullptr) << opened.error;
    EXPECT_TRUE(opened.watchdog->has_service());
    EXPECT_EQ(::getenv("NOTIFY_SOCKET"), nullptr) << "programs that this one starts do not speak for it";
    opened.watchdog->ready();
    EXPECT_EQ(manager.heard(), "READY=1");
    opened.watchdog->status("axis x: running\nREADY=1");
    EXPECT_EQ(manager.heard(), "STATUS=axis x: running READY=1")
        << "one line, so nothing else can be said in it";
    opened.watchdog->stopping();
    EXPECT_EQ(manager.heard(), "STOPPING=1");
    opened.watchdog->feed();
    EXPECT_EQ(manager.heard(), "") << "no WatchdogSec=";
}

TEST_F(Service, FeedsAtMostFourTimesInItsTime) {
    Manager manager(place_);
    ::setenv("NOTIFY_SOCKET", place_.c_str(), 1);
    ::setenv("WATCHDOG_USEC", "3600000000", 1);
    ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
    const auto opened = ServiceWatchdog::open();
    ASSERT_NE(opened.watchdog, nullptr) << opened.error;
    EXPECT_EQ(opened.watchdog->timeout(), base::Microseconds(3'600'000'000));
    opened.watchdog->feed();
    EXPECT_EQ(manager.heard(), "WATCHDOG=1");
    opened.watchdog->feed();
    EXPECT_EQ(manager.heard(), "") << "a quarter of an hour has not passed";
}

TEST_F(Service, FeedsWithEachScanWhenTheTimeIsShort) {
    Manager manager(place_);
    ::setenv("NOTIFY_SOCKET", place_.c_str(), 1);
    ::setenv("WATCHDOG_USEC", "3", 1);
    const auto opened = ServiceWatchdog::open();
    ASSERT_NE(opened.watchdog, nullptr) << opened.error;
    for (int i = 0; i < 3; ++i) {
        opened.watchdog->feed();
        EXPECT_EQ(manager.heard(), "WATCHDOG=1") << "a quarter of 3 us is none";
    }
}

TEST_F(Service, AWatchdogForAnotherProcessIsNotFed) {
    Manager manager(place_);
    ::setenv("NOTIFY_SOCKET", place_.c_str(), 1);
    ::setenv("WATCHDOG_USEC", "1000000", 1);
    ::setenv("WATCHDOG_PID", "1", 1);
    const auto opened = ServiceWatchdog::open();
    ASSERT_NE(opened.watchdog, nullptr) << opened.error;
    EXPECT_EQ(opened.watchdog->timeout(), std::nullopt);
    opened.watchdog->feed();
    EXPECT_EQ(manager.heard(), "");
}

TEST_F(Service, FindsAnAbstractSocket) {
    const std::string abstract = "@nplc_test_" + std::to_string(::getpid());
    Manager manager(abstract);
    ::setenv("NOTIFY_SOCKET", abstract.c_str(), 1);
    const auto opened = ServiceWatchdog::open();
    ASSERT_NE(opened.watchdog, nullptr) << opened.error;
    opened.watchdog->ready();
    EXPECT_EQ(manager.heard(), "READY=1");
}

TEST_F(Service, SaysWhatMakesNoSense) {
    ::setenv("NOTIFY_SOCKET", "somewhere", 1);
    EXPECT_EQ(ServiceWatchdog::open().error, "NOTIFY_SOCKET=somewhere is neither a path nor @name");
    for (const char* wrong : {"0", "-1", "soon", "1s", "99999999999999999999", ""}) {
        ::setenv("NOTIFY_SOCKET", place_.c_str(), 1);
        ::setenv("WATCHDOG_USEC", wrong, 1);
        EXPECT_EQ(ServiceWatchdog::open().error,
                  "WATCHDOG_USEC=" + std::string(wrong) + " is not a number of microseconds");
    }
}

TEST(Device, SaysWhatIsWrong) {
    using namespace std::chrono_literals;
    EXPECT_EQ(DeviceWatchdog::open("/dev/watchdog_not", 5s).error,
              "there is no /dev/watchdog_not; load the driver of this board's watchdog");
    EXPECT_EQ(DeviceWatchdog::open("/dev/null", 5s).error, "/dev/null: this is not a watchdog");
    EXPECT_EQ(DeviceWatchdog::open("/dev/null", 999ms).error, "/dev/null: its time is at least 1 s");
}

TEST(Device, NamesTheRemedyForWhatKeepsItFromBeingOpened) {
    const auto why = [](int error) { return DeviceWatchdog::why_not_opened("/dev/watchdog", error); };
    EXPECT_EQ(why(EPERM),
              "this service may not use /dev/watchdog; name it in DeviceAllow= of nanoplc.service "
              "(`systemctl edit nanoplc`)");
    EXPECT_EQ(why(EACCES), "you may not use /dev/watchdog; its group may, or root");
    EXPECT_EQ(why(EBUSY),
              "/dev/watchdog: another program has it; systemd does if its RuntimeWatchdogSec= is set");
    EXPECT_EQ(why(EIO), "/dev/watchdog: Input/output error");
}

}  // namespace
}  // namespace nplc::hal_linux
