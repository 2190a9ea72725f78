#include "hal_linux/uart.h"

#include <numeric>

#include "outside.h"

// A serial adapter on USB (FTDI); its other end echoes everything.
namespace nplc::board_tests {
namespace {

using hal_linux::Rs485;
using hal_linux::Uart;
using Bytes = std::vector<std::uint8_t>;

constexpr const char* kPath = "/dev/ttyUSB0";

Bytes read_all(Uart& uart, std::size_t count) {
    Bytes all;
    std::array<ports::ReceivedByte, 64> some{};
    while (all.size() < count && !uart.gone() && readable(uart.descriptor(), kSoon)) {
        const std::size_t got = uart.read(some);
        for (std::size_t i = 0; i < got; ++i) all.push_back(some[i].value);
    }
    return all;
}

/// The kernel needs a moment for an adapter that was put in.
template <class Try>
bool in_time(Try&& attempt) {
    for (int i = 0; i < kSoon / 10; ++i) {
        if (attempt()) return true;
        ::poll(nullptr, 0, 10);
    }
    return false;
}

TEST(BoardUart, AnAdapterIsPulledOutAndPutInAgain) {
    run("modprobe -a xhci_pci ftdi_sio");
    ASSERT_TRUE(in_time([] { return ::access(kPath, F_OK) == 0; }));
    const auto opened = Uart::open({.path = kPath});
    ASSERT_NE(opened.uart, nullptr) << opened.error;
    Uart& uart = *opened.uart;
    Bytes all(256);
    std::iota(all.begin(), all.end(), std::uint8_t{0});
    EXPECT_EQ(uart.write(all), all.size());
    EXPECT_EQ(read_all(uart, all.size()), all);

    Outside outside;
    outside.unplug("adapter");
    EXPECT_EQ(read_all(uart, 1), Bytes{}) << "who waits is woken";
    EXPECT_TRUE(uart.gone());
    EXPECT_EQ(uart.write(all), all.size()) << "swallowed";
    EXPECT_NE(uart.reopen(), "");

    outside.plug("adapter");
    ASSERT_TRUE(in_time([&] { return uart.reopen().empty(); }));
    const Bytes again{1, 2, 3};
    EXPECT_EQ(uart.write(again), again.size());
    EXPECT_EQ(read_all(uart, again.size()), again) << "and nothing of before";
}

TEST(BoardUart, ADriverWithoutRs485IsNamed) {
    const std::string error = Uart::open({.path = kPath, .rs485 = Rs485{}}).error;
    EXPECT_NE(error.find("the driver of this device cannot do RS-485"), std::string::npos) << error;
}

}  // namespace
}  // namespace nplc::board_tests
