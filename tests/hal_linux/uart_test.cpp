#include "hal_linux/uart.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <filesystem>
#include <numeric>

namespace nplc::hal_linux {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The two ends of a pseudo-terminal: ours is the other's line.
class Pair {
  public:
    Pair() : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
        ::grantpt(master_);
        ::unlockpt(master_);
        path_ = ::ptsname(master_);
    }
    ~Pair() { hang_up(); }
    const std::string& path() const { return path_; }
    void hang_up() {
        if (master_ >= 0) ::close(master_);
        master_ = -1;
    }
    void send(const Bytes& bytes) {
        ASSERT_EQ(::write(master_, bytes.data(), bytes.size()), std::ssize(bytes));
    }
    Bytes heard() {
        pollfd state{.fd = master_, .events = POLLIN, .revents = 0};
        ::poll(&state, 1, 10'000);
        Bytes bytes(4096);
        const ssize_t got = ::read(master_, bytes.data(), bytes.size());
        bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
        return bytes;
    }

  private:
    int master_;
    std::string path_;
};

Bytes read_all(Uart& uart, std::size_t count) {
    Bytes all;
    std::array<ports::ReceivedByte, 64> some{};
    while (all.size() < count) {
        pollfd state{.fd = uart.descriptor(), .events = POLLIN, .revents = 0};
        if (::poll(&state, 1, 10'000) <= 0) break;
        const std::size_t got = uart.read(some);
        for (std::size_t i = 0; i < got; ++i) {
            EXPECT_FALSE(some[i].framing_error);
            all.push_back(some[i].value);
        }
    }
    return all;
}

TEST(Uart, CarriesEveryByteBothWays) {
    Pair line;
    auto opened = Uart::open({.path = line.path()});
    ASSERT_NE(opened.uart, nullptr) << opened.error;
    Bytes all(256);
    std::iota(all.begin(), all.end(), std::uint8_t{0});
    line.send(all);
    EXPECT_EQ(read_all(*opened.uart, all.size()), all) << "FFh is marked by the driver, and 00h ends nothing";
    EXPECT_EQ(opened.uart->write(all), all.size());
    EXPECT_EQ(line.heard(), all);
    EXPECT_TRUE(opened.uart->transmitter_idle());
}

/// 11h and 13h are FastMAC bytes; the program before may have left the line with any flow control.
TEST(Uart, LeavesNoFlowControl) {
    Pair line;
    const int before = ::open(line.path().c_str(), O_RDWR | O_NOCTTY);
    ASSERT_GE(before, 0);
    termios mode{};
    ASSERT_EQ(::tcgetattr(before, &mode), 0);
    mode.c_iflag |= static_cast<tcflag_t>(IXON | IXOFF | IXANY);
    mode.c_cflag |= static_cast<tcflag_t>(CRTSCTS);
    ASSERT_EQ(::tcsetattr(before, TCSANOW, &mode), 0);
    auto opened = Uart::open({.path = line.path()});
    ASSERT_NE(opened.uart, nullptr) << opened.error;
    ASSERT_EQ(::tcgetattr(before, &mode), 0);
    EXPECT_EQ(mode.c_iflag & static_cast<tcflag_t>(IXON | IXOFF | IXANY), 0U);
    EXPECT_EQ(mode.c_cflag & static_cast<tcflag_t>(CRTSCTS), 0U);
    ::close(before);
}

TEST(Uart, AnEmptyLineIsNotGone) {
    Pair line;
    auto opened = Uart::open({.path = line.path()});
    ASSERT_NE(opened.uart, nullptr) << opened.error;
    std::array<ports::ReceivedByte, 4> some{};
    EXPECT_EQ(opened.uart->read(some), 0U);
    EXPECT_FALSE(opened.uart->gone());
}

TEST(Uart, TakesAnySpeed) {
    Pair line;
    for (const std::uint32_t baud : {110U, 19'200U, 31'250U, 250'000U}) {
        const auto opened = Uart::open({.path = line.path(), .baud = baud});
        EXPECT_NE(opened.uart, nullptr) << opened.error;
    }
}

TEST(Uart, IsHeldByOneProgram) {
    Pair line;
    const auto first = Uart::open({.path = line.path()});
    ASSERT_NE(first.uart, nullptr) << first.error;
    const auto second = Uart::open({.path = line.path()});
    EXPECT_EQ(second.uart, nullptr);
    EXPECT_NE(second.error.find("holds this port"), std::string::npos) << second.error;
}

TEST(Uart, SaysWhatIsWrong) {
    const auto missing = Uart::open({.path = "/dev/ttyNOT0"});
    EXPECT_NE(missing.error.find("there is no such port"), std::string::npos) << missing.error;
    const auto other = Uart::open({.path = "/dev/null"});
    EXPECT_EQ(other.error, "/dev/null: this is not a serial line");
    Pair line;
    const auto rs485 = Uart::open({.path = line.path(), .rs485 = Rs485{}});
    EXPECT_NE(rs485.error.find("cannot do RS-485"), std::string::npos) << rs485.error;
}

TEST(Uart, AnAdapterThatIsGoneSwallowsAndIsSilentUntilItIsBack) {
    const std::string link = testing::TempDir() + "uart_test_" + std::to_string(::getpid());
    auto line = std::make_unique<Pair>();
    std::filesystem::create_symlink(line->path(), link);
    const auto opened = Uart::open({.path = link});
    ASSERT_NE(opened.uart, nullptr) << opened.error;
    Uart& uart = *opened.uart;
    line.reset();
    std::array<ports::ReceivedByte, 4> some{};
    EXPECT_EQ(uart.read(some), 0U);
    EXPECT_TRUE(uart.gone());
    const Bytes bytes{1, 2, 3};
    EXPECT_EQ(uart.write(bytes), 3U);
    EXPECT_TRUE(uart.transmitter_idle());
    std::filesystem::remove(link);
    EXPECT_NE(uart.reopen(), "");
    line = std::make_unique<Pair>();
    std::filesystem::create_symlink(line->path(), link);
    EXPECT_EQ(uart.reopen(), "");
    EXPECT_EQ(uart.write(bytes), 3U);
    EXPECT_EQ(line->heard(), bytes) << "and nothing of before";
    std::filesystem::remove(link);
}

}  // namespace
}  // namespace nplc::hal_linux
